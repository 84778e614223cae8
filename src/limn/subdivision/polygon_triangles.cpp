#include "limn/subdivision/polygon_triangles.h"

#include <algorithm>

namespace limn {
namespace {

double area(const dvec2& a, const dvec2& b, const dvec2& c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

double square(const dvec2& d) { return glm::dot(d, d); }

/// 1 for equal sides, 0 for none, negative where it is turned over.
double quality(const dvec2& a, const dvec2& b, const dvec2& c)
{
    const double sides = square(b - a) + square(c - b) + square(a - c);
    return sides > 0 ? 3.4641016151377544 * area(a, b, c) / sides : 0;
}

bool is_inside(const dvec2& p, const dvec2& a, const dvec2& b, const dvec2& c)
{
    return area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0;
}

bool is_straight(const Polygon& left, std::size_t i, std::span<const std::uint8_t> lines)
{
    const std::size_t n = left.size();
    return (lines[left[(i + n - 1) % n]] & lines[left[i]] & lines[left[(i + 1) % n]]) != 0;
}

/// Whether cutting off corner i would lead along a side: then other points of that side lie between its neighbours, and would be left in line.
bool cuts_along_side(const Polygon& left, std::size_t i, std::span<const std::uint8_t> lines)
{
    const std::size_t n = left.size();
    return n > 3 && (lines[left[(i + n - 1) % n]] & lines[left[(i + 1) % n]]) != 0;
}

/// How good an ear corner i of what is left would be; negative where it is none.
double ear_quality(const Polygon& left, std::size_t i, const PolygonPoints& all)
{
    const std::size_t n = left.size();
    if (is_straight(left, i, all.lines) || cuts_along_side(left, i, all.lines))
        return -1;
    const std::span<const dvec2> points = all.places;
    const dvec2 &a = points[left[(i + n - 1) % n]], &b = points[left[i]], &c = points[left[(i + 1) % n]];
    const double shape = quality(a, b, c);
    if (!(shape > 0))
        return -1;
    for (std::size_t k = 2; k + 1 < n; ++k) {
        const dvec2& p = points[left[(i + k) % n]];
        if (p != a && p != b && p != c && is_inside(p, a, b, c))
            return -1;
    }
    return shape;
}

/// From one corner of a polygon to another, both included.
Polygon part_of(const Polygon& polygon, std::size_t from, std::size_t to)
{
    Polygon part = {polygon[from]};
    for (std::size_t i = from; i != to;) {
        i = (i + 1) % polygon.size();
        part.push_back(polygon[i]);
    }
    return part;
}

/// The ear to cut off: the best shaped, and where nothing fits the one that turns over least.
std::size_t choose_ear(const Polygon& left, const std::vector<double>& qualities, const PolygonPoints& all)
{
    const auto best = std::max_element(qualities.begin(), qualities.end());
    if (*best >= 0)
        return std::size_t(best - qualities.begin());
    const std::size_t n = left.size();
    std::size_t least = 0;
    double most = -4;
    for (std::size_t i = 0; i < n; ++i) {
        const double shape = is_straight(left, i, all.lines)        ? -3
                             : cuts_along_side(left, i, all.lines) ? -2
                                                                   : quality(all.places[left[(i + n - 1) % n]], all.places[left[i]], all.places[left[(i + 1) % n]]);
        if (shape > most)
            most = shape, least = i;
    }
    return least;
}

} // namespace

std::vector<Polygon> cut_polygon(const Polygon& polygon, std::span<const std::uint32_t> line)
{
    if (line.size() < 2)
        return {};
    const auto place = [&](std::uint32_t point) { return std::size_t(std::find(polygon.begin(), polygon.end(), point) - polygon.begin()); };
    const std::size_t from = place(line.front()), to = place(line.back());
    if (from == to || std::max(from, to) == polygon.size())
        return {};
    Polygon first = part_of(polygon, to, from), second = part_of(polygon, from, to);
    first.insert(first.end(), line.begin() + 1, line.end() - 1);
    second.insert(second.end(), line.rbegin() + 1, line.rend() - 1);
    return {std::move(first), std::move(second)};
}

std::vector<uvec3> triangulate_polygon(const Polygon& polygon, const PolygonPoints& points)
{
    Polygon left = polygon;
    std::vector<double> qualities;
    for (std::size_t i = 0; i < left.size(); ++i)
        qualities.push_back(ear_quality(left, i, points));
    std::vector<uvec3> triangles;
    while (left.size() > 3) {
        const std::size_t n = left.size(), ear = choose_ear(left, qualities, points);
        triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
        left.erase(left.begin() + std::ptrdiff_t(ear));
        qualities.erase(qualities.begin() + std::ptrdiff_t(ear));
        // The corner that went may have been in the way of any ear that did not fit.
        for (std::size_t i = 0; i < left.size(); ++i)
            if (qualities[i] < 0 || i == ear % (n - 1) || i == (ear + n - 2) % (n - 1))
                qualities[i] = ear_quality(left, i, points);
    }
    if (left.size() == 3)
        triangles.push_back({left[0], left[1], left[2]});
    return triangles;
}

} // namespace limn
