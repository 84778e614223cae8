// Checklist item 30 of the contour-lines specification: a cache of surfaces, keyed by the mesh, written only where it is told to.

#include "limn/surface/surface_cache.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/surface/shapes.h"
#include "support/support.h"

namespace limn {
namespace {

template <class T> bool same_bytes(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same_bytes(const Surface& a, const Surface& b)
{
    return same_bytes(a.normals, b.normals) && same_bytes(a.e1, b.e1) && same_bytes(a.e2, b.e2) && same_bytes(a.k1, b.k1) && same_bytes(a.k2, b.k2)
        && same_bytes(a.derivative, b.derivative) && same_bytes(a.unreliable, b.unreliable);
}

class SurfaceCache : public testing::Test {
protected:
    CachedSurface estimate(const Mesh& mesh, const EstimateOptions& options = {}) const { return estimate_surface_cached(mesh, options, cache()); }
    std::filesystem::path cache() const { return folder_ / "deep/cache"; }
    std::vector<std::filesystem::path> entries() const
    {
        std::vector<std::filesystem::path> found;
        for (const auto& entry : std::filesystem::directory_iterator(cache()))
            found.push_back(entry.path());
        return found;
    }

    test::TemporaryFolder folder_;
    Mesh mesh_ = make_shape({.name = "blob", .triangles = 2000, .jitter = 0.2}).mesh;
    Surface plain_ = estimate_surface(mesh_);
};

TEST_F(SurfaceCache, TheSecondRunReadsTheSameBytes)
{
    const CachedSurface first = estimate(mesh_), second = estimate(mesh_);
    EXPECT_FALSE(first.from_cache);
    EXPECT_TRUE(second.from_cache);
    EXPECT_TRUE(same_bytes(first.surface, plain_));
    EXPECT_TRUE(same_bytes(second.surface, plain_));
    EXPECT_EQ(entries().size(), 1u);
}

TEST_F(SurfaceCache, AnotherMeshOrOtherOptionsAreAnotherEntry)
{
    estimate(mesh_);
    Mesh moved = mesh_, turned = mesh_;
    moved.positions[7].x = std::nextafter(moved.positions[7].x, 9.0);
    std::swap(turned.triangles[0], turned.triangles[1]);
    EXPECT_FALSE(estimate(moved).from_cache);
    EXPECT_FALSE(estimate(turned).from_cache);
    for (const EstimateOptions& options : {EstimateOptions{Need::curvature}, EstimateOptions{Need::derivative, CurvatureMethod::tensor},
                                           EstimateOptions{Need::derivative, CurvatureMethod::jets, 4}, EstimateOptions{Need::derivative, CurvatureMethod::jets, 0, 2}})
        EXPECT_FALSE(estimate(mesh_, options).from_cache);
    EXPECT_EQ(entries().size(), 7u);
    EXPECT_TRUE(estimate(mesh_).from_cache);
}

TEST_F(SurfaceCache, ADamagedEntryIsIgnoredAndReplaced)
{
    estimate(mesh_);
    const std::filesystem::path entry = entries().at(0);
    const std::string whole = test::read_text(entry);
    std::vector<std::string> damaged = {"", "x", whole.substr(0, 15), whole.substr(0, whole.size() / 2), whole.substr(0, whole.size() - 1), whole + "x"};
    for (std::size_t at = 0; at < whole.size(); at += whole.size() / 40) {
        damaged.push_back(whole);
        damaged.back()[at] ^= 0x20;
    }
    for (std::size_t i = 0; i < damaged.size(); ++i) {
        test::write_text(entry, damaged[i]);
        const CachedSurface again = estimate(mesh_);
        EXPECT_FALSE(again.from_cache) << "damage " << i;
        EXPECT_TRUE(same_bytes(again.surface, plain_)) << "damage " << i;
        EXPECT_EQ(test::read_text(entry), whole) << "damage " << i;
    }
}

TEST_F(SurfaceCache, AnEntryOfAnotherMeshUnderThisNameIsIgnored)
{
    estimate(mesh_);
    const std::filesystem::path entry = entries().at(0);
    const std::string whole = test::read_text(entry);
    Mesh moved = mesh_;
    moved.positions[0] *= 1.001;
    estimate(moved);
    for (const std::filesystem::path& other : entries())
        if (other != entry) {
            std::filesystem::copy_file(other, entry, std::filesystem::copy_options::overwrite_existing);
        }
    EXPECT_FALSE(estimate(mesh_).from_cache);
    EXPECT_EQ(test::read_text(entry), whole);
}

TEST_F(SurfaceCache, AFolderThatCannotBeMadeIsAnError)
{
    test::write_text(folder_ / "file", "");
    EXPECT_THROW(estimate_surface_cached(mesh_, {}, folder_ / "file/cache"), Error::Write);
}

} // namespace
} // namespace limn
