// Lines along mesh edges that the contour draws already: every edge of a sharp solid is drawn once.

#include "limn/lines/inked_edges.h"

#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/lines/draw.h"
#include "limn/lines/prepare.h"
#include "lines/cameras.h"
#include "lines/edge_shapes.h"

namespace limn {
namespace {

using namespace test;

LineOptions technical(Hidden hidden = Hidden::remove)
{
    LineOptions options;
    options.lines = {LineType::contour, LineType::crease, LineType::border};
    options.hidden = hidden;
    return options;
}

Drawing draw_solid(const Mesh& mesh, const Camera& camera, const LineOptions& options)
{
    const PreparedMesh prepared = prepare_mesh(mesh);
    const PlacedSurface placed = prepared.placed();
    const LineModel model = build_line_model({&placed, 1});
    return draw_lines(model, build_ray_scene(model), camera, options);
}

double length_of(const Stroke& s)
{
    double length = 0;
    for (std::size_t i = s.closed ? 0 : 1; i < s.points.size(); ++i)
        length += glm::distance(s.points[i], s.points[(i + s.points.size() - 1) % s.points.size()]);
    return length;
}

double visible_length(const Drawing& drawing)
{
    return std::accumulate(drawing.strokes.begin(), drawing.strokes.end(), 0.0, [](double sum, const Stroke& s) { return s.visible ? sum + length_of(s) : sum; });
}

dvec2 in_picture(const Camera& camera, const dvec3& p)
{
    const double pixels = camera.size.y / camera.ortho_height;
    return dvec2(camera.size) / 2.0 + pixels * dvec2(glm::dot(p - camera.look, camera.right()), -glm::dot(p - camera.look, camera.above()));
}

/// Calls f(a, b, visible) for the twelve edges of [-1,1]^3, seen in parallel projection: visible where a side at it faces the eye.
template <class F> void each_cube_edge(const Camera& camera, F&& f)
{
    const dvec3 to_eye = -camera.forward();
    for (int axis = 0; axis < 3; ++axis)
        for (const double u : {-1.0, 1.0})
            for (const double v : {-1.0, 1.0}) {
                dvec3 a, b;
                a[axis] = -1, b[axis] = 1;
                a[(axis + 1) % 3] = b[(axis + 1) % 3] = u;
                a[(axis + 2) % 3] = b[(axis + 2) % 3] = v;
                f(a, b, u * to_eye[(axis + 1) % 3] > 0 || v * to_eye[(axis + 2) % 3] > 0);
            }
}

TEST(InkedEdges, EveryVisibleEdgeOfACubeIsDrawnOnce)
{
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const Camera camera = random_camera(cube().bounds(), seed, true);
        double expected = 0;
        each_cube_edge(camera, [&](const dvec3& a, const dvec3& b, bool visible) {
            if (visible)
                expected += glm::distance(in_picture(camera, a), in_picture(camera, b));
        });
        EXPECT_NEAR(visible_length(draw_solid(cube(), camera, technical())), expected, 0.01 * expected) << "seed " << seed;
    }
}

TEST(InkedEdges, HiddenEdgesOfACubeAreKeptAndEachIsDrawnOnce)
{
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const Camera camera = random_camera(cube().bounds(), seed, true);
        double expected = 0, drawn = 0;
        each_cube_edge(camera, [&](const dvec3& a, const dvec3& b, bool) { expected += glm::distance(in_picture(camera, a), in_picture(camera, b)); });
        for (const Stroke& s : draw_solid(cube(), camera, technical(Hidden::dash)).strokes)
            drawn += length_of(s);
        EXPECT_NEAR(drawn, expected, 0.01 * expected) << "seed " << seed;
    }
}

TEST(InkedEdges, WithoutContoursACreaseIsDrawnWhole)
{
    LineOptions creases = technical();
    creases.lines = {LineType::crease};
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const Camera camera = random_camera(cube().bounds(), seed, true);
        EXPECT_NEAR(visible_length(draw_solid(cube(), camera, creases)), visible_length(draw_solid(cube(), camera, technical())), 3) << "seed " << seed;
    }
}

/// How often visible strokes pass within half a pixel of a point in the picture.
int passes(const Drawing& drawing, const dvec2& p)
{
    int count = 0;
    for (const Stroke& s : drawing.strokes) {
        bool near = false;
        for (std::size_t i = s.closed ? 0 : 1; s.visible && i < s.points.size(); ++i) {
            const dvec2 a = s.points[(i + s.points.size() - 1) % s.points.size()], d = s.points[i] - a;
            const double t = glm::dot(d, d) > 0 ? glm::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0) : 0;
            near = near || glm::distance(a + t * d, p) < 0.5;
        }
        count += near;
    }
    return count;
}

