#include "mesher.h"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace limn::test {
namespace {

/// Needs so many tiles for each camera, one of which arrives with each wait.
class SlowTerrain : public MovingTerrain {
public:
    SlowTerrain(std::size_t tiles, std::atomic<int>& exaggerations) : tiles_(tiles), exaggerations_(exaggerations) {}
    TerrainStep step(const Camera& camera, const ViewTolerance& tolerance) override
    {
        if (tolerance.pixels < 0)
            throw std::runtime_error("no bound");
        if (camera.eye.x != seen_)
            seen_ = camera.eye.x, missing_ = tiles_;
        TerrainStep step;
        step.missing = missing_;
        return step;
    }
    void wait() override
    {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        --missing_;
    }
    void retry() override { missing_ = tiles_; }
    void exaggerate(double) override { ++exaggerations_; }
    const HeightMap& frame() const override { return map_; }
    const PyramidLayout& layout() const override { return layout_; }
    Mesh coarse() override { return {}; }

private:
    std::size_t tiles_, missing_ = 0;
    std::atomic<int>& exaggerations_;
    double seen_ = -1;
    HeightMap map_;
    PyramidLayout layout_{make_lattice(5, 5)};
};

MeshRequest request_at(double x)
{
    MeshRequest request;
    request.camera.eye.x = x;
    return request;
}

/// Takes meshes until one is of that camera and settled.
MeshAnswer wait_for(Mesher& mesher, double x)
{
    for (int i = 0; i < 20000; ++i) {
        if (auto answer = mesher.take(); answer && answer->request.camera.eye.x == x && answer->step.is_settled())
            return *answer;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ADD_FAILURE() << "no mesh";
    return {};
}

TEST(Mesher, MakesMeshesAgainUntilNothingIsMissing)
{
    std::atomic<int> wakes = 0, exaggerations = 0;
    Mesher mesher(std::make_unique<SlowTerrain>(5, exaggerations), request_at(1), [&] { ++wakes; });
    wait_for(mesher, 1);
    EXPECT_GE(wakes, 6);
    mesher.ask(request_at(2));
    wait_for(mesher, 2);
    EXPECT_GE(wakes, 12);
    EXPECT_FALSE(mesher.take());
    EXPECT_EQ(exaggerations, 0);
}

TEST(Mesher, GoesOverToTheLatestCamera)
{
    std::atomic<int> wakes = 0, exaggerations = 0;
    Mesher mesher(std::make_unique<SlowTerrain>(30, exaggerations), request_at(1), [&] { ++wakes; });
    for (int x = 2; x <= 200; ++x)
        mesher.ask(request_at(x));
    wait_for(mesher, 200);
    EXPECT_LT(wakes, 200 * 30); // those between were passed over
}

TEST(Mesher, RaisesHeightsOnce)
{
    std::atomic<int> exaggerations = 0;
    Mesher mesher(std::make_unique<SlowTerrain>(3, exaggerations), request_at(1), [] {});
    MeshRequest higher = request_at(2);
    higher.exaggerate = 2;
    mesher.ask(higher);
    wait_for(mesher, 2);
    EXPECT_EQ(exaggerations, 1);
}

TEST(Mesher, HandsOnWhatWentWrong)
{
    std::atomic<int> exaggerations = 0;
    MeshRequest bad = request_at(1);
    bad.tolerance.pixels = -1;
    std::atomic<bool> woken = false;
    Mesher mesher(std::make_unique<SlowTerrain>(3, exaggerations), bad, [&] { woken = true; });
    while (!woken)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_THROW(mesher.take(), std::runtime_error);
}

} // namespace
} // namespace limn::test
