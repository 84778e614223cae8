#include "limn/lines/clip.h"

#include <algorithm>
#include <cmath>

namespace limn {
namespace {

struct Box {
    dvec2 low, high;
    bool holds(const dvec2& p) const { return p.x >= low.x && p.y >= low.y && p.x <= high.x && p.y <= high.y; }
    /// The part [t0, t1] of a piece that lies inside (Liang & Barsky 1984); false where none does.
    bool part(const dvec2& a, const dvec2& b, double& t0, double& t1) const
    {
        t0 = 0, t1 = 1;
        for (int k = 0; k < 2; ++k) {
            const double d = b[k] - a[k];
            if (d == 0 && (a[k] < low[k] || a[k] > high[k]))
                return false;
            if (d == 0)
                continue;
            const double enter = ((d > 0 ? low : high)[k] - a[k]) / d, leave = ((d > 0 ? high : low)[k] - a[k]) / d;
            t0 = std::max(t0, enter);
            t1 = std::min(t1, leave);
        }
        return t0 < t1;
    }
};

void add_mixed(Stroke& to, const Stroke& from, std::size_t i, std::size_t j, double t)
{
    to.points.push_back(glm::mix(from.points[i], from.points[j], t));
    to.world.push_back(glm::mix(from.world[i], from.world[j], t));
    to.ink.push_back(glm::mix(from.ink[i], from.ink[j], float(t)));
    to.faces.push_back(from.faces[i]);
}

Stroke without_points(const Stroke& stroke)
{
    Stroke part;
    part.type = stroke.type;
    part.visible = stroke.visible;
    part.object = stroke.object;
    return part;
}

} // namespace

void clip_to_picture(Stroke stroke, const ivec2& size, std::vector<Stroke>& out)
{
    const dvec2 margin = 0.02 * dvec2(size);
    const Box box = {-margin, dvec2(size) + margin};
    if (std::all_of(stroke.points.begin(), stroke.points.end(), [&](const dvec2& p) { return box.holds(p); })) {
        out.push_back(std::move(stroke));
        return;
    }
    const std::size_t n = stroke.points.size(), pieces = stroke.closed ? n : n - 1;
    Stroke part = without_points(stroke);
    const auto finish = [&] {
        if (part.points.size() > 1)
            out.push_back(std::move(part));
        part = without_points(stroke);
    };
    for (std::size_t i = 0; i < pieces; ++i) {
        const std::size_t j = (i + 1) % n;
        double t0, t1;
        if (!box.part(stroke.points[i], stroke.points[j], t0, t1)) {
            finish();
            continue;
        }
        if (part.points.empty())
            add_mixed(part, stroke, i, j, t0);
        add_mixed(part, stroke, i, j, t1);
        if (t1 < 1)
            finish();
    }
    finish();
}

void clip_to_near_plane(std::vector<Segment>& segments, const Projector& projector)
{
    if (projector.orthographic)
        return;
    constexpr double near = 1e-3;
    std::erase_if(segments, [&](Segment& s) {
        const double a = projector.depth(s.a) - near, b = projector.depth(s.b) - near;
        if (a > 0 && b > 0)
            return false;
        if (a <= 0 && b <= 0)
            return true;
        const float t = float(a / (a - b));
        (a <= 0 ? s.ink_a : s.ink_b) = glm::mix(s.ink_a, s.ink_b, t);
        (a <= 0 ? s.edge_a : s.edge_b) = none;
        (a <= 0 ? s.a : s.b) = glm::mix(s.a, s.b, t);
        return false;
    });
}

} // namespace limn
