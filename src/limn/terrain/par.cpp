#include "limn/terrain/par.h"

#include <cmath>
#include <utility>

#include "limn/base/parallel.h"
#include "limn/formulas/formulas.h"

namespace limn {
namespace {

constexpr std::size_t grain = 2048;
/// Edges of a triangle as bits: apex-a, b-apex, and the hypotenuse.
constexpr unsigned first_leg = 1, second_leg = 2, hypotenuse = 4;

ivec2 middle(const ivec2& p, const ivec2& q) { return {(p.x + q.x) / 2, (p.y + q.y) / 2}; }

/// The edge error map: which edges have to be split, by the lattice point in their middle.
class EdgeErrorMap {
public:
    explicit EdgeErrorMap(const Lattice& lattice) : lattice_(lattice), words_((lattice.point_count() + 63) / 64) {}
    bool is_marked(const ivec2& p) const
    {
        const std::size_t i = lattice_.index(p);
        return (words_[i / 64] >> (i % 64) & 1) != 0;
    }
    void mark(const ivec2& p)
    {
        const std::size_t i = lattice_.index(p);
        words_[i / 64] |= std::uint64_t(1) << (i % 64);
    }

private:
    const Lattice& lattice_;
    std::vector<std::uint64_t> words_;
};

/// The edges of a triangle that the test or a mark splits.
unsigned marked_edges(const EdgeErrorMap& marks, const BisectionTriangle& t, unsigned edges)
{
    const auto with = [&](unsigned bit, const ivec2& p, const ivec2& q) {
        if ((edges & bit) == 0 && can_split(p, q) && marks.is_marked(middle(p, q)))
            edges |= bit;
    };
    with(first_leg, t.apex, t.a);
    with(second_leg, t.b, t.apex);
    with(hypotenuse, t.a, t.b);
    return edges;
}

unsigned tested_edges(const BisectionTriangle& t, const EdgeTest& test)
{
    const auto bit = [&](unsigned value, const ivec2& p, const ivec2& q) { return can_split(p, q) && test(p, q) ? value : 0u; };
    return bit(first_leg, t.apex, t.a) | bit(second_leg, t.b, t.apex) | bit(hypotenuse, t.a, t.b);
}

/// The triangles that a triangle is split into: the templates of the thesis, as bisections.
void append_parts(const BisectionTriangle& t, unsigned edges, std::vector<BisectionTriangle>& out)
{
    if (edges == 0) {
        out.push_back(t);
        return;
    }
    const BisectionTriangle left = t.left(), right = t.right();
    if ((edges & first_leg) != 0) {
        out.push_back(left.left());
        out.push_back(left.right());
    } else {
        out.push_back(left);
    }
    if ((edges & second_leg) != 0) {
        out.push_back(right.left());
        out.push_back(right.right());
    } else {
        out.push_back(right);
    }
}

/// One step: what is split is found by passes that each read the marks of earlier ones.
class Step {
public:
    Step(EdgeErrorMap& marks, const std::vector<BisectionTriangle>& triangles, const EdgeTest& test, const TriangleTest& visible)
        : marks_(marks), triangles_(triangles), edges_(triangles.size())
    {
        parallel_each(triangles.size(), grain, [&](std::size_t i) {
            const bool seen = !visible || visible(triangles[i]);
            edges_[i] = std::uint8_t(seen ? tested_edges(triangles[i], test) : culled);
        });
    }
    /// @return how many marks were made
    std::size_t mark()
    {
        const std::vector<ivec2> found = parallel_collect<ivec2>(triangles_.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<ivec2>& out) {
            for (std::size_t i = begin; i < end; ++i) {
                if (edges_[i] == culled)
                    continue;
                edges_[i] = std::uint8_t(marked_edges(marks_, triangles_[i], edges_[i]));
                if (edges_[i] != 0 && edges_[i] < hypotenuse)
                    out.push_back(triangles_[i].middle());
            }
        });
        for (const ivec2& p : found)
            marks_.mark(p);
        return found.size();
    }
    std::vector<BisectionTriangle> refined() const
    {
        return parallel_collect<BisectionTriangle>(triangles_.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<BisectionTriangle>& out) {
            for (std::size_t i = begin; i < end; ++i)
                append_parts(triangles_[i], edges_[i] == culled ? 0u : edges_[i], out);
        });
    }

private:
    static constexpr std::uint8_t culled = 8;
    EdgeErrorMap& marks_;
    const std::vector<BisectionTriangle>& triangles_;
    std::vector<std::uint8_t> edges_;
};

/// The heights of the ends and of the middle of an edge. Outside the map the nearest sample counts.
class EdgeHeights {
public:
    EdgeHeights(const HeightMap& map, const ivec2& a, const ivec2& b) : a_(height(map, a)), b_(height(map, b)), middle_(height(map, middle(a, b))) {}
    double chord() const { return 0.5 * (a_ + b_); }
    double off() const { return middle_ - chord(); } ///< no number where one of the three has no data
    /// Whether some of the three, but not all, have no data.
    bool has_gap() const { return std::isnan(off()) && !(std::isnan(a_) && std::isnan(b_) && std::isnan(middle_)); }

private:
    static double height(const HeightMap& map, const ivec2& p) { return double(map.height(std::min(p.x, map.columns - 1), std::min(p.y, map.rows - 1))); }
    double a_, b_, middle_;
};

} // namespace

ParResult refine_in_parallel(const Lattice& lattice, std::vector<BisectionTriangle> start, const EdgeTest& test, const TriangleTest& visible,
                             const std::function<void(const std::vector<BisectionTriangle>&)>& on_step)
{
    ParResult result;
    result.triangles = std::move(start);
    EdgeErrorMap marks(lattice); // not cleared from step to step: every marked edge is split in its step, and never comes again
    for (;;) {
        Step step(marks, result.triangles, test, visible);
        ParStep report;
        for (std::size_t made = 1; made > 0; ++report.mark_passes) {
            made = step.mark();
            report.marks += made;
        }
        std::vector<BisectionTriangle> finer = step.refined();
        const bool split = finer.size() != result.triangles.size(); // a split always adds triangles
        result.triangles = std::move(finer);
        report.triangles = result.triangles.size();
        result.steps.push_back(report);
        if (!split)
            return result;
        if (on_step)
            on_step(result.triangles);
    }
}

EdgeTest middle_height_test(const HeightMap& map, double tolerance)
{
    return [&map, tolerance](const ivec2& a, const ivec2& b) {
        const EdgeHeights heights(map, a, b);
        return heights.has_gap() || std::abs(heights.off()) > tolerance;
    };
}

EdgeTest screen_height_test(const HeightMap& map, const Camera& camera, double pixels, double nearest)
{
    const formulas::ErrorCamera axes = {vec3(camera.right()), vec3(camera.above()), vec3(camera.forward()), float(camera.pixels_per_unit(1)), float(nearest),
                                        camera.orthographic ? 1.0f : 0.0f};
    return [&map, axes, eye = camera.eye, pixels](const ivec2& a, const ivec2& b) {
        const EdgeHeights heights(map, a, b);
        if (heights.has_gap())
            return true;
        const ivec2 p = middle(a, b);
        const vec3 place(dvec3(p.x * map.spacing.x, (map.rows - 1 - p.y) * map.spacing.y, heights.chord()) - eye);
        const float off = float(heights.off());
        return double(std::max(formulas::height_error_exact(axes, place, off), formulas::height_error_any_way(axes, place, off))) > pixels;
    };
}

} // namespace limn
