#include "limn/terrain/par.h"

#include <algorithm>
#include <atomic>
#include <bit>
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
    void clear() { std::fill(words_.begin(), words_.end(), 0); }

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

/// Triangles, and which of them the last step made: the edges of others have passed the test.
struct ParMesh {
    std::vector<BisectionTriangle> triangles;
    std::vector<std::uint8_t> fresh;
};

/// One step: what is split is found by passes that each read the marks of earlier ones.
class Step {
public:
    Step(EdgeErrorMap& marks, const ParMesh& mesh, const EdgeTest& test, const TriangleTest& visible)
        : marks_(marks), mesh_(mesh), edges_(mesh.triangles.size())
    {
        std::atomic<std::size_t> tested = 0;
        parallel_blocks(edges_.size(), grain, [&](std::size_t begin, std::size_t end) {
            std::size_t count = 0;
            for (std::size_t i = begin; i < end; ++i) {
                if (mesh.fresh[i] == 0 || (visible && !visible(mesh.triangles[i])))
                    continue;
                edges_[i] = std::uint8_t(tested_edges(mesh.triangles[i], test));
                ++count;
            }
            tested += count;
        });
        tested_ = tested;
    }
    std::size_t tested() const { return tested_; }
    /// @return how many marks were made
    std::size_t mark()
    {
        const std::vector<ivec2> found =
            parallel_collect<ivec2>(edges_.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<ivec2>& out) {
                for (std::size_t i = begin; i < end; ++i) {
                    edges_[i] = std::uint8_t(marked_edges(marks_, mesh_.triangles[i], edges_[i]));
                    if (edges_[i] != 0 && edges_[i] < hypotenuse)
                        out.push_back(mesh_.triangles[i].middle());
                }
            });
        for (const ivec2& p : found)
            marks_.mark(p);
        return found.size();
    }
    ParMesh refined() const
    {
        ParMesh finer;
        finer.triangles = parallel_collect<BisectionTriangle>(edges_.size(), grain,
                                                              [&](std::size_t begin, std::size_t end, std::vector<BisectionTriangle>& out) {
                                                                  for (std::size_t i = begin; i < end; ++i)
                                                                      append_parts(mesh_.triangles[i], edges_[i], out);
                                                              });
        finer.fresh =
            parallel_collect<std::uint8_t>(edges_.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<std::uint8_t>& out) {
                for (std::size_t i = begin; i < end; ++i)
                    out.insert(out.end(), std::size_t(1 + std::popcount(edges_[i])), std::uint8_t(edges_[i] != 0));
            });
        return finer;
    }

private:
    EdgeErrorMap& marks_;
    const ParMesh& mesh_;
    std::vector<std::uint8_t> edges_;
    std::size_t tested_ = 0;
};

/// The heights of the ends and of the middle of an edge. Outside the map the nearest sample counts.
class EdgeHeights {
public:
    EdgeHeights(const HeightMap& map, const ivec2& a, const ivec2& b)
        : a_(height(map, a)), b_(height(map, b)), middle_(height(map, middle(a, b)))
    {
    }
    double chord() const { return 0.5 * (a_ + b_); }
    double off() const { return formulas::height_off_chord(a_, middle_, b_); } ///< no number where one of the three has no data
    /// Whether some of the three, but not all, have no data.
    bool has_gap() const { return std::isnan(off()) && !(std::isnan(a_) && std::isnan(b_) && std::isnan(middle_)); }

private:
    static double height(const HeightMap& map, const ivec2& p)
    {
        return double(map.height(std::min(p.x, map.columns - 1), std::min(p.y, map.rows - 1)));
    }
    double a_, b_, middle_;
};

} // namespace

ParResult refine_in_parallel(const Lattice& lattice, std::vector<BisectionTriangle> start, const EdgeTest& test, const ParOptions& options)
{
    ParResult result;
    ParMesh mesh = {std::move(start), {}};
    mesh.fresh.assign(mesh.triangles.size(), 1);
    const auto done = [&](ParStage stage) {
        if (options.on_stage)
            options.on_stage(stage);
    };
    EdgeErrorMap marks(lattice); // need not be cleared from step to step: every marked edge is split in its step, and never comes again
    for (;;) {
        if (options.clear_marks)
            marks.clear();
        Step step(marks, mesh, test, options.visible);
        ParStep report;
        report.tested = step.tested();
        done(ParStage::test);
        for (std::size_t made = 1; made > 0; ++report.mark_passes) {
            made = step.mark();
            report.marks += made;
        }
        done(ParStage::mark);
        ParMesh finer = step.refined();
        done(ParStage::split);
        const bool split = finer.triangles.size() != mesh.triangles.size(); // a split always adds triangles
        mesh = std::move(finer);
        report.triangles = mesh.triangles.size();
        result.steps.push_back(report);
        if (!split)
            break;
        if (options.on_step)
            options.on_step(mesh.triangles);
    }
    result.triangles = std::move(mesh.triangles);
    return result;
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
    const formulas::ErrorCamera axes = {vec3(camera.right()),   vec3(camera.above()),
                                        vec3(camera.forward()), float(camera.pixels_per_unit(1)),
                                        float(nearest),         camera.orthographic ? 1.0f : 0.0f};
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
