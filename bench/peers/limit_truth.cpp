#include "limit_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "limn/base/random.h"
#include "limn/subdivision/loop_limit.h"
#include "limn/subdivision/loop_refine.h"

using namespace limn;

namespace {

/// A part of a refined mesh that knows where in the control mesh it lies.
struct Part {
    Mesh mesh;
    struct Place {
        std::uint32_t face;
        std::array<dvec2, 3> corners; ///< v, w
    };
    std::vector<Place> places; ///< per triangle
};

Mesh mesh_of(const LoopTopology& t, std::vector<dvec3> positions)
{
    Mesh mesh;
    mesh.positions = std::move(positions);
    mesh.triangles = t.triangles;
    for (std::uint32_t e = 0; e < t.edge_count(); ++e)
        if (t.sharpness[e] > 0 && !t.is_border(e))
            mesh.creases.push_back({t.start(t.half_edge[e]), t.end(t.half_edge[e]), t.sharpness[e]});
    return mesh;
}

Mesh refined_once(const Mesh& mesh)
{
    const ControlMesh control = make_control_mesh(mesh);
    return mesh_of(refine(control.topology), refine_positions(control.topology, control.positions));
}

/// Per vertex: edges from vertex 0, at most `most` + 1.
std::vector<int> distances(const Mesh& mesh, int most)
{
    std::vector<int> distance(mesh.positions.size(), most + 1);
    distance[0] = 0;
    for (int step = 1; step <= most; ++step)
        for (const uvec3& t : mesh.triangles) {
            const int least = std::min({distance[t.x], distance[t.y], distance[t.z]});
            for (int k = 0; k < 3; ++k)
                distance[t[k]] = std::min(distance[t[k]], least + 1);
        }
    return distance;
}

/// The faces at vertices within two edges of vertex 0, which stays the first.
Part cropped(const Part& part)
{
    const std::vector<int> distance = distances(part.mesh, 3);
    Part out;
    std::vector<std::uint32_t> number(part.mesh.positions.size(), none);
    const auto keep = [&](std::uint32_t v) {
        if (number[v] == none) {
            number[v] = std::uint32_t(out.mesh.positions.size());
            out.mesh.positions.push_back(part.mesh.positions[v]);
        }
        return number[v];
    };
    keep(0);
    for (std::size_t f = 0; f < part.places.size(); ++f) {
        const uvec3& t = part.mesh.triangles[f];
        if (std::min({distance[t.x], distance[t.y], distance[t.z]}) > 2)
            continue;
        const std::uint32_t x = keep(t.x), y = keep(t.y), z = keep(t.z);
        out.mesh.triangles.push_back({x, y, z});
        out.places.push_back(part.places[f]);
    }
    for (const CreaseEdge& crease : part.mesh.creases)
        if (number[crease.a] != none && number[crease.b] != none)
            out.mesh.creases.push_back({number[crease.a], number[crease.b], crease.sharpness});
    return out;
}

Part refined(const Part& part)
{
    Part out{refined_once(part.mesh), {}};
    for (const Part::Place& place : part.places) {
        const std::array<dvec2, 3>& c = place.corners;
        const dvec2 middle[3] = {0.5 * (c[0] + c[1]), 0.5 * (c[1] + c[2]), 0.5 * (c[2] + c[0])};
        for (std::size_t k = 0; k < 3; ++k)
            out.places.push_back({place.face, {c[k], middle[k], middle[(k + 2) % 3]}});
        out.places.push_back({place.face, {middle[0], middle[1], middle[2]}});
    }
    return out;
}

/// Adds the corners of faces within two edges of vertex 0 and not there, in the control mesh's faces at vertex 0.
void add_samples(const Part& part, const std::vector<bool>& wanted, std::vector<LimitSample>& samples)
{
    const ControlMesh control = make_control_mesh(part.mesh);
    const LimitSurface limit = limit_surface(control.topology, control.positions);
    const std::vector<int> distance = distances(part.mesh, 3);
    for (std::size_t f = 0; f < part.places.size(); ++f)
        for (std::size_t k = 0; k < 3 && wanted[part.places[f].face]; ++k) {
            const std::uint32_t v = part.mesh.triangles[f][int(k)];
            const dvec2& at = part.places[f].corners[k];
            if (distance[v] == 1 || distance[v] == 2)
                samples.push_back({{part.places[f].face, at.x, at.y}, limit.positions[v], limit.normals[3 * f + k]});
        }
}

/// n corners around vertex 0, below it; closed by a tip of as many edges, or an open half.
Mesh around(std::uint32_t n, bool open)
{
    Mesh mesh;
    mesh.positions = {{0, 0, 1}};
    const std::uint32_t corners = open ? n + 1 : n;
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double angle = (open ? 1 : 2) * std::numbers::pi * i / n;
        mesh.positions.push_back({std::cos(angle), std::sin(angle), 0.1 * std::cos(3 * angle)});
    }
    if (!open)
        mesh.positions.push_back({0, 0, -0.8});
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = 1 + i, b = 1 + (i + 1) % corners;
        mesh.triangles.push_back({0, a, b});
        if (!open)
            mesh.triangles.push_back({corners + 1, b, a});
    }
    return mesh;
}

/// Refined once, so that the neighbours of vertex 0 are regular, and shaken.
Mesh prepared(Mesh mesh)
{
    mesh = refined_once(mesh);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        Random random(7, i);
        const double x = random.uniform(-0.04, 0.04), y = random.uniform(-0.04, 0.04), z = random.uniform(-0.04, 0.04);
        mesh.positions[i] += dvec3(x, y, z);
    }
    return mesh;
}

} // namespace

std::vector<LimitSubject> limit_subjects()
{
    std::vector<LimitSubject> all;
    for (std::uint32_t n = 3; n <= 12; ++n)
        all.push_back({fmt::format("valence {}", n), prepared(around(n, false))});
    const auto add_creased = [&](const std::string& name, std::uint32_t sharp, float sharpness) {
        Mesh mesh = around(8, false);
        for (std::uint32_t k = 0; k < sharp; ++k)
            mesh.creases.push_back({0, 1 + k * 3, sharpness});
        all.push_back({name, prepared(mesh)});
    };
    add_creased("dart", 1, infinitely_sharp);
    add_creased("crease", 2, infinitely_sharp);
    add_creased("corner", 3, infinitely_sharp);
    add_creased("crease of sharpness 2.5", 2, 3.5f); // one level of it goes before the mesh is measured
    all.push_back({"border", prepared(around(5, true))});
    return all;
}

std::vector<LimitSample> limit_truth(const Mesh& mesh)
{
    constexpr int levels = 12;
    Part part{mesh, {}};
    std::vector<bool> wanted;
    for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
        const uvec3& t = mesh.triangles[f];
        part.places.push_back({f, {dvec2(0, 0), dvec2(1, 0), dvec2(0, 1)}});
        wanted.push_back(t.x == 0 || t.y == 0 || t.z == 0);
    }
    std::vector<LimitSample> samples;
    for (int level = 0; level <= levels; ++level) {
        add_samples(part, wanted, samples);
        part = refined(cropped(part));
    }
    return samples;
}
