// Adaptive smoothing: the terrain specification, checklist 12 to 16.

#include "limn/terrain/hermite_smoothing.h"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/base/random.h"
#include "limn/geometry/adjacency.h"
#include "limn/raycast/ray_scene.h"
#include "limn/surface/neighbours.h"
#include "limn/terrain/measure_terrain.h"
#include "limn/terrain/terrain_mesh.h"
#include "terrain/terrain_support.h"
#include "terrain/uniform_hermite.h"

namespace limn::test {
namespace {

using namespace formulas;

constexpr HermiteOptions seed_options = {HermiteRule::seed, 0.5, Reclassify::first};

Mesh mesh_of(const NormalMesh& from)
{
    Mesh mesh;
    mesh.positions = from.positions, mesh.triangles = from.triangles;
    return mesh;
}

std::vector<dvec3> mesh_normals(const Mesh& mesh) { return area_normals(mesh.positions, mesh.triangles, build_vertex_faces(mesh.triangles, mesh.positions.size())); }

/// How often each edge is used, by its vertices.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses_of_edges(const Mesh& mesh)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            ++uses[std::minmax(t[k], t[(k + 1) % 3])];
    return uses;
}

bool is_closed(const Mesh& mesh)
{
    const auto uses = uses_of_edges(mesh);
    return std::all_of(uses.begin(), uses.end(), [](const auto& use) { return use.second == 2; });
}

/// How far the curve of an edge is from it, where the rule looks.
double edge_error(const SmoothedMesh& made, std::uint32_t a, std::uint32_t b, double weight, bool quarters)
{
    const dvec3 &p1 = made.mesh.positions[a], &p2 = made.mesh.positions[b];
    const EdgeTangents t = edge_tangents(p1, p2, made.normals[a], made.normals[b]);
    double error = glm::length(across_edge(p1, p2, edge_middle(p1, p2, t, weight) - p1));
    if (quarters)
        for (const dvec3& off : {edge_quarter(t, weight), edge_three_quarters(t, weight)})
            error = std::max(error, glm::length(across_edge(p1, p2, off)));
    return error;
}

/// Checklist 13: all edges but straight ones are near their curves.
TEST(HermiteSmoothing, LeavesNoEdgeFurtherThanTheBound)
{
    const HeightMap map = reference_terrain(65, 65);
    for (const double sigma : {1.0, 0.3})
        for (const HermiteOptions& options : {HermiteOptions(), HermiteOptions{HermiteRule::repaired, 1, Reclassify::every}, seed_options}) {
            const SmoothedMesh made = smooth_mesh(terrain_mesh_within(map, 20), {sigma}, options);
            ASSERT_TRUE(made.within_bound) << sigma;
            ASSERT_GT(made.triangles.size(), 1u);
            std::size_t straight = 0;
            for (std::size_t i = 0; i < made.mesh.triangles.size(); ++i) {
                const uvec3& t = made.mesh.triangles[i];
                const std::pair<std::uint32_t, std::uint32_t> sides[] = {std::minmax(t.x, t.y), std::minmax(t.z, t.x), std::minmax(t.y, t.z)};
                for (unsigned k = 0; k < 3; ++k) {
                    if ((made.straight[i] >> k & 1) != 0)
                        ++straight;
                    else
                        ASSERT_LE(edge_error(made, sides[k].first, sides[k].second, options.tangents, options.rule == HermiteRule::repaired), sigma) << i;
                }
            }
            EXPECT_EQ(straight > 0, options.rule == HermiteRule::seed);
        }
}

/// Checklist 13: levels, two bisections each, within one of log4.
TEST(HermiteSmoothing, TakesAsManyLevelsAsExpected)
{
    const NormalMesh ball = icosahedron();
    const Mesh mesh = with_longest_sides_last(mesh_of(ball));
    const double whole = glm::length(across_edge(ball.positions[ball.triangles[0].x], ball.positions[ball.triangles[0].y],
                                                 middle_of(ball, ball.triangles[0].x, ball.triangles[0].y, 1) - ball.positions[ball.triangles[0].x]));
    for (const double sigma : {0.1, 0.02, 0.004, 0.0008, 0.0002}) {
        HermiteOptions options;
        const SmoothedMesh made = smooth_with_normals(mesh, ball.normals, {sigma}, options);
        const double levels = std::log(whole / sigma) / std::log(4);
        EXPECT_NEAR(double(made.triangles.size()), std::ceil(levels), 1) << sigma;
    }
}

/// A repaired smoothing of a closed mesh is closed, with each edge in two triangles, and all normals and vertices of the old one stay.
TEST(HermiteSmoothing, KeepsClosedMeshesClosed)
{
    const NormalMesh ball = icosahedron();
    for (const double sigma : {0.02, 0.001}) {
        const SmoothedMesh made = smooth_mesh(mesh_of(ball), {sigma});
        EXPECT_TRUE(is_closed(made.mesh));
        EXPECT_TRUE(std::equal(ball.positions.begin(), ball.positions.end(), made.mesh.positions.begin()));
        double off = 0;
        for (const dvec3& p : made.mesh.positions)
            off = std::max(off, std::abs(glm::length(p) - 1));
        EXPECT_LT(off, 0.02) << sigma; // a sphere, nearly
    }
}

/// Only what a view shows is refined, but edges stay shared.
TEST(HermiteSmoothing, RefinesForAView)
{
    const HeightMap map = reference_terrain(129, 129);
    const Mesh coarse = terrain_mesh_within(map, 30);
    Camera camera;
    camera.eye = {64, -60, 600}, camera.look = {64, 64, 200}, camera.up = {0, 0, 1}, camera.size = {400, 300};
    const SmoothedMesh near = smooth_mesh(coarse, {0.5, camera});
    EXPECT_TRUE(near.within_bound);
    for (const auto& [edge, uses] : uses_of_edges(near.mesh))
        ASSERT_LE(uses, 2);
    camera.eye.z = 3000, camera.eye.y = -900;
    const SmoothedMesh far = smooth_mesh(coarse, {0.5, camera});
    EXPECT_LT(far.mesh.triangles.size(), near.mesh.triangles.size());
    camera.look = {64, -500, 200}, camera.eye = {64, -400, 200}; // looks away
    EXPECT_EQ(smooth_mesh(coarse, {0.5, camera}).mesh.triangles.size(), coarse.triangles.size());
    for (const dvec3& p : near.mesh.positions)
        ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
}

/// A camera inside the mesh, at an edge and looking along it: there is an end, and no NaN.
TEST(HermiteSmoothing, EndsNearTheEye)
{
    Camera camera;
    const NormalMesh ball = icosahedron();
    camera.eye = 0.5 * (ball.positions[0] + ball.positions[1]), camera.look = ball.positions[1], camera.up = ball.positions[0] + ball.positions[1];
    camera.size = {64, 64};
    const SmoothedMesh made = smooth_mesh(mesh_of(ball), {4, camera});
    for (const dvec3& p : made.mesh.positions)
        ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
    EXPECT_TRUE(is_closed(made.mesh));
}

/// The specification's prototype: triangles on their own, each of which knows nothing of its neighbours.
struct SoupTriangle {
    std::array<dvec3, 3> p, n;
    unsigned straight = 0;
};

class Soup {
public:
    Soup(double sigma, double weight, bool sorted) : sigma_(sigma), weight_(weight), sorted_(sorted) {}
    std::vector<SoupTriangle> smooth(std::vector<SoupTriangle> all) const
    {
        for (bool first = true, split = true; split; first = false) {
            split = false;
            std::vector<SoupTriangle> finer;
            for (const SoupTriangle& t : all)
                split = append(t, first, finer) || split;
            all = std::move(finer);
        }
        return all;
    }

private:
    struct Vertex {
        dvec3 p, n;
    };
    static bool is_before(const dvec3& a, const dvec3& b) { return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z}; }
    Vertex middle(const SoupTriangle& t, std::size_t i, std::size_t j, bool straight, bool mirrors) const
    {
        if (sorted_ && is_before(t.p[j], t.p[i]))
            std::swap(i, j);
        const dvec3 &p1 = t.p[i], &p2 = t.p[j], &n1 = t.n[i], &n2 = t.n[j];
        if (straight)
            return {0.5 * (p1 + p2), edge_normal(p1, p2, n1, n2, 0.5, false)};
        const dvec3 p = edge_middle(p1, p2, edge_tangents(p1, p2, n1, n2), weight_);
        return {p, edge_normal(p1, p2, n1, n2, along_edge(p1, p2, p), mirrors && is_serpentine(p1, p2, n1, n2))};
    }
    bool is_far(const SoupTriangle& t, std::size_t i, std::size_t j) const
    {
        return glm::length(across_edge(t.p[i], t.p[j], edge_middle(t.p[i], t.p[j], edge_tangents(t.p[i], t.p[j], t.n[i], t.n[j]), weight_) - t.p[i])) > sigma_;
    }
    bool append(const SoupTriangle& t, bool mirrors, std::vector<SoupTriangle>& out) const
    {
        constexpr std::size_t ends[3][2] = {{0, 1}, {2, 0}, {1, 2}};
        bool split[3], forced = false;
        for (unsigned k = 0; k < 3; ++k)
            split[k] = (t.straight >> k & 1) == 0 && is_far(t, ends[k][0], ends[k][1]);
        if (!split[0] && !split[1] && !split[2]) {
            out.push_back(t);
            return false;
        }
        forced = !split[2];
        const bool f[3] = {(t.straight & 1) != 0, (t.straight & 2) != 0, (t.straight & 4) != 0 || forced};
        const Vertex c = {t.p[0], t.n[0]}, a = {t.p[1], t.n[1]}, b = {t.p[2], t.n[2]}, m = middle(t, 1, 2, forced, mirrors);
        const auto add = [&](const Vertex& u, const Vertex& v, const Vertex& w, bool g0, bool g1, bool g2) {
            out.push_back({{u.p, v.p, w.p}, {u.n, v.n, w.n}, unsigned(g0) + 2 * unsigned(g1) + 4 * unsigned(g2)});
        };
        if (split[0]) {
            const Vertex p = middle(t, 0, 1, false, mirrors);
            add(p, m, c, false, f[0], false), add(p, a, m, f[0], false, f[2]);
        } else {
            add(m, c, a, false, f[2], f[0]);
        }
        if (split[1]) {
            const Vertex q = middle(t, 2, 0, false, mirrors);
            add(q, m, b, false, f[1], f[2]), add(q, c, m, f[1], false, false);
        } else {
            add(m, b, c, f[2], false, f[1]);
        }
        return true;
    }
    double sigma_, weight_;
    bool sorted_;
};

