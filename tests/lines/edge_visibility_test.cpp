// Hidden-line removal of lines along mesh edges (creases, borders, mesh contours) against brute force: section 5 of the
// line-visibility specification, checklist item 28 of the contour-lines specification. The meshes are the exact shapes here.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "limn/lines/draw.h"
#include "limn/lines/prepare.h"
#include "limn/surface/shapes.h"
#include "lines/cameras.h"
#include "lines/edge_shapes.h"

namespace limn {
namespace {

using namespace test;

/// An edge that can be a line, with the faces beside it.
struct TrueEdge {
    std::array<dvec3, 2> ends;
    std::vector<dvec3> normals; ///< one for each face
    dvec3 at(double t) const { return glm::mix(ends[0], ends[1], t); }
    double length() const { return glm::distance(ends[0], ends[1]); }
};

/// The triangles of some meshes in the world, asked one by one.
class BruteForce {
public:
    explicit BruteForce(const std::vector<Mesh>& meshes)
    {
        for (const Mesh& mesh : meshes) {
            std::map<std::pair<std::uint32_t, std::uint32_t>, TrueEdge> edges;
            for (const uvec3& t : mesh.triangles) {
                const std::array<dvec3, 3> p = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
                triangles_.push_back(p);
                for (const dvec3& x : p)
                    box_.add(x);
                for (int k = 0; k < 3; ++k) {
                    TrueEdge& edge = edges[std::minmax(t[k], t[(k + 1) % 3])];
                    edge.ends = {p[std::size_t(k)], p[std::size_t((k + 1) % 3)]};
                    edge.normals.push_back(glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0])));
                }
            }
            for (const auto& [vertices, edge] : edges)
                edges_.push_back(edge);
        }
    }

    const Bounds& box() const { return box_; }

    /// Whether nothing stands between a point on a face or edge and the eye.
    bool sees(const dvec3& p, const Camera& camera) const
    {
        const dvec3 v = camera.to_eye(p), direction = glm::normalize(v), from = p + 1e-6 * box_.radius() * direction;
        const double far = camera.orthographic ? 1e9 : glm::length(v);
        return std::none_of(triangles_.begin(), triangles_.end(), [&](const std::array<dvec3, 3>& t) { return meets(t, from, direction, far); });
    }

    /// The edges of one type as seen by a camera.
    std::vector<TrueEdge> edges(LineType type, const Camera& camera) const
    {
        std::vector<TrueEdge> result;
        for (const TrueEdge& e : edges_) {
            const bool border = e.normals.size() == 1;
            const auto front = [&](std::size_t k) { return glm::dot(e.normals[k], camera.to_eye(e.ends[0])) > 0; };
            if (type == LineType::border ? border
                : border                 ? false
                : type == LineType::crease ? glm::dot(e.normals[0], e.normals[1]) < std::cos(40 * std::numbers::pi / 180)
                                           : front(0) != front(1))
                result.push_back(e);
        }
        return result;
    }

private:
    static bool meets(const std::array<dvec3, 3>& t, const dvec3& from, const dvec3& direction, double far)
    {
        const dvec3 a = t[1] - t[0], b = t[2] - t[0], p = glm::cross(direction, b), s = from - t[0], q = glm::cross(s, a);
        const double determinant = glm::dot(a, p), u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
        const double distance = glm::dot(b, q) / determinant;
        return u >= -1e-12 && v >= -1e-12 && u + v <= 1 + 1e-12 && distance > 0 && distance < far; // false where the determinant is 0
    }
    std::vector<std::array<dvec3, 3>> triangles_;
    std::vector<TrueEdge> edges_;
    Bounds box_;
};

