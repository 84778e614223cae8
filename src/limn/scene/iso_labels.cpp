#include "limn/scene/iso_labels.h"

#include <algorithm>
#include <cmath>

#include "limn/drawing/lettering.h"

namespace limn {
namespace {

/// In heights of a capital letter.
constexpr double free_space = 0.6;  ///< between text and line
constexpr double between = 60;      ///< from one label to the next on a line
constexpr double most_sag = 0.35;   ///< how far a line may leave the text's middle line

double width_of(const std::string& text)
{
    double width = 0;
    for (const std::vector<dvec2>& line : letter(text))
        for (const dvec2& p : line)
            width = std::max(width, 2 * std::abs(p.x));
    return width;
}

/// A stroke with its points' places along it, a closed one with its first point repeated at the end.
class Arc {
public:
    explicit Arc(const Stroke& stroke) : stroke_(open(stroke))
    {
        places_.push_back(0);
        for (std::size_t i = 1; i < stroke_.points.size(); ++i)
            places_.push_back(places_.back() + glm::distance(stroke_.points[i - 1], stroke_.points[i]));
    }
    double length() const { return places_.back(); }
    dvec2 at(double place) const
    {
        const auto [i, t] = find(place);
        return glm::mix(stroke_.points[i], stroke_.points[i + 1], t);
    }
    /// How far the arc's points between two places are from the chord between these.
    double sag(double from, double to) const
    {
        const dvec2 a = at(from), b = at(to), along = b - a;
        const double chord = glm::length(along);
        if (!(chord > 0.9 * (to - from)))
            return to - from; // it turns back
        double most = 0;
        for (std::size_t i = std::size_t(std::upper_bound(places_.begin(), places_.end(), from) - places_.begin()); i < places_.size() && places_[i] < to; ++i) {
            const dvec2 p = stroke_.points[i] - a;
            most = std::max(most, std::abs(p.x * along.y - p.y * along.x) / chord);
        }
        return most;
    }
    Stroke piece(double from, double to) const
    {
        Stroke s;
        s.type = stroke_.type, s.visible = stroke_.visible, s.object = stroke_.object;
        add(s, from);
        for (std::size_t i = 0; i < places_.size(); ++i)
            if (places_[i] > from && places_[i] < to)
                add(s, i);
        add(s, to);
        return s;
    }

private:
    static Stroke open(Stroke stroke)
    {
        if (!stroke.closed)
            return stroke;
        stroke.closed = false;
        stroke.points.push_back(stroke.points.front());
        stroke.world.push_back(stroke.world.front());
        stroke.ink.push_back(stroke.ink.front());
        stroke.faces.push_back(stroke.faces.front());
        return stroke;
    }
    std::pair<std::size_t, double> find(double place) const
    {
        const std::size_t after = std::size_t(std::upper_bound(places_.begin(), places_.end(), place) - places_.begin());
        const std::size_t i = std::min(std::max<std::size_t>(after, 1) - 1, places_.size() - 2);
        const double step = places_[i + 1] - places_[i];
        return {i, step > 0 ? std::clamp((place - places_[i]) / step, 0.0, 1.0) : 0.0};
    }
    void add(Stroke& s, std::size_t i) const
    {
        s.points.push_back(stroke_.points[i]);
        s.world.push_back(stroke_.world[i]);
        s.ink.push_back(stroke_.ink[i]);
        s.faces.push_back(stroke_.faces[i]);
    }
    void add(Stroke& s, double place) const
    {
        const auto [i, t] = find(place);
        s.points.push_back(glm::mix(stroke_.points[i], stroke_.points[i + 1], t));
        s.world.push_back(glm::mix(stroke_.world[i], stroke_.world[i + 1], t));
        s.ink.push_back(glm::mix(stroke_.ink[i], stroke_.ink[i + 1], float(t)));
        s.faces.push_back(stroke_.faces[i]);
    }
    Stroke stroke_;
    std::vector<double> places_;
};

/// Whether a straight piece from a to b touches the box [-half, half] (Liang & Barsky 1984).
bool crosses_box(const dvec2& a, const dvec2& b, const dvec2& half)
{
    double enter = 0, leave = 1;
    for (int k = 0; k < 2; ++k) {
        const double d = b[k] - a[k];
        if (d == 0) {
            if (std::abs(a[k]) > half[k])
                return false;
            continue;
        }
        const double s = (-half[k] - a[k]) / d, t = (half[k] - a[k]) / d;
        enter = std::max(enter, std::min(s, t)), leave = std::min(leave, std::max(s, t));
    }
    return enter <= leave;
}

/// Text in the middle between two points, as upright as it goes.
Caption caption_between(const dvec2& a, const dvec2& b, double height, const std::string& text)
{
    dvec2 along = glm::normalize(b - a);
    if (along.x < 0)
        along = -along;
    const dvec2 down = {-along.y, along.x};
    return {0.5 * (a + b) + 0.5 * height * down, height, text, -std::atan2(along.y, along.x)};
}

} // namespace

IsoLabels::IsoLabels(double height, const ivec2& picture, std::span<const Stroke> others) : height_(height), picture_(picture)
{
    if (!(height > 0))
        return;
    for (const Stroke& stroke : others)
        for (std::size_t i = stroke.closed ? 0 : 1; stroke.visible && i < stroke.points.size(); ++i)
            others_.push_back({stroke.points[(i + stroke.points.size() - 1) % stroke.points.size()], stroke.points[i]});
}

bool IsoLabels::is_free(const dvec2& a, const dvec2& b) const
{
    const dvec2 middle = 0.5 * (a + b), along = glm::normalize(b - a), across = {-along.y, along.x};
    const double reach = 0.5 * glm::distance(a, b);
    if (glm::any(glm::lessThan(middle, dvec2(reach))) || glm::any(glm::greaterThan(middle, dvec2(picture_) - reach)))
        return false;
    for (std::size_t i = 0; i < captions_.size(); ++i)
        if (glm::distance(captions_[i].position, middle) < reach + reaches_[i])
            return false;
    // In the text's own frame, where its box is [-reach, reach] x [-height, height].
    const auto own = [&](const dvec2& p) { return dvec2(glm::dot(p - middle, along), glm::dot(p - middle, across)); };
    return std::none_of(others_.begin(), others_.end(), [&](const Piece& piece) { return crosses_box(own(piece.a), own(piece.b), {reach, height_}); });
}

std::vector<Stroke> IsoLabels::write(const Stroke& stroke, const std::string& text)
{
    if (!(height_ > 0) || !stroke.visible || stroke.points.size() < 2)
        return {stroke};
    const Arc arc(stroke);
    const double gap = height_ * (width_of(text) + 2 * free_space), spacing = between * height_;
    const int labels = arc.length() < 3 * gap ? 0 : 1 + int(arc.length() / spacing);
    std::vector<Stroke> pieces;
    double drawn = 0; // the stroke is done up to here
    for (int k = 0; k < labels; ++k) {
        // Where the arc is straightest in this label's part of it.
        const double low = std::max(drawn, arc.length() * (k + 0.1) / labels), high = arc.length() * (k + 0.9) / labels - gap, step = 0.5 * height_;
        double best = -1, least = most_sag * height_;
        for (double from = low; from <= high; from += step)
            if (const double sag = arc.sag(from, from + gap); sag < least && is_free(arc.at(from), arc.at(from + gap)))
                best = from, least = sag;
        if (best < 0)
            continue;
        captions_.push_back(caption_between(arc.at(best), arc.at(best + gap), height_, text));
        reaches_.push_back(0.6 * gap);
        if (best > drawn)
            pieces.push_back(arc.piece(drawn, best));
        drawn = best + gap;
    }
    if (drawn == 0)
        return {stroke};
    pieces.push_back(arc.piece(drawn, arc.length()));
    return pieces;
}

} // namespace limn