std::vector<SoupTriangle> soup_of(const Mesh& mesh, const std::vector<dvec3>& normals)
{
    std::vector<SoupTriangle> all;
    for (const uvec3& t : mesh.triangles)
        all.push_back({{mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]}, {normals[t.x], normals[t.y], normals[t.z]}});
    return all;
}

using Place = std::array<double, 3>;
std::array<Place, 3> rounded(const std::array<dvec3, 3>& p)
{
    std::array<Place, 3> out;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            out[i][k] = std::round(p[i][int(k)] * 1e6);
    std::sort(out.begin(), out.end());
    return out;
}

/// The rule as published, against a smoothing of triangles that know nothing of each other.
TEST(HermiteSmoothing, WithTheSeedsRuleIsThatOfSeparateTriangles)
{
    const Mesh mesh = with_longest_sides_last(terrain_mesh_within(reference_terrain(65, 65), 20));
    const std::vector<dvec3> normals = mesh_normals(mesh);
    const SmoothedMesh made = smooth_with_normals(mesh, normals, {0.5}, seed_options);
    const std::vector<SoupTriangle> soup = Soup(0.5, 0.5, true).smooth(soup_of(mesh, normals));
    ASSERT_EQ(made.mesh.triangles.size(), soup.size());
    std::vector<std::array<Place, 3>> found, wanted;
    for (const uvec3& t : made.mesh.triangles)
        found.push_back(rounded({made.mesh.positions[t.x], made.mesh.positions[t.y], made.mesh.positions[t.z]}));
    for (const SoupTriangle& t : soup)
        wanted.push_back(rounded(t.p));
    std::sort(found.begin(), found.end());
    std::sort(wanted.begin(), wanted.end());
    std::size_t different = 0; // but for places where rounding to six digits decides
    for (std::size_t i = 0; i < found.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t x = 0; x < 3; ++x)
                different += std::abs(found[i][k][x] - wanted[i][k][x]) > 1.5;
    EXPECT_EQ(different, 0u);
}