/// The visible strokes of one type as pieces in space.
class DrawnLines {
public:
    DrawnLines(const Drawing& drawing, LineType type)
    {
        for (const Stroke& s : drawing.strokes)
            if (s.type == type && s.visible)
                for (std::size_t i = s.closed ? 0 : 1; i < s.world.size(); ++i)
                    pieces_.push_back({s.world[i > 0 ? i - 1 : s.world.size() - 1], s.world[i]});
    }
    bool hold(const dvec3& p, double tolerance) const
    {
        return std::any_of(pieces_.begin(), pieces_.end(), [&](const auto& piece) {
            const dvec3 d = piece[1] - piece[0];
            const double t = std::clamp(glm::dot(p - piece[0], d) / std::max(glm::dot(d, d), 1e-30), 0.0, 1.0);
            return glm::distance(p, piece[0] + t * d) < tolerance;
        });
    }
    double length() const
    {
        double sum = 0;
        for (const auto& piece : pieces_)
            sum += glm::distance(piece[0], piece[1]);
        return sum;
    }

private:
    std::vector<std::array<dvec3, 2>> pieces_;
};

/// Lengths over all views.
struct EdgeScore {
    double length = 0, visible = 0; ///< of the edges; of what is in sight
    double leak = 0, lost = 0;      ///< drawn though hidden; in sight but not drawn
    double drawn = 0;               ///< of the strokes
    void print(const char* what) const
    {
        fmt::print("[   edges   ] {}: {:.1f} % in sight, leak {:.3f} %, lost {:.3f} %\n", what, 100 * visible / length, 100 * leak / length, 100 * lost / length);
    }
};

/// Draws the lines of a type from random views, and compares each edge with what brute force sees of it.
EdgeScore score_of(const std::vector<PlacedSurface>& placed, const BruteForce& truth, LineType type, int views)
{
    const LineModel model = build_line_model(placed);
    const RayScene rays = build_ray_scene(model);
    LineOptions options;
    options.lines = {type};
    options.tolerance = 0; // simplified strokes leave their edges
    const LineFeatures features = find_line_features(model, options);
    EdgeScore score;
    for (int k = 0; k < views; ++k) {
        const Camera camera = random_camera(truth.box(), 2000 + std::uint64_t(k), k % 3 == 2);
        const DrawnLines drawn(draw_lines(model, rays, features, camera, options), type);
        score.drawn += drawn.length();
        for (const TrueEdge& edge : truth.edges(type, camera)) {
            const int samples = std::max(3, int(std::ceil(edge.length() / (0.005 * truth.box().radius()))));
            for (int i = 0; i < samples; ++i) {
                const dvec3 p = edge.at((i + 0.5) / samples);
                const bool seen = truth.sees(p, camera), found = drawn.hold(p, 1e-5 * truth.box().radius());
                const double length = edge.length() / samples;
                score.length += length;
                score.visible += seen ? length : 0;
                score.leak += found && !seen ? length : 0;
                score.lost += seen && !found ? length : 0;
            }
        }
    }
    return score;
}

void expect_right(const char* what, const EdgeScore& score, double wrong = 0.005)
{
    score.print(what);
    ASSERT_GT(score.visible, 0.05 * score.length) << what;
    EXPECT_LT(score.visible, 0.95 * score.length) << what;
    EXPECT_LE(score.leak + score.lost, wrong * score.length) << what;
    EXPECT_NEAR(score.drawn, score.visible, 0.01 * score.length) << what << ": strokes lie on edges only, and once";
}

/// The score of meshes that were prepared as a file's mesh is.
EdgeScore score_of(const std::vector<Mesh>& meshes, LineType type, int views)
{
    std::vector<PreparedMesh> prepared;
    for (const Mesh& mesh : meshes)
        prepared.push_back(prepare_mesh(mesh));
    std::vector<PlacedSurface> placed;
    for (const PreparedMesh& mesh : prepared)
        placed.push_back(mesh.placed());
    return score_of(placed, BruteForce(meshes), type, views);
}

