#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "limn/base/parallel.h"
#include "limn/lines/edge_zero.h"
#include "limn/lines/line_model.h"
#include "limn/lines/segment.h"
#include "limn/lines/short_chains.h"
#include "limn/lines/trim.h"

namespace limn {

// Lines on which a height is largest across the line: ridges, valleys, apparent ridges. At a corner the height and a tangent
// direction are known, the direction only up to sign, and the slope of the height along it, which has the same sign.

struct ExtremalCorner {
    vec3 direction = vec3(0); ///< unit, or 0 where there is none: no line passes
    float slope = 0;
    float height = 0;         ///< >= 0
};

struct ExtremalLimits {
    float height = 0;    ///< above 0
    float sharpness = 0; ///< smallest -(second derivative of the height along its direction) / height^3
    float fade = 2;      ///< full ink from (1 + fade) limits of the height; 0: no fading
};

/// Finds the lines face by face. `corner(vertex)` gives an ExtremalCorner; it is called from many threads.
template <class Corner> class ExtremalLines {
public:
    ExtremalLines(const LineModel& model, const Corner& corner, const ExtremalLimits& limits) : model_(model), corner_(corner), limits_(limits) {}

    /// At most one segment per face, in the order of the faces.
    std::vector<Segment> find() const
    {
        return parallel_collect<Segment>(model_.faces.size(), 8192, [&](std::size_t begin, std::size_t end, std::vector<Segment>& out) {
            for (std::size_t f = begin; f < end; ++f) {
                Segment segment;
                if (segment_in(std::uint32_t(f), segment))
                    out.push_back(segment);
            }
        });
    }

private:
    /// The directions at two corners are taken as one where they differ by less than this (cosine of 45 degrees).
    static constexpr float least_alignment = 0.7f;

    struct Face {
        std::array<ExtremalCorner, 3> corners;
        std::array<bool, 3> turned; ///< of the edge from corner k to k+1: the directions at its ends point opposite ways
    };

    Face corners_of(std::uint32_t face) const
    {
        const uvec3& t = model_.faces[face];
        return {{corner_(t.x), corner_(t.y), corner_(t.z)}, {}};
    }

    /// Fills `turned`; false where the directions cannot be given one orientation (near an umbilic).
    static bool orient(Face& face)
    {
        for (int k = 0; k < 3; ++k) {
            const float alignment = glm::dot(at(face, k).direction, at(face, (k + 1) % 3).direction);
            if (!(std::abs(alignment) > least_alignment))
                return false;
            face.turned[std::size_t(k)] = alignment < 0;
        }
        return face.turned[0] == (face.turned[1] != face.turned[2]);
    }

    static const ExtremalCorner& at(const Face& face, int k) { return face.corners[std::size_t(k)]; }

    static bool crossed(const Face& face, int k)
    {
        return (at(face, k).slope < 0) != ((at(face, (k + 1) % 3).slope < 0) != face.turned[std::size_t(k)]);
    }

    /// The second derivative of the height along its direction, by linear interpolation of the slopes, and twice the face's area.
    std::pair<float, float> bend_of(std::uint32_t face, const Face& f) const
    {
        const uvec3& t = model_.faces[face];
        const vec3 &p0 = model_.positions[t.x], &p1 = model_.positions[t.y], &p2 = model_.positions[t.z];
        const float s1 = f.turned[0] ? -1.0f : 1.0f, s2 = f.turned[2] ? -1.0f : 1.0f;
        const vec3 direction = glm::normalize(at(f, 0).direction + s1 * at(f, 1).direction + s2 * at(f, 2).direction);
        const vec3 normal = glm::cross(p1 - p0, p2 - p0);
        const vec3 gradient = glm::cross(normal, at(f, 0).slope * (p2 - p1) + s1 * at(f, 1).slope * (p0 - p2) + s2 * at(f, 2).slope * (p1 - p0));
        const float area = glm::length(normal);
        return {area > 0 ? glm::dot(gradient, direction) / (area * area) : 0, area};
    }

    /// The faces around the corner that half-edge h starts from, ascending.
    void fan_of(std::uint32_t h, std::vector<std::uint32_t>& faces) const
    {
        const std::vector<std::uint32_t>& twin = model_.adjacency.twin;
        faces.assign(1, h / 3);
        std::uint32_t g = h;
        while ((g = twin[g]) != none && (g = next_half_edge(g)) != h)
            faces.push_back(g / 3);
        if (g == none)
            for (g = h; (g = twin[next_half_edge(next_half_edge(g))]) != none;)
                faces.push_back(g / 3);
        std::sort(faces.begin(), faces.end());
    }

    /// How much more the height bends down at a vertex than the limit asks: > 0 where it is a sharp enough maximum. The mean over
    /// the faces around, weighted by area: one face's value is mostly noise, and would cut the lines into dashes.
    float excess_bend(std::uint32_t h, const ExtremalCorner& corner, std::vector<std::uint32_t>& fan) const
    {
        fan_of(h, fan);
        float sum = 0, weight = 0;
        for (const std::uint32_t f : fan)
            if (Face face = corners_of(f); orient(face)) {
                const auto [bend, area] = bend_of(f, face);
                sum += area * bend;
                weight += area;
            }
        return (weight > 0 ? -sum / weight : 0) - limits_.sharpness * corner.height * corner.height * corner.height;
    }

    bool segment_in(std::uint32_t face, Segment& segment) const
    {
        Face f = corners_of(face);
        if (!(std::max({at(f, 0).height, at(f, 1).height, at(f, 2).height}) > limits_.height))
            return false;
        if (!orient(f) || !(crossed(f, 0) || crossed(f, 1) || crossed(f, 2)))
            return false;
        const uvec3& t = model_.faces[face];
        std::vector<std::uint32_t> fan;
        float bends[3], heights[2] = {0, 0}, excess[2] = {0, 0};
        for (int k = 0; k < 3; ++k)
            bends[k] = excess_bend(3 * face + std::uint32_t(k), at(f, k), fan);
        int found = 0;
        for (int k = 0; k < 3 && found < 2; ++k) {
            if (!crossed(f, k))
                continue;
            const int l = (k + 1) % 3;
            const EdgeZero zero = slope_zero(t[k], t[l], at(f, k).slope, at(f, l).slope);
            const int from = zero.from == t[k] ? k : l, to = from == k ? l : k;
            heights[found] = zero.mix(at(f, from).height, at(f, to).height);
            excess[found] = zero.mix(bends[from], bends[to]);
            (found == 0 ? segment.a : segment.b) = zero.mix(model_.positions[zero.from], model_.positions[zero.to]);
            (found == 0 ? segment.edge_a : segment.edge_b) = model_.adjacency.edge_id(3 * face + std::uint32_t(k));
            ++found;
        }
        segment.face = face;
        const Interval high = positive_interval(heights[0] / limits_.height - 1, heights[1] / limits_.height - 1);
        return trim(segment, intersection(high, positive_interval(excess[0], excess[1])), heights[0], heights[1]);
    }

    /// The zero of the slope between two corners whose directions agree up to sign. Only magnitudes enter, so the two faces of
    /// the edge get the same bits however each has turned the directions.
    static EdgeZero slope_zero(std::uint32_t i, std::uint32_t j, float slope_i, float slope_j)
    {
        const float a = std::abs(slope_i), b = std::abs(slope_j);
        return a + b > 0 ? edge_zero(i, j, a, -b) : edge_zero(i, j, 1, -1);
    }

    /// Cuts a segment to the part that is kept, and gives it its ink.
    bool trim(Segment& segment, const Interval& kept, float height_a, float height_b) const
    {
        if (kept.empty())
            return false;
        const Segment whole = segment;
        const auto ink = [&](float s) {
            const float above = (height_a + s * (height_b - height_a)) / limits_.height - 1;
            return limits_.fade > 0 ? glm::clamp(above / limits_.fade, 0.0f, 1.0f) : 1.0f;
        };
        if (kept.begin > 0) {
            segment.a = whole.a + kept.begin * (whole.b - whole.a);
            segment.edge_a = none;
        }
        if (kept.end < 1) {
            segment.b = whole.a + kept.end * (whole.b - whole.a);
            segment.edge_b = none;
        }
        segment.ink_a = ink(kept.begin);
        segment.ink_b = ink(kept.end);
        return true;
    }

    const LineModel& model_;
    const Corner& corner_;
    const ExtremalLimits limits_;
};

/// The lines without the chains that are shorter than `min_length` (units of the model), which are noise.
template <class Corner>
std::vector<Segment> extremal_lines(const LineModel& model, const Corner& corner, const ExtremalLimits& limits, double min_length)
{
    std::vector<Segment> segments = ExtremalLines<Corner>(model, corner, limits).find();
    drop_short_chains(segments, min_length);
    return segments;
}

} // namespace limn
