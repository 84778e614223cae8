#include "limn/lines/stochastic.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

#include "limn/base/error.h"
#include "limn/lines/contour_face.h"
#include "limn/lines/suggestive_face.h"

namespace limn {
namespace {

SeedSet seed_set(std::vector<std::uint32_t> pool, std::size_t face_count, std::uint64_t seed, std::uint64_t stream)
{
    SeedSet set;
    set.pool = std::move(pool);
    set.visit.assign(face_count, 0);
    set.random = Random(seed, stream);
    return set;
}

/// Brings `count` random elements of `items` to its front (Fisher and Yates, cut short).
void shuffle_front(std::span<std::uint32_t> items, std::size_t count, Random& random)
{
    for (std::size_t i = 0; i < count; ++i)
        std::swap(items[i], items[i + random.below(std::uint32_t(items.size() - i))]);
}

/// One frame: tries faces and follows what they hold.
template <class InFace> class Search {
public:
    Search(const Adjacency& adjacency, SeedSet& seeds, const InFace& in_face, StochasticCounts& counts)
        : adjacency_(adjacency), seeds_(seeds), in_face_(in_face), counts_(counts)
    {
    }

    std::vector<Segment> run(const StochasticOptions& options)
    {
        next_frame();
        const double n = options.sample_fraction * double(seeds_.pool.size()), delta = options.discovery;
        const std::size_t seeds = std::min(seeds_.seeds.size(), std::size_t(std::ceil((1 - delta) * n)));
        const std::size_t random = std::min(seeds_.pool.size(), std::size_t(std::ceil((1 + delta) * n)));
        counts_.seeds += seeds;
        counts_.random += random;
        // One seed of each line comes first, so that a line that stays in its faces is never lost.
        const std::size_t firsts = std::min(seeds, seeds_.lines);
        shuffle_front(std::span(seeds_.seeds).first(seeds_.lines), firsts, seeds_.random);
        shuffle_front(std::span(seeds_.seeds).subspan(seeds_.lines), seeds - firsts, seeds_.random);
        shuffle_front(seeds_.pool, random, seeds_.random);
        for (std::size_t i = 0; i < firsts; ++i)
            follow(seeds_.seeds[i]);
        for (std::size_t i = 0; i < seeds - firsts; ++i)
            follow(seeds_.seeds[seeds_.lines + i]);
        for (std::size_t i = 0; i < random; ++i)
            follow(seeds_.pool[i]);
        counts_.lines += first_faces_.size();
        keep_seeds();
        std::sort(found_.begin(), found_.end(), [](const Segment& a, const Segment& b) { return a.face < b.face; });
        return std::move(found_);
    }

private:
    void next_frame()
    {
        if (++seeds_.frame == 0) { // the numbers of frames start again
            std::fill(seeds_.visit.begin(), seeds_.visit.end(), 0);
            seeds_.frame = 1;
        }
    }

    void follow(std::uint32_t start)
    {
        bool first = true;
        waiting_.assign(1, start);
        while (!waiting_.empty()) {
            const std::uint32_t face = waiting_.back();
            waiting_.pop_back();
            if (std::exchange(seeds_.visit[face], seeds_.frame) == seeds_.frame)
                continue;
            ++counts_.tested;
            Segment segment;
            if (!in_face_(face, segment))
                continue;
            (first ? first_faces_ : other_faces_).push_back(face);
            first = false;
            found_.push_back(segment);
            for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h) {
                const std::uint32_t twin = adjacency_.twin[h], edge = adjacency_.edge_id(h);
                if (twin != none && (edge == segment.edge_a || edge == segment.edge_b))
                    waiting_.push_back(twin / 3);
            }
        }
    }

    void keep_seeds()
    {
        seeds_.lines = first_faces_.size();
        seeds_.seeds = std::move(first_faces_);
        seeds_.seeds.insert(seeds_.seeds.end(), other_faces_.begin(), other_faces_.end());
    }

    const Adjacency& adjacency_;
    SeedSet& seeds_;
    const InFace& in_face_;
    StochasticCounts& counts_;
    std::vector<Segment> found_;
    std::vector<std::uint32_t> waiting_, first_faces_, other_faces_;
};

template <class InFace>
std::vector<Segment> search(const LineModel& model, const StochasticOptions& options, SeedSet& seeds, StochasticCounts* counts, const InFace& in_face)
{
    StochasticCounts unread;
    return Search<InFace>(model.adjacency, seeds, in_face, counts ? *counts : unread).run(options);
}

/// The union of what several frames find. Each is in the order of faces.
template <class Frame> std::vector<Segment> over_frames(const StochasticOptions& options, const Frame& next_frame)
{
    const auto before = [](const Segment& a, const Segment& b) { return a.face < b.face; };
    std::vector<Segment> all = next_frame();
    for (int frame = 1; frame < stochastic_frames && options.sample_fraction < 1; ++frame) {
        const std::vector<Segment> found = next_frame();
        std::vector<Segment> joined;
        joined.reserve(all.size() + found.size());
        std::set_union(all.begin(), all.end(), found.begin(), found.end(), std::back_inserter(joined), before);
        all = std::move(joined);
    }
    return all;
}

} // namespace

SeedSet seeds_of_contours(const LineModel& model, std::uint64_t seed)
{
    std::vector<std::uint32_t> all(model.faces.size());
    std::iota(all.begin(), all.end(), 0u);
    return seed_set(std::move(all), model.faces.size(), seed, 0);
}

SeedSet seeds_of_suggestive(const LineModel& model, const SuggestiveFaces& faces, std::uint64_t seed)
{
    return seed_set(faces.candidates, model.faces.size(), seed, 1);
}

std::vector<Segment> extract_contours_stochastic(const LineModel& model, const View& view, const StochasticOptions& options, SeedSet& seeds, StochasticCounts* counts)
{
    return search(model, options, seeds, counts, [&](std::uint32_t face, Segment& segment) {
        const uvec3& t = model.faces[face];
        const auto facing = [&](std::uint32_t v) { return glm::dot(model.normals[v], view.to_eye(model.positions[v])); };
        const float corners[3] = {facing(t.x), facing(t.y), facing(t.z)};
        return contour_in_face(model, face, corners, segment);
    });
}

std::vector<Segment> extract_suggestive_stochastic(const LineModel& model, const View& view, const SuggestiveOptions& suggestive,
                                                   const StochasticOptions& options, SeedSet& seeds, StochasticCounts* counts)
{
    if (!model.has_derivative())
        throw Error::Input("suggestive lines need the derivative of curvature, which the surface does not hold");
    return search(model, options, seeds, counts,
                  [&](std::uint32_t face, Segment& segment) { return suggestive_in_face(model, view, face, suggestive, segment); });
}

std::vector<Segment> draw_contours_stochastic(const LineModel& model, const View& view, const StochasticOptions& options, std::uint64_t seed)
{
    SeedSet seeds = seeds_of_contours(model, seed);
    return over_frames(options, [&] { return extract_contours_stochastic(model, view, options, seeds); });
}

std::vector<Segment> draw_suggestive_stochastic(const LineModel& model, const View& view, const SuggestiveFaces& faces,
                                                const SuggestiveOptions& suggestive, const StochasticOptions& options, std::uint64_t seed)
{
    SeedSet seeds = seeds_of_suggestive(model, faces, seed);
    return over_frames(options, [&] { return extract_suggestive_stochastic(model, view, suggestive, options, seeds); });
}

} // namespace limn
