#pragma once

#include <algorithm>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// The place on a line between two others that is nearest to a place in a picture.
inline dvec2 nearest_on_line(const dvec2& p, const dvec2& a, const dvec2& b)
{
    const dvec2 along = b - a;
    const double square = glm::dot(along, along), t = square > 0 ? std::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0;
    return a + t * along;
}
inline double distance_to_line(const dvec2& p, const dvec2& a, const dvec2& b) { return glm::distance(p, nearest_on_line(p, a, b)); }

/// A circle in the picture within which lines must be nearer to what they stand for than elsewhere. All in pixels.
struct TightPlace {
    dvec2 at;
    double radius = 0;
    double error = 0; ///< how far lines may be off
};

/// How far lines in a picture may be off, told by where they run.
class LocalTolerance {
public:
    LocalTolerance() = default;
    explicit LocalTolerance(std::vector<TightPlace> places) : places_(std::move(places))
    {
        std::sort(places_.begin(), places_.end(), [](const TightPlace& a, const TightPlace& b) { return a.at.x < b.at.x; });
        for (const TightPlace& place : places_)
            widest_ = std::max(widest_, place.radius);
    }
    bool empty() const { return places_.empty(); }
    /// The least error allowed by the places that a line from a to b touches, and by `elsewhere`.
    double along(const dvec2& a, const dvec2& b, double elsewhere) const
    {
        const double low = std::min(a.x, b.x) - widest_, high = std::max(a.x, b.x) + widest_;
        auto place = std::lower_bound(places_.begin(), places_.end(), low, [](const TightPlace& p, double x) { return p.at.x < x; });
        double least = elsewhere;
        for (; place != places_.end() && place->at.x <= high; ++place)
            if (place->error < least && distance_to_line(place->at, a, b) <= place->radius)
                least = place->error;
        return least;
    }

private:
    std::vector<TightPlace> places_; ///< from left to right
    double widest_ = 0;
};

} // namespace limn