using SoupEdge = std::pair<Place, Place>;
SoupEdge edge_between(const dvec3& a, const dvec3& b)
{
    const Place p = {a.x, a.y, a.z}, q = {b.x, b.y, b.z};
    return p < q ? SoupEdge{p, q} : SoupEdge{q, p};
}

/// Sides that have no twin of the same bits: those on the border and at T-vertices, which are straight, and those that rounding tore apart.
std::size_t torn_sides(const std::vector<SoupTriangle>& soup)
{
    std::map<SoupEdge, int> uses;
    for (const SoupTriangle& t : soup)
        for (std::size_t k = 0; k < 3; ++k)
            ++uses[edge_between(t.p[k], t.p[(k + 1) % 3])];
    return std::size_t(std::count_if(uses.begin(), uses.end(), [](const auto& use) { return use.second != 2; }));
}

/// Checklist 14: where both triangles name the ends of their edge in the same order, its vertices have the same bits.
TEST(HermiteSmoothing, NeedsOneOrderOfEnds)
{
    const NormalMesh ball = icosahedron(); // of equal edges: none is split for the sake of another
    const std::vector<SoupTriangle> soup = soup_of(mesh_of(ball), ball.normals);
    const std::vector<SoupTriangle> sorted = Soup(2e-4, 1, true).smooth(soup), unsorted = Soup(2e-4, 1, false).smooth(soup);
    const std::size_t straight = std::size_t(std::count_if(sorted.begin(), sorted.end(), [](const SoupTriangle& t) { return t.straight != 0; }));
    const std::size_t torn = torn_sides(sorted), torn_unsorted = torn_sides(unsorted);
    fmt::print("[ measured ] {} triangles, {} with straight sides: {} sides without twins in one order, {} else\n", sorted.size(), straight, torn, torn_unsorted);
    EXPECT_GT(torn_unsorted, torn);
}

