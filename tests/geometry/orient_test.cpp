#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "geometry/meshes.h"
#include "limn/geometry/diagnose.h"
#include "limn/geometry/orient.h"
#include "limn/geometry/read_mesh.h"
#include "limn/geometry/write_mesh.h"
#include "limn/surface/shapes.h"
#include "support/support.h"

using namespace limn;

namespace {

Mesh sphere() { return make_shape({.name = "sphere", .triangles = 1000}).mesh; }

void turn(Mesh& mesh, std::size_t face) { std::swap(mesh.triangles[face].y, mesh.triangles[face].z); }

Mesh inside_out(Mesh mesh)
{
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
        turn(mesh, f);
    return mesh;
}

/// A strip of `steps` pieces around a ring, closed with or without a half twist.
Mesh strip(std::uint32_t steps, bool twisted)
{
    Mesh mesh;
    for (std::uint32_t i = 0; i < steps; ++i) {
        const double a = 2 * std::numbers::pi * i / steps, b = twisted ? a / 2 : 0;
        for (const double side : {-0.3, 0.3}) {
            const double r = 1 + side * std::cos(b);
            mesh.positions.push_back({r * std::cos(a), r * std::sin(a), side * std::sin(b)});
        }
    }
    for (std::uint32_t i = 0; i < steps; ++i) {
        const std::uint32_t p = 2 * i, q = p + 1;
        const bool last = i + 1 == steps;
        const std::uint32_t r = last ? (twisted ? 1 : 0) : p + 2, s = last ? (twisted ? 0 : 1) : q + 2;
        mesh.triangles.push_back({p, r, q});
        mesh.triangles.push_back({q, r, s});
    }
    return mesh;
}

} // namespace

TEST(Orient, TurnsTheFewerFacesBack)
{
    const Mesh clean = sphere();
    Mesh mesh = clean;
    for (const std::size_t f : {0u, 17u, 400u})
        turn(mesh, f);
    EXPECT_EQ(orient_faces(mesh), 3u);
    EXPECT_EQ(mesh.triangles, clean.triangles);
}

TEST(Orient, LeavesAMeshThatAgreesAsItIsEvenInsideOut)
{
    for (const Mesh& clean : {sphere(), inside_out(sphere()), strip(20, false), make_shape({.name = "sine-sheet", .triangles = 500}).mesh}) {
        Mesh mesh = clean;
        EXPECT_EQ(orient_faces(mesh), 0u);
        EXPECT_EQ(mesh.triangles, clean.triangles);
    }
}

TEST(Orient, GivesAClosedShellThatDisagreesItsOutsideWhateverTheMajority)
{
    Mesh mesh = inside_out(sphere());
    for (const std::size_t f : {5u, 6u, 7u})
        turn(mesh, f);
    EXPECT_EQ(orient_faces(mesh), mesh.triangles.size() - 3);
    const Diagnosis d = diagnose(mesh);
    EXPECT_TRUE(d.oriented);
    EXPECT_GT(d.volume.value_or(-1), 0);
}

TEST(Orient, AnOpenShellFollowsItsMajority)
{
    const Mesh clean = inside_out(strip(20, false));
    Mesh mesh = clean;
    turn(mesh, 0);
    turn(mesh, 9);
    EXPECT_EQ(orient_faces(mesh), 2u);
    EXPECT_EQ(mesh.triangles, clean.triangles);
}

TEST(Orient, LooksAtEachShellByItself)
{
    const Mesh one = sphere();
    Mesh mesh = one;
    const std::uint32_t offset = std::uint32_t(one.positions.size());
    for (const dvec3& p : one.positions)
        mesh.positions.push_back(p + dvec3(5, 0, 0));
    for (const uvec3& t : one.triangles)
        mesh.triangles.push_back(t + offset);
    const std::vector<uvec3> clean = mesh.triangles;
    for (std::size_t f = 0; f < one.triangles.size(); ++f) // the first is inside out and agrees: it stays
        turn(mesh, f);
    std::vector<uvec3> expected = mesh.triangles;
    turn(mesh, one.triangles.size() + 3);
    EXPECT_EQ(orient_faces(mesh), 1u);
    EXPECT_EQ(mesh.triangles, expected);
}

TEST(Orient, AMoebiusStripStaysAsItIs)
{
    const Mesh clean = strip(20, true);
    Mesh mesh = clean;
    EXPECT_EQ(orient_faces(mesh), 0u);
    EXPECT_EQ(mesh.triangles, clean.triangles);
    EXPECT_GT(diagnose(mesh).misoriented_edges, 0u);
}

TEST(Orient, AnEdgeOfThreeFacesJoinsNoNeighbours)
{
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
    EXPECT_EQ(orient_faces(mesh), 0u);
}

TEST(Orient, WhatLiesAtACornerGoesWithIt)
{
    Mesh mesh = strip(20, false);
    for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c)
        mesh.corner_uvs.push_back({float(mesh.triangles[c / 3][int(c % 3)]), 0});
    turn(mesh, 4);
    std::swap(mesh.corner_uvs[13], mesh.corner_uvs[14]);
    ASSERT_EQ(orient_faces(mesh), 1u);
    for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c)
        EXPECT_EQ(mesh.corner_uvs[c].x, float(mesh.triangles[c / 3][int(c % 3)])) << c;
}

TEST(Orient, AFileWithTurnedFacesReadsAsTheCleanOneAndSaysSo)
{
    const test::TemporaryFolder folder;
    Mesh mesh = sphere();
    write_mesh(mesh, folder / "clean.ply", {.double_positions = true});
    for (const std::size_t f : {10u, 11u, 500u})
        turn(mesh, f);
    write_mesh(mesh, folder / "turned.ply", {.double_positions = true});
    const ReadResult clean = read_mesh_with_notes(folder / "clean.ply"), turned = read_mesh_with_notes(folder / "turned.ply");
    EXPECT_EQ(turned.mesh.triangles, clean.mesh.triangles);
    EXPECT_EQ(turned.mesh.positions, clean.mesh.positions);
    EXPECT_EQ(turned.notes, std::vector<std::string>{"3 faces turned round"});
    EXPECT_TRUE(clean.notes.empty());
}
