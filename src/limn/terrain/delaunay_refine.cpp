#include "limn/terrain/delaunay_refine.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace limn {
namespace {

/// The sample of a triangle to insert next.
struct Candidate {
    float error = 0; ///< metres; infinite where an edge is too long
    std::uint32_t sample = none;
};

struct Queued {
    Candidate candidate;
    std::uint32_t triangle;
    /// Whether it comes later: of two, the worse is first, and of equals the northern, then the western.
    bool operator<(const Queued& other) const
    {
        if (candidate.error != other.candidate.error)
            return candidate.error < other.candidate.error;
        if (candidate.sample != other.candidate.sample)
            return candidate.sample > other.candidate.sample;
        return triangle > other.triangle;
    }
};

class Refinement {
public:
    Refinement(const HeightMap& map, DelaunayTriangulation& mesh, const DelaunayBound& bound) : map_(map), mesh_(mesh), bound_(bound) {}
    void run()
    {
        for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t)
            changed_.push_back(t);
        queue_changed();
        while (const std::optional<Queued> worst = take_worst()) {
            const std::uint32_t columns = std::uint32_t(map_.columns), sample = worst->candidate.sample;
            mesh_.insert({int(sample % columns), int(sample / columns)}, worst->triangle, changed_);
            queue_changed();
        }
    }

private:
    /// Entries of triangles that have changed since stay in the heap until they are on top.
    std::optional<Queued> take_worst()
    {
        while (!queue_.empty()) {
            std::pop_heap(queue_.begin(), queue_.end());
            const Queued top = queue_.back();
            queue_.pop_back();
            if (candidates_[top.triangle] == top.candidate.sample)
                return top;
        }
        return {};
    }
    void queue_changed()
    {
        candidates_.resize(mesh_.triangle_count(), none);
        std::sort(changed_.begin(), changed_.end());
        changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
        for (const std::uint32_t t : changed_) {
            const Candidate found = find_candidate(mesh_.at(t * 3), mesh_.at(t * 3 + 1), mesh_.at(t * 3 + 2));
            candidates_[t] = found.sample;
            if (found.sample == none)
                continue;
            queue_.push_back({found, t});
            std::push_heap(queue_.begin(), queue_.end());
        }
        changed_.clear();
    }
    bool has_data(const ivec2& p) const { return map_.has_data(p.x, p.y); }
    Candidate find_candidate(const ivec2& p, const ivec2& q, const ivec2& r) const
    {
        if (DelaunayBound::has_no_sample_inside(DelaunayTriangulation::area2(p, q, r)) || !has_data(p) || !has_data(q) || !has_data(r))
            return {};
        if (!bound_.has_short_edges(p, q, r))
            return find_middle(p, q, r);
        double worst = bound_.tolerance;
        const std::size_t at = SampledTriangle(map_, p, q, r).find_worst(worst);
        return at == SampledTriangle::no_sample ? Candidate() : Candidate{float(worst), std::uint32_t(at)};
    }
    /// Of all samples but the corners, the one nearest to the middle of the longest edge. Where there is none, edges cannot stay too long: in a
    /// Delaunay triangulation, of two triangles that have only corners on the two sides of a long edge, one has an edge that is longer still.
    Candidate find_middle(ivec2 p, ivec2 q, ivec2 r) const
    {
        const auto length2 = [](const ivec2& v) { return std::int64_t(v.x) * v.x + std::int64_t(v.y) * v.y; };
        while (length2(q - p) < std::max(length2(r - q), length2(p - r)))
            p = std::exchange(q, std::exchange(r, p));
        Candidate best = {std::numeric_limits<float>::infinity(), none};
        std::int64_t least = std::numeric_limits<std::int64_t>::max();
        each_row(p, q, r, [&](int row, int first, int last) {
            for (int column = first; column <= last; ++column) {
                const ivec2 at(column, row);
                const std::int64_t distance2 = length2(2 * at - (p + q));
                if (distance2 < least && at != p && at != q && at != r)
                    least = distance2, best.sample = std::uint32_t(map_.index(column, row));
            }
        });
        return best;
    }

    const HeightMap& map_;
    DelaunayTriangulation& mesh_;
    DelaunayBound bound_;
    std::vector<std::uint32_t> candidates_; ///< of each triangle the sample, or none
    std::vector<Queued> queue_;             ///< a heap
    std::vector<std::uint32_t> changed_;    ///< triangles
};

} // namespace

void refine_within(const HeightMap& map, DelaunayTriangulation& mesh, const DelaunayBound& bound) { Refinement(map, mesh, bound).run(); }

} // namespace limn