/// Checklist 14: what is split in one triangle only stays on the line of its edge.
TEST(HermiteSmoothing, OfTheSeedKeepsStraightSidesStraight)
{
    const Mesh coarse = with_longest_sides_last(terrain_mesh_within(reference_terrain(65, 65), 20));
    const SmoothedMesh made = smooth_with_normals(coarse, mesh_normals(coarse), {0.5}, seed_options);
    // Sides without a twin, inside: each is a part of a longer one, or made of shorter ones, and these are on one line.
    std::map<std::uint32_t, std::vector<std::uint32_t>> single; // by the lower end
    const auto uses = uses_of_edges(made.mesh);
    for (const auto& [edge, count] : uses) {
        if (count != 1)
            continue;
        single[edge.first].push_back(edge.second);
        single[edge.second].push_back(edge.first);
    }
    double furthest = 0;
    std::size_t checked = 0;
    for (std::size_t i = 0; i < made.mesh.triangles.size(); ++i)
        for (unsigned k = 0; k < 3; ++k)
            if ((made.straight[i] >> k & 1) != 0) {
                const glm::uvec2 corners = k == 0 ? glm::uvec2(0, 1) : k == 1 ? glm::uvec2(2, 0) : glm::uvec2(1, 2);
                const uvec3& t = made.mesh.triangles[i];
                const std::uint32_t a = t[int(corners.x)], b = t[int(corners.y)];
                // The T-vertex has two straight sides that go on from each other.
                for (const auto& [at, from] : {std::pair(a, b), std::pair(b, a)})
                    for (const std::uint32_t next : single[at]) {
                        const dvec3 u = made.mesh.positions[at] - made.mesh.positions[from], v = made.mesh.positions[next] - made.mesh.positions[at];
                        if (next == from || glm::dot(u, v) < 0.999999 * glm::length(u) * glm::length(v))
                            continue;
                        furthest = std::max(furthest, glm::length(glm::cross(u, v)) / (glm::length(u) * glm::length(u + v)));
                        ++checked;
                    }
            }
    EXPECT_GT(checked, 100u);
    EXPECT_LE(furthest, 1e-6);
}