/// A block with a notch: the prism over an L in the plane of x and y, z from -0.6 to 0.6.
Mesh l_shape()
{
    const std::vector<dvec2> corners = {{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}};
    const std::uint32_t n = std::uint32_t(corners.size());
    Mesh mesh;
    for (const double z : {-0.6, 0.6})
        for (const dvec2& c : corners)
            mesh.positions.push_back({c, z});
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        mesh.triangles.insert(mesh.triangles.end(), {{i, j, n + j}, {i, n + j, n + i}});
    }
    for (const uvec3& t : {uvec3(0, 1, 2), uvec3(0, 2, 3), uvec3(0, 3, 4), uvec3(0, 4, 5)}) { // the notch is at corner 3
        mesh.triangles.push_back(t + n);
        mesh.triangles.push_back({t.x, t.z, t.y});
    }
    return mesh;
}

Mesh shape_mesh(const char* name, std::size_t triangles)
{
    return make_shape({.name = name, .triangles = triangles, .jitter = 0.2, .float_positions = false}).mesh;
}

Mesh torus_cut_open(std::size_t triangles)
{
    Mesh mesh = shape_mesh("torus", triangles);
    std::erase_if(mesh.triangles, [&](const uvec3& t) { return (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]).x > 0.9; });
    return mesh;
}

TEST(EdgeVisibility, CreasesOfSolidsAreDrawnWhereTheyAreInSight)
{
    expect_right("creases of a cube", score_of({cube()}, LineType::crease, 30));
    expect_right("creases of a cylinder with caps", score_of({cylinder(64)}, LineType::crease, 20));
    expect_right("creases of a block with a notch", score_of({l_shape()}, LineType::crease, 30));
}

TEST(EdgeVisibility, ObjectsHideEachOthersCreases)
{
    const Mesh behind = transformed(cube(), glm::rotate(glm::translate(dmat4(1), dvec3(1.1, 0.9, -2.6)), 0.5, dvec3(1, 1, 0)));
    expect_right("creases of two cubes", score_of({cube(), behind}, LineType::crease, 30));
    expect_right("creases of a cube and a block with a notch", score_of({behind, l_shape()}, LineType::crease, 30));
}

// What the default drawing shows of a solid with flat sides.
TEST(EdgeVisibility, ContoursOfSolidsWithFlatSidesAreDrawnWhereTheyAreInSight)
{
    const Mesh behind = transformed(cube(), glm::rotate(glm::translate(dmat4(1), dvec3(1.1, 0.9, -2.6)), 0.5, dvec3(1, 1, 0)));
    expect_right("contour of a block with a notch", score_of({l_shape()}, LineType::contour, 30));
    expect_right("contours of two cubes", score_of({cube(), behind}, LineType::contour, 30));
    expect_right("contours of a cube and a block with a notch", score_of({behind, l_shape()}, LineType::contour, 30));
}

TEST(EdgeVisibility, BordersOfShellsAreDrawnWhereTheyAreInSight)
{
    expect_right("border of a torus that is cut open", score_of({torus_cut_open(3000)}, LineType::border, 20));
    Mesh box = cube();
    box.triangles.erase(box.triangles.begin(), box.triangles.begin() + 2);
    expect_right("border of a box without a lid", score_of({box}, LineType::border, 30));
    expect_right("creases of a box without a lid", score_of({box}, LineType::crease, 30));
}

// The zig-zag of 3,000 faces comes and goes behind itself; runs of a few pixels are evened out (measured: .2, .49 and .37 %).
TEST(EdgeVisibility, MeshContoursAreDrawnWhereTheyAreInSight)
{
    for (const char* name : {"torus", "bumpy-torus", "knot"})
        expect_right(name, score_of({shape_mesh(name, 3000)}, LineType::mesh_contour, 10), 0.0065);
    expect_right("mesh contour of a torus that is cut open", score_of({torus_cut_open(3000)}, LineType::mesh_contour, 10));
}

} // namespace
} // namespace limn
