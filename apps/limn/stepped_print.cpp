#include "stepped_print.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "limn/base/error.h"

using namespace limn;

namespace {

using Ring = std::vector<dvec2>;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

constexpr double shortest_side = 0.02; ///< of a ring, layers: shorter ones would turn around where an edge goes in
constexpr double corner_cosine = 0.85; ///< between edges of a ring: beyond, there is a corner

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

double area_of(const Ring& ring)
{
    double twice = 0;
    for (std::size_t i = 0; i < ring.size(); ++i)
        twice += cross(ring[i], ring[(i + 1) % ring.size()]);
    return 0.5 * twice;
}

Edge edge_of(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// Without points that are as good as the same.
Ring cleaned(const Ring& ring, double least)
{
    Ring result;
    for (const dvec2& p : ring)
        if (result.empty() || glm::length(p - result.back()) > least)
            result.push_back(p);
    while (result.size() > 1 && glm::length(result.front() - result.back()) <= least)
        result.pop_back();
    return result;
}

bool is_inside(const dvec2& p, const dvec2& a, const dvec2& b, const dvec2& c)
{
    return cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
}

/// A ring with what an edge needs of it: outward normals at both ends of each side, and the way in at each corner.
struct Outline {
    Ring ring;
    std::vector<dvec2> start_normals, end_normals; ///< of the side from a corner to the next
    std::vector<dvec2> out;                        ///< of corners: one further out by it is one further out from both sides
    explicit Outline(const Ring& points) : ring(points)
    {
        const std::size_t n = ring.size();
        std::vector<dvec2> sides;
        for (std::size_t i = 0; i < n; ++i) {
            const dvec2 d = glm::normalize(ring[(i + 1) % n] - ring[i]);
            sides.emplace_back(d.y, -d.x);
        }
        start_normals = end_normals = sides;
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t before = (i + n - 1) % n;
            const dvec2 mean = glm::normalize(sides[before] + sides[i]);
            const double cosine = glm::dot(sides[before], sides[i]);
            out.push_back(mean / std::max(glm::dot(mean, sides[i]), 0.3));
            if (cosine > corner_cosine)
                start_normals[i] = end_normals[before] = mean;
        }
    }
};

struct Builder {
    SteppedPrint print;
    std::uint32_t add(const dvec2& p, double z, const dvec3& n)
    {
        print.positions.emplace_back(dvec3(p, z));
        print.normals.emplace_back(glm::normalize(n));
        return std::uint32_t(print.positions.size() - 1);
    }
    void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d)
    {
        print.triangles.push_back({a, b, c});
        print.triangles.push_back({a, c, d});
    }
    /// A level face whose corners are those of a ring moved in. It is cut as the ring is, which does not cross itself where it is moved far.
    void cap(const Ring& moved, const std::vector<uvec3>& cut, double z, double up)
    {
        const std::uint32_t first = std::uint32_t(print.positions.size());
        for (const dvec2& p : moved)
            add(p, z, {0, 0, up});
        for (const uvec3& t : cut)
            print.triangles.push_back(up > 0 ? t + first : uvec3(t.x, t.z, t.y) + first);
    }
};

/// A point of the profile of an edge: how far in, at which height (both from the middle of the upright line that it touches), and its normal.
struct ProfilePoint {
    double in, height, out_normal, up_normal;
};

std::vector<ProfilePoint> profile_of(const StepOptions& o)
{
    if (o.bulge == 0)
        return {{0, -0.5 * o.layer_height, 1, 0}, {0, 0.5 * o.layer_height, 1, 0}};
    std::vector<ProfilePoint> points;
    const double half = 0.5 * o.bulge * o.layer_height;
    for (int i = 0; i <= o.bead_segments; ++i) {
        const double a = std::numbers::pi * (double(i) / o.bead_segments - 0.5);
        points.push_back({half * (1 - std::cos(a)), 0.5 * o.layer_height * std::sin(a), std::cos(a), o.bulge * std::sin(a)});
    }
    return points;
}