/// Checklist 14 and 16: seen from above there is no hole, by either rule.
TEST(HermiteSmoothing, CoversTheMap)
{
    const HeightMap map = reference_terrain();
    HeightMap inside = map; // borders are curves that leave the map's rectangle a little
    for (int y = 0; y < map.rows; ++y)
        for (int x = 0; x < map.columns; ++x)
            if (std::min({x, y, map.columns - 1 - x, map.rows - 1 - y}) < 12)
                inside.heights[map.index(x, y)] = std::nanf("");
    for (const HermiteOptions& options : {HermiteOptions(), seed_options}) {
        const SmoothedMesh made = smooth_mesh(terrain_mesh_within(map, 30), {1.0}, options);
        EXPECT_EQ(measure_terrain(inside, made.mesh, 30).bare, 0u);
    }
}

/// Checklist 14: through no pixel of random views can one see the inside of a smoothed closed mesh, whose unequal edges force splits.
TEST(HermiteSmoothing, HasNoHolesInPictures)
{
    NormalMesh ball = icosahedron();
    for (std::size_t i = 0; i < ball.positions.size(); ++i)
        ball.positions[i] *= dvec3(1.6, 1.1, 0.7);
    for (const HermiteOptions& options : {HermiteOptions(), seed_options}) {
        const SmoothedMesh made = smooth_mesh(mesh_of(ball), {0.002}, options);
        EXPECT_EQ(is_closed(made.mesh), options.rule == HermiteRule::repaired); // the seed's has T-vertices
        std::vector<vec3> places(made.mesh.positions.begin(), made.mesh.positions.end());
        places.emplace_back(0); // a spare one for the tracer
        const RayScene rays(std::array{RayTriangles{std::span(places).first(places.size() - 1), made.mesh.triangles}});
        std::size_t holes = 0;
        for (std::uint64_t view = 0; view < 20; ++view) {
            Random random(31, view);
            const dvec3 eye = 5.0 * glm::normalize(dvec3(random.normal(), random.normal(), random.normal()));
            const Camera camera = {eye, {0, 0, 0}, {0.1, 0.2, 1}, 10, false, 2, {200, 200}};
            for (int y = 0; y < 200; ++y)
                for (int x = 0; x < 200; ++x) {
                    const Camera::Ray ray = camera.ray({x + 0.5, y + 0.5});
                    if (glm::length(glm::cross(ray.origin, ray.direction)) > 0.5) // from the middle; the mesh is further out
                        continue;
                    const Hit hit = rays.closest({vec3(ray.origin), vec3(ray.direction)});
                    holes += !hit || double(hit.distance) > 5;
                }
        }
        EXPECT_EQ(holes, 0u);
    }
}

TEST(HermiteSmoothing, IsTheSameForAnyNumberOfThreads)
{
    const Mesh coarse = terrain_mesh_within(reference_terrain(129, 129), 15);
    for (const HermiteOptions& options : {HermiteOptions(), seed_options}) {
        const SmoothedMesh one = with_threads(1, [&] { return smooth_mesh(coarse, {0.5}, options); });
        const SmoothedMesh two = with_threads(2, [&] { return smooth_mesh(coarse, {0.5}, options); });
        EXPECT_EQ(one.mesh.positions, two.mesh.positions);
        EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
        EXPECT_EQ(one.normals, two.normals);
        EXPECT_EQ(one.straight, two.straight);
    }
}

/// S-shaped edges are found at their quarters by the repaired rule alone.
TEST(HermiteSmoothing, SplitsSShapedEdges)
{
    Mesh mesh;
    mesh.positions = {{0, 1, 0}, {0, 0, 0}, {1, 0, 0}};
    mesh.triangles.emplace_back(0u, 1u, 2u);
    const dvec3 leaning = glm::normalize(dvec3(-0.3, 0, 1));
    const std::vector<dvec3> normals(3, leaning);
    const auto splits = [&](const HermiteOptions& options) { return !smooth_with_normals(mesh, normals, {0.02}, options).triangles.empty(); };
    EXPECT_TRUE(splits({}));
    EXPECT_FALSE(splits({HermiteRule::seed, 1}));
}

