#include "limn/terrain/terrain_mesh.h"

#include <atomic>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/terrain/bisection.h"
#include "limn/terrain/polygon_fan.h"

namespace limn {
namespace {

constexpr std::size_t grain = 4096;

/// Which samples are corners, and their numbers in the order of samples.
class CornerNumbers {
public:
    explicit CornerNumbers(const HeightMap& map) : columns_(std::size_t(map.columns)), words_((map.heights.size() + 63) / 64), before_(words_.size() + 1) {}
    /// From any thread.
    void add(const ivec2& p)
    {
        const std::size_t i = index(p);
        const std::uint64_t bit = std::uint64_t(1) << (i % 64);
        std::atomic_ref<std::uint64_t> word(words_[i / 64]);
        if ((word.load(std::memory_order_relaxed) & bit) == 0)
            word.fetch_or(bit, std::memory_order_relaxed);
    }
    /// After all are added. @return how many there are
    std::size_t count()
    {
        for (std::size_t w = 0; w < words_.size(); ++w)
            before_[w + 1] = before_[w] + std::uint32_t(std::popcount(words_[w]));
        return before_.back();
    }
    std::uint32_t number(const ivec2& p) const
    {
        const std::size_t i = index(p);
        return before_[i / 64] + std::uint32_t(std::popcount(words_[i / 64] & ((std::uint64_t(1) << (i % 64)) - 1)));
    }
    /// Calls `f(number, sample)` for all, in parallel.
    template <class F> void each(F&& f) const
    {
        parallel_each(words_.size(), grain, [&](std::size_t w) {
            std::uint32_t number = before_[w];
            for (std::uint64_t left = words_[w]; left != 0; left &= left - 1, ++number) {
                const std::size_t i = w * 64 + std::size_t(std::countr_zero(left));
                f(number, ivec2(int(i % columns_), int(i / columns_)));
            }
        });
    }

private:
    std::size_t index(const ivec2& p) const { return std::size_t(p.y) * columns_ + std::size_t(p.x); }
    std::size_t columns_;
    std::vector<std::uint64_t> words_;
    std::vector<std::uint32_t> before_;
};

/// Calls `f(p, q, r)` for the triangles of a mesh: parts inside the map with data at all corners.
template <class F> void each_drawn(const HeightMap& map, const Lattice& lattice, const BisectionTriangle& t, F&& f)
{
    const auto with_data = [&](const ivec2& p, const ivec2& q, const ivec2& r) {
        if (map.has_data(p.x, p.y) && map.has_data(q.x, q.y) && map.has_data(r.x, r.y))
            f(p, q, r);
    };
    if (lattice.is_outside_in_part(t))
        each_fan_triangle(clip_to_map(lattice, t), with_data);
    else
        with_data(t.apex, t.a, t.b);
}

} // namespace

std::vector<BisectionTriangle> triangles_within(const NestedErrors& errors, double tolerance)
{
    if (!(tolerance >= 0))
        throw Error::Input(fmt::format("a tolerance of {} m: it has to be 0 or more", tolerance));
    return find_leaves(errors.lattice, [&](const BisectionTriangle& t) { return double(errors.error(t.middle())) > tolerance; });
}

Mesh terrain_mesh(const HeightMap& map, const Lattice& lattice, std::span<const BisectionTriangle> triangles, std::vector<ivec2>* samples)
{
    CornerNumbers corners(map);
    parallel_each(triangles.size(), grain, [&](std::size_t i) {
        each_drawn(map, lattice, triangles[i], [&](const ivec2& p, const ivec2& q, const ivec2& r) {
            corners.add(p);
            corners.add(q);
            corners.add(r);
        });
    });
    Mesh mesh;
    mesh.positions.resize(corners.count());
    if (samples)
        samples->resize(mesh.positions.size());
    corners.each([&](std::uint32_t number, const ivec2& p) {
        mesh.positions[number] = map.position(p.x, p.y);
        if (samples)
            (*samples)[number] = p;
    });
    mesh.triangles = parallel_collect<uvec3>(triangles.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<uvec3>& out) {
        out.reserve(end - begin);
        for (std::size_t i = begin; i < end; ++i)
            each_drawn(map, lattice, triangles[i],
                       [&](const ivec2& p, const ivec2& q, const ivec2& r) { out.push_back({corners.number(p), corners.number(q), corners.number(r)}); });
    });
    return mesh;
}

Mesh terrain_mesh_within(const HeightMap& map, double tolerance)
{
    const NestedErrors errors = nest_errors(map);
    return terrain_mesh(map, errors.lattice, triangles_within(errors, tolerance));
}

} // namespace limn
