#include <gtest/gtest.h>

#include <map>

#include "limn/base/error.h"
#include "limn/geometry/diagnose.h"
#include "limn/surface/model_samples.h"

namespace limn::test {
namespace {

double volume(const Mesh& mesh)
{
    double sum = 0;
    for (const uvec3& t : mesh.triangles)
        sum += glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z])) / 6;
    return sum;
}

/// The meshes of a mesh's shells: triangles that share vertices.
std::vector<Mesh> shells_of(const Mesh& mesh)
{
    std::vector<std::uint32_t> parent(mesh.positions.size());
    for (std::uint32_t i = 0; i < parent.size(); ++i)
        parent[i] = i;
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i)
            i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const uvec3& t : mesh.triangles)
        parent[root(t.y)] = root(t.x), parent[root(t.z)] = root(t.x);
    std::map<std::uint32_t, Mesh> shells;
    for (const uvec3& t : mesh.triangles) {
        Mesh& shell = shells[root(t.x)];
        shell.positions = {};
        shell.triangles.push_back(t);
    }
    std::vector<Mesh> all;
    for (auto& [first, shell] : shells) {
        shell.positions = mesh.positions;
        all.push_back(std::move(shell));
    }
    return all;
}

TEST(ModelSamples, AreClosedShellsThatFaceOutwards)
{
    for (const std::string& name : model_sample_names()) {
        const Mesh mesh = make_model_sample(name);
        const Diagnosis diagnosis = diagnose(mesh);
        EXPECT_TRUE(diagnosis.closed) << name;
        for (const Mesh& shell : shells_of(mesh))
            ASSERT_GT(volume(shell), 0) << name;
    }
}

TEST(ModelSamples, HaveThinParts)
{
    const auto shells = [](const std::string& name) { return shells_of(make_model_sample(name)); };
    EXPECT_EQ(shells("tree").size(), 1u + 4 + 16 + 64 + 256 + 6 * 256);
    EXPECT_EQ(shells("dragonfly").size(), 4u + 6 + 4);
    for (const std::string& name : model_sample_names()) {
        const Bounds bounds = make_model_sample(name).bounds();
        const dvec3 size = bounds.high - bounds.low;
        EXPECT_NEAR(std::max({size.x, size.y, size.z}), 2, 0.4) << name;
    }
}

TEST(ModelSamples, GrowFromTheirSeed)
{
    EXPECT_EQ(make_model_sample("tree", 1).positions, make_model_sample("tree", 1).positions);
    EXPECT_NE(make_model_sample("tree", 1).positions, make_model_sample("tree", 2).positions);
    EXPECT_THROW(make_model_sample("bush"), Error::Input);
}

} // namespace
} // namespace limn::test
