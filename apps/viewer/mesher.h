#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "limn/scene/moving_terrain.h"

/// What a window wants to see of a terrain.
struct MeshRequest {
    limn::Camera camera;
    limn::ViewTolerance tolerance;
    double exaggerate = 1;
    std::size_t tries = 0; ///< counts how often what could not be read was to be tried again

    bool operator==(const MeshRequest&) const = default;
};

/// A mesh with the request that it was made for.
struct MeshAnswer {
    MeshRequest request;
    limn::TerrainStep step;
    double milliseconds = 0; ///< to make it
};

/// Makes the meshes of a moving terrain on a thread of its own, always for the latest camera, and again when a tile has arrived: so a window never waits.
class Mesher {
public:
    /// @param wake  called on that thread when there is something to take
    Mesher(std::unique_ptr<limn::MovingTerrain> terrain, const MeshRequest& first, std::function<void()> wake);
    Mesher(const Mesher&) = delete;
    Mesher& operator=(const Mesher&) = delete;

    void ask(const MeshRequest& request);
    /// The newest mesh since the last call. @throws what making it threw
    std::optional<MeshAnswer> take();

private:
    void work(const std::stop_token& stop);
    void make(const MeshRequest& request);

    std::unique_ptr<limn::MovingTerrain> terrain_;
    std::function<void()> wake_;
    std::mutex lock_;
    std::condition_variable_any changed_;
    std::optional<MeshRequest> wanted_;
    std::optional<MeshAnswer> answer_;
    std::exception_ptr fault_;
    MeshRequest last_; ///< of the thread: what was made before
    bool settled_ = false;
    std::jthread thread_; ///< last, so that it ends before what it uses goes
};