void add_layer(Builder& builder, const Ring& ring, double middle, const std::vector<ProfilePoint>& profile)
{
    const Outline outline(ring);
    const std::size_t n = ring.size();
    const auto inner = [&](std::size_t i, double in) { return ring[i] - in * outline.out[i]; };
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t next = (i + 1) % n;
        for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
            const ProfilePoint &low = profile[k], &high = profile[k + 1];
            const auto corner = [&](std::size_t at, const dvec2& normal, const ProfilePoint& p) {
                return builder.add(inner(at, p.in), middle + p.height, dvec3(normal * p.out_normal, p.up_normal));
            };
            builder.quad(corner(i, outline.start_normals[i], low), corner(next, outline.end_normals[i], low),
                         corner(next, outline.end_normals[i], high), corner(i, outline.start_normals[i], high));
        }
    }
    Ring cap;
    for (std::size_t i = 0; i < n; ++i)
        cap.push_back(inner(i, profile.back().in));
    const std::vector<uvec3> cut = cut_polygon(ring);
    builder.cap(cap, cut, middle + profile.back().height, 1);
    builder.cap(cap, cut, middle + profile.front().height, -1);
}

} // namespace

std::vector<Ring> slice(const Mesh& mesh, double height)
{
    std::map<Edge, Edge> next; // from the edge where a ring enters a triangle to the one where it leaves
    std::map<Edge, dvec2> places;
    for (const uvec3& t : mesh.triangles) {
        bool above[3];
        for (int k = 0; k < 3; ++k)
            above[k] = mesh.positions[t[k]].z >= height;
        if (above[0] == above[1] && above[1] == above[2])
            continue;
        std::pair<Edge, Edge> way;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            if (above[k] == above[(k + 1) % 3])
                continue;
            const auto [low, high] = edge_of(a, b);
            const dvec3 &p = mesh.positions[low], &q = mesh.positions[high];
            places[{low, high}] = dvec2(glm::mix(p, q, (height - p.z) / (q.z - p.z)));
            (above[k] ? way.first
                      : way.second) = {low, high}; // the inside is to the left of the way from where it goes down to where it goes up
        }
        next[way.first] = way.second;
    }
    std::vector<Ring> rings;
    while (!next.empty()) {
        Ring ring;
        Edge at = next.begin()->first;
        for (auto step = next.find(at); step != next.end(); step = next.find(at)) {
            ring.push_back(places.at(at));
            at = step->second;
            next.erase(step);
        }
        if (glm::length(places.at(at) - ring.front()) > 1e-9)
            throw Error::Input("the model is not closed: a slice of it has an end");
        rings.push_back(ring);
    }
    return rings;
}

std::vector<uvec3> cut_polygon(const Ring& ring)
{
    std::vector<std::uint32_t> left(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i)
        left[i] = std::uint32_t(i);
    std::vector<uvec3> triangles;
    while (left.size() > 3) {
        const std::size_t n = left.size();
        std::size_t ear = n, small = n; // the smallest corner, where sides cross and no ear is free
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < n && ear == n; ++i) {
            const std::uint32_t a = left[(i + n - 1) % n], b = left[i], c = left[(i + 1) % n];
            const double size = cross(ring[b] - ring[a], ring[c] - ring[b]);
            if (size <= 0)
                continue;
            if (size < least) {
                least = size;
                small = i;
            }
            const bool empty = std::none_of(left.begin(), left.end(), [&](std::uint32_t v) {
                return v != a && v != b && v != c && is_inside(ring[v], ring[a], ring[b], ring[c]);
            });
            if (empty)
                ear = i;
        }
        if (ear == n)
            ear = small;
        if (ear == n) // what is left is flat
            break;
        triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
        left.erase(left.begin() + std::ptrdiff_t(ear));
    }
    if (left.size() == 3)
        triangles.push_back({left[0], left[1], left[2]});
    return triangles;
}

SteppedPrint stepped_print(const Mesh& mesh, const StepOptions& options)
{
    if (!(options.layer_height > 0))
        throw Error::Input("the layer height is not above 0");
    const Bounds bounds = mesh.bounds();
    const std::vector<ProfilePoint> profile = profile_of(options);
    const double inset = std::max(profile.front().in, profile.back().in);
    Builder builder;
    const int layers = int(std::ceil((bounds.high.z - bounds.low.z) / options.layer_height - 1e-9));
    for (int j = 0; j < layers; ++j) {
        const double middle = bounds.low.z + (j + 0.5) * options.layer_height;
        for (const Ring& whole : slice(mesh, middle)) {
            const Ring ring = cleaned(whole, shortest_side * options.layer_height);
            if (ring.size() >= 3 && area_of(ring) > 4 * inset * inset)
                add_layer(builder, ring, middle, profile);
        }
    }
    builder.print.positions.emplace_back(0);
    return std::move(builder.print);
}