TEST(InkedEdges, EveryRimEdgeOfACylinderIsDrawnOnce)
{
    constexpr int sides = 64;
    int views = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const Mesh mesh = cylinder(sides);
        const Camera camera = random_camera(mesh.bounds(), seed, true);
        const Drawing drawing = draw_solid(mesh, camera, technical());
        const dvec3 to_eye = -camera.forward();
        if (std::abs(to_eye.z) < 0.15 || std::abs(to_eye.z) > 0.98)
            continue; // the rims are too narrow in the picture, or lie upon each other
        ++views;
        for (int i = 0; i < sides; ++i)
            for (int k = 0; k < 2; ++k) {
                const dvec3 p = 0.5 * (mesh.positions[std::size_t(2 * i + k)] + mesh.positions[std::size_t(2 * ((i + 1) % sides) + k)]);
                const bool side = p.x * to_eye.x + p.y * to_eye.y > 0, cap = p.z * to_eye.z > 0;
                // The side's lines end on the rim, where two strokes meet.
                const bool at_turn = std::abs(p.x * to_eye.x + p.y * to_eye.y) < 0.4 * std::hypot(to_eye.x, to_eye.y);
                if ((side || cap) && !at_turn) {
                    EXPECT_EQ(passes(drawing, in_picture(camera, p)), 1) << fmt::format("seed {} edge {} of rim {}", seed, i, k);
                }
            }
    }
    EXPECT_GE(views, 6);
}

// Its side faces are thirty times as long as its rim edges.
TEST(InkedEdges, RimsOfACylinderOfLongNarrowFacesAreVisibleWhereASideFacesTheEye)
{
    LineOptions creases = technical();
    creases.lines = {LineType::crease};
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const Mesh mesh = cylinder(90);
        const Camera camera = random_camera(mesh.bounds(), seed, true);
        const dvec3 to_eye = -camera.forward();
        double expected = 0;
        for (std::size_t v = 0; v < 180; ++v) {
            const dvec3 a = mesh.positions[v], b = mesh.positions[(v + 2) % 180], middle = 0.5 * (a + b);
            if (middle.x * to_eye.x + middle.y * to_eye.y > 0 || middle.z * to_eye.z > 0)
                expected += glm::distance(in_picture(camera, a), in_picture(camera, b));
        }
        EXPECT_NEAR(visible_length(draw_solid(mesh, camera, creases)), expected, 0.02 * expected) << "seed " << seed;
    }
}

TEST(InkedEdges, APartOfAnEdgeIsLeftOutUnderAPartOfAContour)
{
    const PreparedMesh prepared = prepare_mesh(cube());
    const PlacedSurface placed = prepared.placed();
    const LineModel model = build_line_model({&placed, 1});
    const Segment edge = edge_segments(model, find_creases(model)).front();
    Segment contour = edge;
    contour.a = glm::mix(edge.a, edge.b, 0.25f);
    std::swap(contour.face, contour.other);
    const auto whole = [](bool visible) { return ChainElements{{{0, 0, 1, 1, 1, false, false, false, visible}}, {0, 1}}; };
    const auto marks = [&](bool contour_visible, bool visible) {
        ChainElements decided = whole(visible);
        mark_inked(model, find_inked_parts(model, {&contour, 1}, whole(contour_visible)), {&edge, 1}, decided);
        EXPECT_EQ(decided.start, (std::vector<std::uint32_t>{0, 2}));
        EXPECT_EQ(decided.elements.size(), 2u);
        EXPECT_NEAR(decided.elements.front().t1, 0.25f, 1e-5f);
        EXPECT_EQ(decided.elements.front().t1, decided.elements.back().t0);
        EXPECT_FALSE(decided.elements.front().inked);
        for (const Element& e : decided.elements)
            EXPECT_EQ(e.visible, visible);
        return decided.elements.back().inked;
    };
    EXPECT_TRUE(marks(true, true));
    EXPECT_TRUE(marks(true, false));
    EXPECT_TRUE(marks(false, false));
    EXPECT_FALSE(marks(false, true)); // what is seen is never lost
}

} // namespace
} // namespace limn
