// Checklists 2, 3 and 4 of the terrain specification: what the steps of PAR leave, from any view.

#include <map>

#include <gtest/gtest.h>

#include "terrain/par_support.h"

namespace limn::test {
namespace {

/// A view's test without culling.
struct Trial {
    EdgeTest test;
    Trial(const HeightMap& map, std::uint64_t number)
    {
        Random random(43, number);
        test = screen_height_test(map, any_camera(map, number), std::exp(random.uniform(-2, 3)));
    }
};

/// Each triangle is right-isosceles in integers, turns the same way, and together they cover the lattice once.
void expect_templates(const Lattice& lattice, const std::vector<BisectionTriangle>& triangles)
{
    std::int64_t area2 = 0;
    for (const BisectionTriangle& t : triangles) {
        const ivec2 u = t.a - t.apex, v = t.b - t.apex;
        ASSERT_EQ(u.x * v.x + u.y * v.y, 0);
        ASSERT_EQ(u.x * u.x + u.y * u.y, v.x * v.x + v.y * v.y);
        ASSERT_LT(u.x * v.y - u.y * v.x, 0);
        area2 -= u.x * v.y - u.y * v.x;
    }
    const ivec2 cells = lattice.points() - 1;
    EXPECT_EQ(area2, 2 * std::int64_t(cells.x) * cells.y);
}

void expect_watertight_steps(int views)
{
    const HeightMap map = rough_terrain(61, 49);
    const Lattice lattices[] = {make_lattice(61, 49), make_lattice(61, 49, 3)};
    for (int i = 0; i < views; ++i) {
        const Lattice& lattice = lattices[i % 2];
        const Diagonals diagonals = i % 4 < 2 ? Diagonals::same : Diagonals::alternating;
        const ParResult par = refine_in_parallel(lattice, root_triangles(lattice, diagonals), Trial(map, std::uint64_t(i)).test,
                                                 {.on_step = [&](const std::vector<BisectionTriangle>& triangles) {
                                                     ASSERT_TRUE(is_watertight(lattice, triangles)) << "view " << i;
                                                     expect_templates(lattice, triangles);
                                                 }});
        for (const ParStep& step : par.steps) {
            ASSERT_LE(step.mark_passes, 2 * lattice.level + 1) << "view " << i;
        }
    }
}

TEST(ParMarks, LeaveNoCrackAfterAnyStep) { expect_watertight_steps(60); }
TEST(ParMarks, LeaveNoCrackAfterAnyStepOfAThousandViewsSlow) { expect_watertight_steps(1000); }

/// Checklist 21: what times each stage is told of all of them, in their order.
TEST(ParMarks, AreMadeBetweenTestsAndSplitsInEachStep)
{
    const HeightMap map = rough_terrain(61, 49);
    const Lattice lattice = make_lattice(61, 49);
    std::vector<ParStage> stages;
    const ParResult par = refine_in_parallel(lattice, root_triangles(lattice), middle_height_test(map, 4), {.on_stage = [&](ParStage stage) { stages.push_back(stage); }});
    ASSERT_GT(par.steps.size(), 3u);
    ASSERT_EQ(stages.size(), 3 * par.steps.size());
    for (std::size_t i = 0; i < stages.size(); ++i)
        EXPECT_EQ(int(stages[i]), int(i % 3));
}

TEST(ParMarks, NeedNotBeClearedAndAreAllMade)
{
    const HeightMap map = reference_terrain(129, 129);
    const Lattice lattice = make_lattice(129, 129);
    for (int i = 0; i < 20; ++i) {
        const EdgeTest test = Trial(map, std::uint64_t(i)).test;
        const ParResult kept = refine_in_parallel(lattice, root_triangles(lattice), test),
                        cleared = refine_in_parallel(lattice, root_triangles(lattice), test, {.clear_marks = true});
        EXPECT_EQ(kept.triangles, cleared.triangles);
        ASSERT_EQ(kept.steps.size(), cleared.steps.size());
        for (std::size_t k = 0; k < kept.steps.size(); ++k)
            EXPECT_EQ(kept.steps[k].marks, cleared.steps[k].marks);
        const ParResult again = refine_in_parallel(lattice, kept.triangles, test);
        EXPECT_EQ(again.steps.size(), 1u);
        EXPECT_EQ(again.steps[0].marks, 0u);
        EXPECT_EQ(again.triangles, kept.triangles);
    }
}

/// The same mesh by other means: one bad edge after another, in a random order, each split with all that has to be split first.
class SplitOneByOne {
public:
    SplitOneByOne(const Lattice& lattice, const EdgeTest& test) : test_(test)
    {
        for (const BisectionTriangle& t : root_triangles(lattice))
            add(t);
    }
    std::vector<BisectionTriangle> run(Random random)
    {
        for (;;) {
            std::vector<Edge> bad;
            for (const auto& [edge, triangles] : edges_)
                if (!triangles.empty() && can_split(point(edge.first), point(edge.second)) && test_(point(edge.first), point(edge.second)))
                    bad.push_back(edge);
            if (bad.empty())
                break;
            for (const Edge& edge : {bad[random.next() % bad.size()], bad[0], bad.back()})
                split(edge);
        }
        std::vector<BisectionTriangle> out;
        for (const auto& [edge, triangles] : edges_)
            for (const BisectionTriangle& t : triangles)
                if (edge_of(t.a, t.b) == edge)
                    out.push_back(t);
        return out;
    }

private:
    using Point = std::pair<int, int>;
    using Edge = std::pair<Point, Point>;
    static ivec2 point(const Point& p) { return {p.first, p.second}; }
    static Edge edge_of(const ivec2& p, const ivec2& q)
    {
        const Point a{p.x, p.y}, b{q.x, q.y};
        return a < b ? Edge(a, b) : Edge(b, a);
    }
    void add(const BisectionTriangle& t)
    {
        for (const Edge& edge : {edge_of(t.apex, t.a), edge_of(t.b, t.apex), edge_of(t.a, t.b)})
            edges_[edge].push_back(t);
    }
    void remove(const BisectionTriangle& t)
    {
        for (const Edge& edge : {edge_of(t.apex, t.a), edge_of(t.b, t.apex), edge_of(t.a, t.b)})
            std::erase(edges_[edge], t);
    }
    /// Both triangles of an edge, after those of them that have it as a leg.
    void split(const Edge& edge)
    {
        for (;;) {
            const std::vector<BisectionTriangle> around = edges_[edge];
            const auto leg =
                std::find_if(around.begin(), around.end(), [&](const BisectionTriangle& t) { return edge_of(t.a, t.b) != edge; });
            if (leg != around.end()) {
                split(edge_of(leg->a, leg->b));
                continue;
            }
            for (const BisectionTriangle& t : around) {
                remove(t);
                add(t.left());
                add(t.right());
            }
            return;
        }
    }
    const EdgeTest& test_;
    std::map<Edge, std::vector<BisectionTriangle>> edges_;
};

TEST(ParMarks, GiveTheCoarsestMeshThatPassesInWhateverOrderItIsSplit)
{
    const HeightMap map = reference_terrain(33, 33);
    const Lattice lattice = make_lattice(33, 33);
    for (int i = 0; i < 12; ++i) {
        const EdgeTest test = Trial(map, std::uint64_t(i)).test;
        EXPECT_EQ(set_of(refine_in_parallel(lattice, root_triangles(lattice), test).triangles),
                  set_of(SplitOneByOne(lattice, test).run(Random(5, std::uint64_t(i)))))
            << i;
    }
}

} // namespace
} // namespace limn::test
