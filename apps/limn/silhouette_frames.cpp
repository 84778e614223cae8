#include "silhouette_frames.h"

#include <cmath>

#include <fmt/format.h>

#include "bench_table.h"
#include "console.h"
#include "limn/subdivision/loop_levels.h"

using namespace limn;

namespace {

/// Milliseconds of one frame.
struct Frame {
    double pose = 0, silhouette = 0, upload = 0, draw = 0;
};

FrameParts medians(std::string way, const std::vector<Frame>& frames, bool uploads_when_still)
{
    std::vector<double> pose, silhouette, upload, draw, frame, still;
    for (const Frame& f : frames) {
        pose.push_back(f.pose), silhouette.push_back(f.silhouette), upload.push_back(f.upload), draw.push_back(f.draw);
        frame.push_back(f.pose + f.silhouette + f.upload + f.draw);
        still.push_back(f.silhouette + (uploads_when_still ? f.upload : 0) + f.draw);
    }
    return {std::move(way), median(pose), median(silhouette), median(upload), median(draw), median(frame), median(still)};
}

/// The control mesh as it breathes: another pose for each number, the first and the last alike.
std::vector<dvec3> posed(const SilhouetteSubject& subject, std::size_t number, std::size_t count)
{
    constexpr double part = 0.05;
    const double size = subject.bounds().radius(), phase = 6.283185307179586 * double(number) / double(count);
    std::vector<dvec3> positions = subject.control().positions;
    for (dvec3& p : positions)
        p *= 1 + part * std::sin(phase + 3 * p.y / size);
    return positions;
}

/// Times frames of the mesh as it breathes; the first does not count.
/// @param make  make(positions, camera, frame) fills in the times up to the upload, and uploads
template <class Make> std::vector<Frame> time_frames(const SilhouetteSubject& subject, const std::vector<Camera>& cameras, MeshPainter& painter, Make&& make)
{
    std::vector<Frame> frames;
    for (std::size_t i = 0; i <= cameras.size(); ++i) {
        const Camera& camera = cameras[i % cameras.size()];
        const std::vector<dvec3> positions = posed(subject, i, cameras.size());
        Frame frame;
        make(positions, camera, frame);
        Stopwatch watch;
        painter.draw(camera, subject.bounds());
        frame.draw = 1e3 * watch.lap();
        if (i > 0)
            frames.push_back(frame);
    }
    return frames;
}

/// @param make  make(positions, camera, frame) fills in the pose's and the silhouette's times and returns a mesh with normals
template <class Make> std::vector<Frame> time_made(const SilhouetteSubject& subject, const std::vector<Camera>& cameras, MeshPainter& painter, Make&& make)
{
    return time_frames(subject, cameras, painter, [&](const std::vector<dvec3>& positions, const Camera& camera, Frame& frame) {
        const SilhouetteMesh made = make(positions, camera, frame);
        Stopwatch watch;
        painter.keep_triangles(made.mesh.triangles);
        painter.upload(made.mesh.positions, std::span<const vec3>(made.mesh.corner_normals));
        frame.upload = 1e3 * watch.lap();
    });
}

std::vector<Frame> time_level(const SilhouetteSubject& subject, const std::vector<Camera>& cameras, MeshPainter& painter, int level)
{
    const LoopLevels kept(subject.control().topology, level);
    const LoopTopology& topology = kept.topology(level);
    painter.keep_triangles(topology.triangles);
    LevelPositions fine;
    LimitSurface limit;
    return time_frames(subject, cameras, painter, [&](const std::vector<dvec3>& positions, const Camera&, Frame& frame) {
        Stopwatch watch;
        kept.pose(positions, fine);
        limit_surface(topology, fine.back(), CreaseRule::opensubdiv, limit);
        frame.pose = 1e3 * watch.lap();
        painter.upload(limit.positions, std::span<const dvec3>(limit.normals));
        frame.upload = 1e3 * watch.lap();
    });
}

} // namespace

std::vector<FrameParts> time_silhouette_frames(const SilhouetteSubject& subject, const std::vector<Camera>& cameras, MeshPainter& painter, int levels)
{
    std::vector<FrameParts> all;
    all.push_back(medians("exact", time_made(subject, cameras, painter, [&](const std::vector<dvec3>& positions, const Camera& camera, Frame& frame) {
                              Stopwatch watch;
                              const SilhouettePose pose = pose_silhouette(subject.table(), positions);
                              frame.pose = 1e3 * watch.lap();
                              SilhouetteMesh made = exact_silhouette(pose, camera);
                              frame.silhouette = 1e3 * watch.lap();
                              return made;
                          }), true));
    all.push_back(medians("seed", time_made(subject, cameras, painter, [&](const std::vector<dvec3>& positions, const Camera& camera, Frame& frame) {
                              Stopwatch watch;
                              const SeedPose pose = make_seed_pose(subject.seed_surface(), positions);
                              frame.pose = 1e3 * watch.lap();
                              SilhouetteMesh made = seed_silhouette(subject.seed_surface(), pose, eye_of(camera));
                              frame.silhouette = 1e3 * watch.lap();
                              return made;
                          }), true));
    for (int level = 1; level <= levels; ++level)
        all.push_back(medians(fmt::format("level {}", level), time_level(subject, cameras, painter, level), false));
    return all;
}