TEST(HermiteSmoothing, KeepsWhatMustNotMove)
{
    const HeightMap map = reference_terrain(65, 65);
    const Mesh coarse = with_longest_sides_last(terrain_mesh_within(map, 20));
    HermiteLimits limits;
    limits.straight.assign(coarse.triangles.size(), 7);
    EXPECT_EQ(smooth_with_normals(coarse, mesh_normals(coarse), {0.5}, {}, limits).mesh.triangles, coarse.triangles);
    limits.straight.clear();
    limits.vertical.assign(coarse.triangles.size(), 2.5);
    const SmoothedMesh made = smooth_with_normals(coarse, mesh_normals(coarse), {0.25}, {}, limits);
    ASSERT_GT(made.triangles.size(), 2u);
    // Vertices moved up and down only: each is above or below the place of the coarse mesh that it comes from.
    double most = 0;
    for (const dvec3& p : made.mesh.positions)
        for (const uvec3& t : coarse.triangles) {
            const dvec3 &a = coarse.positions[t.x], &b = coarse.positions[t.y], &c = coarse.positions[t.z];
            const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
            const double u = ((b.x - p.x) * (c.y - p.y) - (b.y - p.y) * (c.x - p.x)) / area, v = ((c.x - p.x) * (a.y - p.y) - (c.y - p.y) * (a.x - p.x)) / area, w = 1 - u - v;
            if (std::min({u, v, w}) >= -1e-9)
                most = std::max(most, std::abs(p.z - (u * a.z + v * b.z + w * c.z)));
        }
    EXPECT_LE(most, 2.5 * (1 + 1e-9));
    EXPECT_GT(most, 1.0);
}

TEST(HermiteSmoothing, KeepsColoursAndGroups)
{
    const NormalMesh ball = icosahedron();
    Mesh mesh = mesh_of(ball);
    for (std::size_t i = 0; i < 12; ++i)
        mesh.colours.emplace_back(float(i) / 12, 0, 1, 1);
    for (std::uint32_t i = 0; i < 20; ++i)
        mesh.face_groups.push_back(i % 3);
    mesh.group_names = {"a", "b", "c"};
    const SmoothedMesh made = smooth_mesh(mesh, {0.01});
    ASSERT_EQ(made.mesh.colours.size(), made.mesh.positions.size());
    ASSERT_EQ(made.mesh.face_groups.size(), made.mesh.triangles.size());
    ASSERT_EQ(made.mesh.corner_normals.size(), 3 * made.mesh.triangles.size());
    std::array<double, 3> areas = {};
    for (std::size_t i = 0; i < made.mesh.triangles.size(); ++i)
        areas[made.mesh.face_groups[i]] += 1;
    EXPECT_NEAR(areas[0] / 7, areas[2] / 6, 0.35 * areas[2] / 6);
    for (const vec4& colour : made.mesh.colours)
        EXPECT_TRUE(colour.x >= 0 && colour.x <= 1 && colour.z == 1);
}

TEST(HermiteSmoothing, RefusesWhatItCannotDo)
{
    const Mesh mesh = mesh_of(icosahedron());
    const std::vector<dvec3> normals = icosahedron().normals;
    EXPECT_THROW(smooth_with_normals(mesh, normals, {0}), Error::Input);
    EXPECT_THROW(smooth_with_normals(mesh, normals, {-1}), Error::Input);
    EXPECT_THROW(smooth_with_normals(mesh, normals, {std::nan("")}), Error::Input);
    EXPECT_THROW(smooth_with_normals(mesh, normals, {1}, {HermiteRule::seed, 1.5}), Error::Input);
    EXPECT_THROW(smooth_with_normals(mesh, {}, {1}), Error::Input);
    EXPECT_THROW(smooth_with_normals(mesh, normals, {1}, {}, {{1}, {}}), Error::Input);
    EXPECT_TRUE(smooth_mesh({}, {1}).mesh.triangles.empty());
    HermiteOptions few;
    few.passes = 1;
    EXPECT_FALSE(smooth_mesh(mesh, {1e-3}, few).within_bound);
}

} // namespace
} // namespace limn::test
