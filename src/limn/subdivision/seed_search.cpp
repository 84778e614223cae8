#include "limn/subdivision/seed_search.h"

#include <algorithm>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/subdivision/pn_curve.h"

namespace limn {
namespace {

constexpr std::size_t grain = 8192;     // sectors
constexpr std::size_t word_grain = 128; // words of 64 sides
constexpr std::size_t search_grain = 16;

bool faces(const Eye& eye, const dvec3& p, const dvec3& n) { return !(glm::dot(eye.from(p), n) < 0); }

/// A point of an edge as the eye sees it.
struct Sample {
    dvec3 position, normal;
    bool front = true;
    double cosine = 0; ///< between the normal and the direction to the eye
};

Sample sample(const Eye& eye, const EdgePoint& p)
{
    const dvec3 view = eye.from(p.position);
    const double length = glm::length(view);
    return {p.position, p.normal, faces(eye, p.position, p.normal), length > 0 ? glm::dot(view, p.normal) / length : 0};
}

/// How far from a to b the cosine is 0. Their signs differ.
double zero_between(const Sample& a, const Sample& b)
{
    const double change = a.cosine - b.cosine;
    return change != 0 ? std::clamp(a.cosine / change, 0.0, 1.0) : 0.5;
}

double closest_on_chord(const dvec3& p, const dvec3& a, const dvec3& b)
{
    const dvec3 chord = b - a;
    const double square = glm::dot(chord, chord);
    return square > 0 ? std::clamp(glm::dot(p - a, chord) / square, 0.0, 1.0) : 0;
}

class Search {
public:
    Search(const SeedSurface& surface, const SeedPose& pose, const Eye& eye, int depth, SeedEvaluation evaluation)
        : s_(surface), pose_(pose), eye_(eye), depth_(depth), all_(evaluation == SeedEvaluation::all)
    {
    }

    /// @param points  for working
    SeedCrossing cross(std::uint32_t side, std::vector<EdgePoint>& points) const
    {
        const std::uint32_t e = s_.edge_of(side), h = s_.topology.half_edge[e];
        const bool right = s_.is_second(side);
        const auto [start, end] = s_.ends[side];
        const dvec3 &p1 = pose_.positions[s_.topology.start(h)], &p2 = pose_.positions[s_.topology.end(h)];
        const Sample first = sample(eye_, {p1, pose_.normals[start]}), last = sample(eye_, {p2, pose_.normals[end]});
        const std::size_t pieces = std::size_t(1) << s_.levels;
        const Sample middle = sample(eye_, s_.halves.point(2 * e, pieces, right ? EdgeTable::right : EdgeTable::left, pose_.fine));
        const bool second = middle.front == first.front; // the half in which the signs differ
        const Half half{2 * e + second, right != second ? EdgeTable::right : EdgeTable::left};
        SeedCrossing c = bisect(half, second ? last : first, middle, points);
        c.along = second ? 1 - c.along / 2 : c.along / 2;
        c.chord = closest_on_chord(c.position, p1, p2);
        c.side = side;
        return c;
    }

private:
    struct Half {
        std::size_t number;
        EdgeTable::Side side;
    };

    EdgePoint point(const Half& half, std::size_t row) const { return s_.halves.point(half.number, row, half.side, pose_.fine); }

    SeedCrossing bisect(const Half& half, Sample a, Sample b, std::vector<EdgePoint>& points) const
    {
        std::size_t i = 0, j = std::size_t(1) << depth_;
        const std::size_t stride = std::size_t(1) << (s_.levels - depth_);
        const double pieces = double(j);
        if (all_) {
            points.clear();
            for (std::size_t k = 0; k <= j; ++k)
                points.push_back(point(half, k * stride));
        }
        while (j - i > 1) {
            const std::size_t k = (i + j) / 2;
            const Sample between = sample(eye_, all_ ? points[k] : point(half, k * stride));
            if (between.front != a.front)
                b = between, j = k;
            else
                a = between, i = k;
        }
        const double w = zero_between(a, b);
        SeedCrossing c;
        c.position = glm::mix(a.position, b.position, w);
        c.normal = mixed_normal(a.normal, b.normal, w);
        c.along = (double(i) + w) / pieces;
        return c;
    }

    const SeedSurface& s_;
    const SeedPose& pose_;
    const Eye& eye_;
    int depth_;
    bool all_;
};

/// A bit for each of the 64 sides from `first` on whose ends differ.
std::uint64_t test_sides(const SeedSurface& s, std::span<const std::uint8_t> facing, std::size_t first)
{
    std::uint64_t word = 0;
    const std::size_t count = std::min<std::size_t>(64, s.side_count() - first);
    for (std::size_t i = 0; i < count; ++i) {
        const auto [a, b] = s.ends[first + i];
        word |= std::uint64_t(facing[a] ^ facing[b]) << i;
    }
    return word;
}

void test(const SeedSurface& s, const SeedPose& pose, const Eye& eye, SeedCrossings& out)
{
    out.facing.resize(pose.normals.size());
    parallel_each(out.facing.size(), grain, [&](std::size_t i) { out.facing[i] = faces(eye, pose.positions[s.sector_vertex[i]], pose.normals[i]); });
    const std::size_t words = (s.side_count() + 63) / 64;
    out.crossed.resize(words);
    parallel_each(words, word_grain, [&](std::size_t w) { out.crossed[w] = test_sides(s, out.facing, 64 * w); });
    out.before.resize(words + 1, 0);
    for (std::size_t w = 0; w < words; ++w)
        out.before[w + 1] = out.before[w] + std::uint32_t(std::popcount(out.crossed[w]));
}

} // namespace

SeedCrossings find_seed_crossings(const SeedSurface& s, const SeedPose& pose, const Eye& eye, int depth, SeedEvaluation evaluation)
{
    if (depth < 0 || depth > s.levels)
        throw Error::Input(fmt::format("a search of depth {}: the tables hold 0 to {}", depth, s.levels));
    SeedCrossings out;
    test(s, pose, eye, out);
    out.crossings.resize(out.before.back());
    const Search search(s, pose, eye, depth, evaluation);
    parallel_blocks(out.crossed.size(), search_grain, [&](std::size_t begin, std::size_t end) {
        std::vector<EdgePoint> points;
        for (std::size_t w = begin; w < end; ++w) {
            std::uint32_t at = out.before[w];
            for (std::uint64_t word = out.crossed[w]; word != 0; word &= word - 1)
                out.crossings[at++] = search.cross(std::uint32_t(64 * w) + std::uint32_t(std::countr_zero(word)), points);
        }
    });
    return out;
}

} // namespace limn
