#include <gtest/gtest.h>

#include <map>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/geometry/triangle_distance.h"
#include "limn/subdivision/pn_curve.h"
#include "subdivision/seed_views.h"

namespace limn::test {
namespace {

SeedOptions options_of(int points, SeedTriangulation triangulation, int depth = 5)
{
    SeedOptions options;
    options.depth = depth;
    options.curve_points = points;
    options.triangulation = triangulation;
    return options;
}

const std::vector<SeedTriangulation> both = {SeedTriangulation::strip, SeedTriangulation::sliver};

/// A double pyramid that is sharp around its belt and along some edges to its tip.
Mesh creased_mesh()
{
    Mesh mesh = shaken(tagged_pyramid(8, 3), 0.1);
    for (std::uint32_t i = 0; i < 8; ++i)
        mesh.creases.push_back({2 + i, 2 + (i + 1) % 8, infinitely_sharp});
    return mesh;
}

std::size_t crossed_faces(const Posed& p, const SeedCrossings& found)
{
    std::size_t count = 0;
    for (std::uint32_t f = 0; f < p.surface.topology.triangles.size(); ++f)
        count += found.of(p.surface.side[3 * f]) != none || found.of(p.surface.side[3 * f + 1]) != none;
    return count;
}

/// Half-edges without one that runs the other way, as start and end.
std::vector<std::pair<std::uint32_t, std::uint32_t>> unpaired(const Mesh& mesh)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> seen;
    for (const uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            ++seen[{t[k], t[(k + 1) % 3]}];
    std::vector<std::pair<std::uint32_t, std::uint32_t>> open;
    for (const auto& [edge, count] : seen) {
        EXPECT_EQ(count, 1) << edge.first << " " << edge.second; // else two faces run the same way
        if (!seen.contains({edge.second, edge.first}))
            open.push_back(edge);
    }
    return open;
}

dvec3 area_of(const SilhouetteMesh& s, std::size_t t)
{
    const uvec3& f = s.mesh.triangles[t];
    return glm::cross(s.mesh.positions[f.y] - s.mesh.positions[f.x], s.mesh.positions[f.z] - s.mesh.positions[f.x]) / 2.0;
}

/// Checklist 23: how many triangles, that they wind as their face, and that they cover it: in its parameters, where curves are straight, each
/// is positive and they add up to the face.
TEST(SeedSilhouette, CoversEachFaceOnce)
{
    for (const Mesh& mesh : {octahedron(), torus(8, 6, 1, 0.45), creased_mesh()}) {
        const Posed p = posed(mesh);
        for (std::uint64_t view = 0; view < 10; ++view) {
            const Eye eye = random_eye(23, view);
            const SeedCrossings found = find_seed_crossings(p.surface, p.at, eye);
            const std::size_t crossed = crossed_faces(p, found);
            for (const SeedTriangulation triangulation : both)
                for (const int m : {1, 2, 5}) {
                    const SilhouetteMesh s = seed_silhouette(p.surface, p.at, eye, options_of(m, triangulation));
                    const std::size_t each = std::size_t(triangulation == SeedTriangulation::strip ? 3 * m : 2 * m + 1);
                    if (p.surface.sharp.empty()) {
                        ASSERT_EQ(s.mesh.triangles.size(), mesh.triangles.size() + crossed * (each - 1));
                    }
                    ASSERT_EQ(s.curves.size(), crossed);
                    ASSERT_EQ(s.faces.size(), s.mesh.triangles.size());
                    std::vector<double> covered(mesh.triangles.size(), 0);
                    for (std::size_t t = 0; t < s.faces.size(); ++t) {
                        const dvec2 a = s.parameters[3 * t], b = s.parameters[3 * t + 1] - a, c = s.parameters[3 * t + 2] - a;
                        const double area = b.x * c.y - b.y * c.x;
                        EXPECT_GE(area, -1e-15);
                        covered[s.faces[t]] += area;
                    }
                    for (const double area : covered) {
                        EXPECT_NEAR(area, 1, 1e-14);
                    }
                }
        }
    }
}

/// Checklist 23: the area of a cut face, as a vector, follows from its outline, so it does not depend on how it is cut; nor does its projection.
TEST(SeedSilhouette, KeepsTheAreaOfItsOutline)
{
    const Posed p = posed(torus(8, 6, 1, 0.45));
    const Eye eye = random_eye(24, 0);
    std::vector<std::vector<dvec3>> areas;
    for (const SeedTriangulation triangulation : both)
        for (const int m : {1, 4, 9}) {
            const SilhouetteMesh s = seed_silhouette(p.surface, p.at, eye, options_of(m, triangulation));
            areas.emplace_back(p.surface.topology.triangles.size(), dvec3(0));
            for (std::size_t t = 0; t < s.faces.size(); ++t)
                areas.back()[s.faces[t]] += area_of(s, t);
        }
    for (const auto& other : areas)
        for (std::size_t f = 0; f < other.size(); ++f) {
            EXPECT_LT(glm::distance(other[f], areas[0][f]), 1e-15) << "face " << f;
        }
}

/// Checklist 23: strips are open only along the sides that are not crossed, where their vertices are in line; slivers nowhere.
TEST(SeedSilhouette, HasTVerticesOnUncrossedSidesOnly)
{
    const Posed p = posed(torus(8, 6, 1, 0.45));
    const std::uint32_t control = std::uint32_t(p.at.positions.size());
    for (std::uint64_t view = 0; view < 10; ++view) {
        const Eye eye = random_eye(25, view);
        EXPECT_TRUE(unpaired(seed_silhouette(p.surface, p.at, eye, options_of(6, SeedTriangulation::sliver)).mesh).empty());
        const SilhouetteMesh s = seed_silhouette(p.surface, p.at, eye, options_of(6, SeedTriangulation::strip));
        const auto open = unpaired(s.mesh);
        const SeedCrossings found = find_seed_crossings(p.surface, p.at, eye);
        ASSERT_FALSE(open.empty());
        for (const auto& [a, b] : open) {
            bool in_line = false; // with an edge of the control mesh that is not crossed
            for (std::uint32_t e = 0; e < p.surface.topology.edge_count(); ++e) {
                const std::uint32_t h = p.surface.topology.half_edge[e];
                const dvec3 &x = p.at.positions[p.surface.topology.start(h)], &y = p.at.positions[p.surface.topology.end(h)];
                const auto off = [&](std::uint32_t v) { return glm::length(glm::cross(s.mesh.positions[v] - x, y - x)) / glm::length(y - x); };
                in_line |= found.of(e) == none && off(a) < 1e-15 && off(b) < 1e-15;
            }
            EXPECT_TRUE(in_line) << a << " " << b;
            EXPECT_FALSE(a >= control && a < control + found.crossings.size()) << "a crossing is shared";
        }
    }
}

/// Each side of a crease is crossed for itself, elsewhere; still no gap opens between their faces. The areas of a closed surface add up to 0.
TEST(SeedSilhouette, IsClosedAtCreases)
{
    const Posed p = posed(creased_mesh());
    std::size_t one_side = 0, both_sides = 0;
    for (std::uint64_t view = 0; view < 200; ++view) {
        const Eye eye = random_eye(30, view, view % 2 == 0 ? 1 : 3);
        const SeedCrossings found = find_seed_crossings(p.surface, p.at, eye);
        for (const std::uint32_t e : p.surface.two_sided) {
            const bool left = found.of(e) != none;
            const bool right = found.of(p.surface.side[p.surface.topology.twin[p.surface.topology.half_edge[e]]]) != none;
            one_side += left != right;
            both_sides += left && right;
        }
        for (const int m : {1, 2, 5}) {
            EXPECT_TRUE(unpaired(seed_silhouette(p.surface, p.at, eye, options_of(m, SeedTriangulation::sliver)).mesh).empty()) << "view " << view;
            const SilhouetteMesh s = seed_silhouette(p.surface, p.at, eye, options_of(m, SeedTriangulation::strip));
            dvec3 area(0);
            for (std::size_t t = 0; t < s.faces.size(); ++t)
                area += area_of(s, t);
            EXPECT_LT(glm::length(area), 1e-14) << "view " << view;
        }
    }
    EXPECT_GT(one_side, 100u);
    EXPECT_GT(both_sides, 20u);
}

/// The points of the limit curves of a mesh's sharp edges.
std::vector<dvec3> sharp_limit(const Mesh& mesh, int levels)
{
    const Refined fine = refined(mesh, levels);
    const std::vector<dvec3> limit = limit_positions(fine.topology, fine.positions);
    std::vector<dvec3> points;
    for (std::uint32_t e = 0; e < fine.topology.edge_count(); ++e)
        if (fine.topology.sharpness[e] >= infinitely_sharp)
            points.push_back(limit[fine.topology.start(fine.topology.half_edge[e])]);
    return points;
}

double nearest(const std::vector<dvec3>& points, const dvec3& p)
{
    double least = 1e9;
    for (const dvec3& q : points)
        least = std::min(least, glm::distance(p, q));
    return least;
}

/// Borders are outlines in every view: their pieces are on the limit curve, whatever number of them.
TEST(SeedSilhouette, FollowsBorders)
{
    const Mesh mesh = shaken(sheet(3), 0.1);
    const Posed p = posed(mesh);
    const std::vector<dvec3> border = sharp_limit(mesh, 6); // every 64th of an edge
    for (const int m : {1, 2, 8, 13, 64, 100}) {
        const std::size_t pieces = std::size_t(std::min(m, 64));
        const SilhouetteMesh s = seed_silhouette(p.surface, p.at, {dvec4(0.3, 0.2, 50, 1)}, options_of(m, SeedTriangulation::sliver));
        ASSERT_TRUE(s.curves.empty());
        const auto open = unpaired(s.mesh);
        ASSERT_EQ(open.size(), 12 * pieces);
        for (const auto& [a, b] : open) {
            EXPECT_LT(nearest(border, s.mesh.positions[a]), 1e-12);
        }
        EXPECT_EQ(s.mesh.triangles.size(), mesh.triangles.size() + 12 * (pieces - 1));
    }
}

/// A crease is followed where one side faces the eye and the other does not; corners have the normals of their own side.
TEST(SeedSilhouette, FollowsCreasesThatAreOutlines)
{
    Mesh mesh = double_pyramid(8); // sharp around its belt
    for (std::uint32_t i = 0; i < 8; ++i)
        mesh.creases.push_back({2 + i, 2 + (i + 1) % 8, infinitely_sharp});
    const Posed p = posed(mesh);
    const std::vector<dvec3> crease = sharp_limit(mesh, 6);
    const SilhouetteMesh above = seed_silhouette(p.surface, p.at, {dvec4(0, 0, 50, 1)}, options_of(8, SeedTriangulation::strip));
    ASSERT_TRUE(above.curves.empty());
    ASSERT_EQ(above.mesh.positions.size(), 10u + 8 * 7);
    EXPECT_TRUE(unpaired(above.mesh).empty());
    for (std::size_t v = 2; v < above.mesh.positions.size(); ++v) {
        EXPECT_LT(nearest(crease, above.mesh.positions[v]), 1e-12);
    }
    for (std::size_t i = 0; i < above.mesh.corner_normals.size(); ++i) {
        EXPECT_EQ(above.mesh.corner_normals[i].z > 0, above.faces[i / 3] % 2 == 0) << i; // even faces are above
    }
    const std::uint32_t near = edge_between(p.surface.topology, 2, 3); // from aside, both of its sides face the eye
    const dvec3 middle = p.surface.halves.point(2 * near, 32, EdgeTable::left, p.at.fine).position;
    EXPECT_LT(nearest(above.mesh.positions, middle), 1e-12);
    EXPECT_GT(nearest(seed_silhouette(p.surface, p.at, {dvec4(50, 0, 0, 1)}).mesh.positions, middle), 0.01);
}

/// Checklist 18: curves join into closed loops, with the part that faces the eye on their left.
TEST(SeedSilhouette, CurvesJoinIntoLoops)
{
    for (const Mesh& mesh : {octahedron(), icosahedron(), torus(8, 6, 1, 0.45)}) {
        const Posed p = posed(mesh);
        for (std::uint64_t view = 0; view < 50; ++view) {
            const Eye eye = random_eye(26, view, 5, view % 2 == 0);
            const SeedCrossings found = find_seed_crossings(p.surface, p.at, eye);
            const SilhouetteMesh s = seed_silhouette(p.surface, p.at, eye, options_of(3, SeedTriangulation::strip));
            std::map<std::uint32_t, int> starts, ends;
            for (const auto& curve : s.curves) {
                ASSERT_EQ(curve.size(), 4u);
                ++starts[curve.front()];
                ++ends[curve.back()];
            }
            EXPECT_EQ(starts, ends);
            EXPECT_EQ(starts.size(), found.crossings.size());
            for (const auto& [vertex, count] : starts) {
                EXPECT_EQ(count, 1);
            }
        }
    }
}

TEST(SeedSilhouette, CurvesHaveTheFacingPartOnTheirLeft)
{
    const Posed p = posed(icosahedron());
    const Eye eye = random_eye(27, 0);
    const SeedCrossings found = find_seed_crossings(p.surface, p.at, eye);
    const SilhouetteMesh s = seed_silhouette(p.surface, p.at, eye);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> left; // per half-edge: the vertex across in its triangle
    for (const uvec3& t : s.mesh.triangles)
        for (int k = 0; k < 3; ++k)
            left[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
    std::size_t apexes = 0;
    for (const auto& curve : s.curves)
        for (const bool forward : {true, false}) {
            const std::uint32_t v = forward ? left.at({curve[3], curve[4]}) : left.at({curve[4], curve[3]});
            if (v >= p.at.positions.size())
                continue; // of the strip
            EXPECT_EQ(bool(found.facing[v]), forward);
            ++apexes;
        }
    EXPECT_EQ(apexes, s.curves.size());
}

/// Checklist 24.
TEST(SeedSilhouette, IsTheMeshOnTheLimitWhereNothingIsCrossed)
{
    const Mesh mesh = octahedron();
    const Posed p = posed(mesh);
    const SilhouetteMesh s = seed_silhouette(p.surface, p.at, {dvec4(0, 0, 0, 1)}); // from within, all face away
    const LimitSurface limit = limit_surface(p.surface.topology, mesh.positions);
    EXPECT_EQ(s.mesh.positions, limit.positions);
    EXPECT_EQ(s.mesh.triangles, mesh.triangles);
    EXPECT_TRUE(s.curves.empty());
    for (std::size_t i = 0; i < limit.normals.size(); ++i) {
        EXPECT_EQ(s.mesh.corner_normals[i], vec3(limit.normals[i]));
    }
    for (std::uint32_t f = 0; f < s.faces.size(); ++f) {
        EXPECT_EQ(s.faces[f], f);
        EXPECT_EQ(s.parameters[3 * f], dvec2(0, 0));
        EXPECT_EQ(s.parameters[3 * f + 1], dvec2(1, 0));
        EXPECT_EQ(s.parameters[3 * f + 2], dvec2(0, 1));
    }
}

/// The largest angle between pieces of a curve that follow each other, degrees.
double largest_bend(const SilhouetteMesh& s)
{
    double largest = 0;
    for (const auto& curve : s.curves)
        for (std::size_t i = 1; i + 1 < curve.size(); ++i) {
            const dvec3 a = s.mesh.positions[curve[i]] - s.mesh.positions[curve[i - 1]], b = s.mesh.positions[curve[i + 1]] - s.mesh.positions[curve[i]];
            largest = std::max(largest, std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi);
        }
    return largest;
}

/// Checklist 22: smoothness follows from the points of the curve, whatever the depth of the search. A PN curve bends most near its ends, so
/// that twice the points halve the largest angle only where there are enough of them.
TEST(SeedSilhouette, HasSmoothnessAndDepthApart)
{
    for (const Mesh& mesh : {octahedron(), icosahedron(), torus(8, 6, 1, 0.45)}) {
        const Posed p = posed(mesh, 6);
        const Eye eye = random_eye(28, 3);
        for (const int m : {16, 32, 64}) {
            const double reference = largest_bend(seed_silhouette(p.surface, p.at, eye, options_of(m, SeedTriangulation::strip, 6)));
            for (int depth = 2; depth <= 6; ++depth) {
                const double bend = largest_bend(seed_silhouette(p.surface, p.at, eye, options_of(m, SeedTriangulation::strip, depth)));
                const double doubled = largest_bend(seed_silhouette(p.surface, p.at, eye, options_of(2 * m, SeedTriangulation::strip, depth)));
                EXPECT_NEAR(doubled / bend, 0.5, 0.1) << "depth " << depth << ", points " << m;
                EXPECT_NEAR(bend / reference, 1, 0.05) << "depth " << depth << ", points " << m;
            }
        }
    }
}

/// The limit surface as many triangles: `children` for each face of the control mesh.
struct FineLimit {
    LoopTopology topology;
    std::vector<dvec3> positions, centres; ///< of its vertices; of its triangles
    std::size_t children = 0;

    FineLimit(const Mesh& mesh, int levels) : children(std::size_t(1) << 2 * levels)
    {
        Refined fine = refined(mesh, levels);
        topology = std::move(fine.topology);
        positions = limit_positions(topology, fine.positions);
        for (const uvec3& t : topology.triangles)
            centres.push_back((positions[t.x] + positions[t.y] + positions[t.z]) / 3.0);
    }
    /// To the triangle that has its centre next to p, of those in the given faces of the control mesh.
    double distance(const dvec3& p, std::span<const std::uint32_t> faces) const
    {
        std::size_t nearest = faces[0] * children;
        for (const std::uint32_t face : faces)
            for (std::size_t f = face * children; f < (face + 1) * children; ++f)
                if (glm::dot(centres[f] - p, centres[f] - p) < glm::dot(centres[nearest] - p, centres[nearest] - p))
                    nearest = f;
        const uvec3& t = topology.triangles[nearest];
        return distance_to_triangle(p, positions[t.x], positions[t.y], positions[t.z]);
    }
};

/// The faces around the corners of a face.
std::vector<std::uint32_t> faces_around(const LoopTopology& t, std::uint32_t face)
{
    std::vector<std::uint32_t> faces;
    for (int k = 0; k < 3; ++k)
        for (const std::uint32_t h : t.gather(t.triangles[face][k]).half_edges)
            faces.push_back(h / 3);
    return faces;
}

/// How far points of the curves are from the limit surface, at most.
double off_surface(const Posed& p, const SilhouetteMesh& s, const FineLimit& fine)
{
    std::map<std::uint32_t, std::uint32_t> face_of; // per vertex
    for (std::size_t t = 0; t < s.faces.size(); ++t)
        for (int k = 0; k < 3; ++k)
            face_of[s.mesh.triangles[t][k]] = s.faces[t];
    double largest = 0;
    for (const auto& curve : s.curves) {
        const std::vector<std::uint32_t> faces = faces_around(p.surface.topology, face_of.at(curve[1]));
        for (std::size_t i = 1; i + 1 < curve.size(); ++i)
            largest = std::max(largest, fine.distance(s.mesh.positions[curve[i]], faces));
    }
    return largest;
}

/// Specification, section 4: how far PN curves leave the limit surface, in percent of its largest side, over six views that are not known; nor
/// is which way the faces of its tori are cut.
TEST(SeedSilhouette, LeavesTheLimitSurfaceNoFurtherThanTheSeed)
{
    const std::vector<double> known = {3.70, 1.03, .73, .20, .05};
    const auto meshes = measured_meshes();
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const Posed p = posed(meshes[i].mesh);
        const FineLimit fine(meshes[i].mesh, 4);
        std::vector<double> largest;
        for (std::uint64_t set = 0; set < 3; ++set) {
            largest.push_back(0);
            for (std::uint64_t view = 0; view < 6; ++view) {
                const SilhouetteMesh s = seed_silhouette(p.surface, p.at, random_eye(50 + set, view), options_of(6, SeedTriangulation::sliver));
                largest.back() = std::max(largest.back(), 100 * off_surface(p, s, fine) / largest_side(p));
            }
        }
        std::sort(largest.begin(), largest.end());
        EXPECT_LT(largest[1], 2.5 * known[i]) << meshes[i].name;
        EXPECT_LT(known[i], 2 * largest[2]) << meshes[i].name;
    }
}

bool same_bits(const SilhouetteMesh& a, const SilhouetteMesh& b)
{
    return a.mesh.positions == b.mesh.positions && a.mesh.triangles == b.mesh.triangles && a.mesh.corner_normals == b.mesh.corner_normals
           && a.faces == b.faces && a.parameters == b.parameters && a.curves == b.curves;
}

/// Checklist 34.
TEST(SeedSilhouette, OfAMovedMeshIsThatOfAFreshOne)
{
    const Mesh mesh = torus(8, 6, 1, 0.45);
    const Posed p = posed(mesh);
    for (std::uint64_t frame = 0; frame < 5; ++frame) {
        const Mesh moved = shaken(mesh, 0.1, frame);
        const Posed fresh = posed(moved);
        const Eye eye = random_eye(34, frame);
        EXPECT_TRUE(same_bits(seed_silhouette(p.surface, make_seed_pose(p.surface, moved.positions), eye), seed_silhouette(fresh.surface, fresh.at, eye)));
    }
}

/// Checklist 41: from tables to triangles, on a mesh of many blocks with a crease around it.
TEST(SeedSilhouette, IsTheSameForAnyNumberOfThreads)
{
    Mesh mesh = shaken(torus(150, 140), 0.002);
    for (std::uint32_t i = 0; i < 150; ++i)
        mesh.creases.push_back({140 * i, 140 * ((i + 1) % 150), infinitely_sharp});
    const Eye eye = random_eye(41, 0);
    const auto make = [&] {
        const Posed p = posed(mesh);
        return seed_silhouette(p.surface, p.at, eye);
    };
    const SilhouetteMesh one = with_threads(1, make);
    EXPECT_GT(one.curves.size(), 500u);
    for (const int threads : {2, 3, 7}) {
        EXPECT_TRUE(same_bits(with_threads(threads, make), one)) << threads;
    }
}

bool is_finite(const dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

void expect_finite(const std::string& what, const Posed& p, const Eye& eye)
{
    for (const SeedTriangulation triangulation : both) {
        const SilhouetteMesh s = seed_silhouette(p.surface, p.at, eye, options_of(4, triangulation));
        for (const dvec3& x : s.mesh.positions) {
            ASSERT_TRUE(is_finite(x)) << what;
        }
        for (const vec3& n : s.mesh.corner_normals) {
            ASSERT_NEAR(glm::length(n), 1, 1e-6) << what;
        }
        for (const dvec2& v : s.parameters) {
            ASSERT_TRUE(v.x >= 0 && v.y >= 0 && v.x + v.y <= 1 + 1e-15) << what;
        }
        for (const uvec3& t : s.mesh.triangles) {
            ASSERT_LT(std::max({t.x, t.y, t.z}), s.mesh.positions.size()) << what;
        }
    }
}

/// Checklist 40.
TEST(SeedSilhouette, HasNoNumbersThatAreNone)
{
    std::vector<std::pair<std::string, Mesh>> meshes = various_meshes(); // open, creased, of valence 3 to 12
    for (const std::uint32_t n : {2u, 3u, 4u, 20u, 40u})
        meshes.emplace_back(fmt::format("pyramid {}", n), double_pyramid(n));
    Mesh point = octahedron(), line = icosahedron(), flat = octahedron();
    for (dvec3& x : point.positions)
        x = {1, 2, 3};
    for (dvec3& x : line.positions)
        x = {x.x, 0, 0};
    for (dvec3& x : flat.positions)
        x.z = 0;
    meshes.emplace_back("point", point);
    meshes.emplace_back("line", line);
    meshes.emplace_back("flat", flat);
    for (const auto& [name, mesh] : meshes) {
        const Posed p = posed(mesh);
        for (std::uint64_t view = 0; view < 4; ++view)
            expect_finite(name + " from outside", p, random_eye(40, view, 5, view % 2 == 0));
        expect_finite(name + " from inside", p, {dvec4(0.01, 0.02, 0.03, 1)});
        for (const dvec3& x : p.at.positions) // on the surface: at a vertex, and at the middle of an edge
            expect_finite(name + " from a vertex", p, {dvec4(x, 1)});
        expect_finite(name + " from an edge", p, {dvec4(p.surface.halves.point(0, 32, EdgeTable::left, p.at.fine).position, 1)});
        expect_finite(name + " from nowhere", p, {dvec4(0)});
    }
}

TEST(SeedSilhouette, RefusesCurvesWithoutPoints)
{
    const Posed p = posed(octahedron());
    EXPECT_THROW(seed_silhouette(p.surface, p.at, {}, options_of(0, SeedTriangulation::strip)), Error::Input);
    EXPECT_THROW(seed_silhouette(p.surface, p.at, {}, options_of(5000, SeedTriangulation::sliver)), Error::Input);
    EXPECT_THROW(seed_silhouette(p.surface, p.at, {}, options_of(4, SeedTriangulation::strip, 6)), Error::Input);
}

} // namespace
} // namespace limn::test
