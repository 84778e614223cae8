#include "shadow_pictures.h"

#include <algorithm>
#include <atomic>

#include <fmt/format.h>

#include "console.h"
#include "limn/base/parallel.h"
#include "limn/lines/regions.h"
#include "limn/raycast/occlusion.h"
#include "limn/scene/render.h"
#include "scratch_folder.h"
#include "timed.h"

using namespace limn;

namespace {

constexpr ivec2 picture_size = {1920, 1080};

/// Counts what another one would be asked, and tells at once that nothing hides light: what a picture takes beyond one with this is the answers' time.
class Idle : public Occlusion {
public:
    explicit Idle(std::shared_ptr<const Occlusion> of) : of_(std::move(of)) {}
    void look(const vec3&, std::span<const LightPlace> to, std::uint8_t* lit) const override
    {
        asked_.fetch_add(to.size(), std::memory_order_relaxed);
        std::fill_n(lit, to.size(), std::uint8_t(1));
    }
    bool may_hide(const vec3& from, const Ball& light) const override { return of_->may_hide(from, light); }
    std::size_t asked() const { return asked_; }

private:
    std::shared_ptr<const Occlusion> of_;
    mutable std::atomic<std::size_t> asked_ = 0;
};

/// The object on a ground, under a ball of light as large as a quarter of it.
Scene scene_of(const ShadowSubject& subject, const std::filesystem::path& maps)
{
    Scene scene;
    SceneObject object;
    object.mesh = std::make_shared<const Mesh>(subject.mesh);
    object.shadow_maps = maps;
    scene.objects = {object};
    scene.render.ground = true;
    scene.view.up_axis = 'y';
    const Bounds bounds = subject.mesh.bounds();
    const double size = glm::length(bounds.high - bounds.low);
    scene.lights = {SphereLight{0.5 * (bounds.low + bounds.high) + size * dvec3(0.7, 1.1, 0.7), 0.12 * size}};
    return scene;
}

struct PictureTimes {
    double seconds = 0;
    double idle_seconds = 0; ///< without the look-ups
    std::size_t queries = 0;
};

PictureTimes time_picture(Scene& scene, const SceneModel& model, const Camera& camera, ShadowMethod method)
{
    scene.render.shadow = method;
    const SeenScene seen = seen_scene(model.lines, model.rays);
    ShadeOptions options = pixel_options(scene, model, model.lines, seen).shade;
    const auto seconds = [&] { return ms_of([&] { shade(seen, camera, options); }) / 1000; };
    PictureTimes times = {seconds(), 0, 0};
    if (const std::shared_ptr<const Occlusion> own = options.occlusion) {
        const auto idle = std::make_shared<const Idle>(own);
        options.occlusion = idle;
        times.idle_seconds = seconds();
        times.queries = idle->asked();
    }
    return times;
}

std::string nanoseconds_text(const PictureTimes& times)
{
    const double threads = tbb::this_task_arena::max_concurrency();
    return fmt::format("{:.0f}", 1e9 * threads * std::max(0.0, times.seconds - times.idle_seconds) / double(std::max<std::size_t>(1, times.queries)));
}

} // namespace

void add_pictures(const ShadowSubject& subject, int maps, int resolution, const std::vector<int>& all_samples, MarkdownTable& table)
{
    const ScratchFolder folder;
    const std::filesystem::path file = folder / "maps.csm";
    BakeOptions bake;
    bake.maps = maps, bake.resolution = resolution;
    write_csm(bake_shadow_maps(subject.mesh, bake), file);
    Scene scene = scene_of(subject, file);
    const SceneModel model = prepare_scene(scene);
    const Camera camera = Camera::framing(model.bounds, {.view = "30,25", .size = picture_size});
    for (const int samples : all_samples) {
        scene.render.shadow_samples = samples;
        const PictureTimes unhidden = time_picture(scene, model, camera, ShadowMethod::nothing), by_rays = time_picture(scene, model, camera, ShadowMethod::rays),
                           by_maps = time_picture(scene, model, camera, ShadowMethod::maps);
        table.add({subject.name, std::to_string(samples), fmt::format("{:.1f}", double(by_maps.queries) / 1e6), fmt::format("{:.2f}", unhidden.seconds), fmt::format("{:.2f}", by_rays.seconds),
                   fmt::format("{:.2f}", by_maps.seconds), fmt::format("{:.2f}", by_maps.seconds / by_rays.seconds), nanoseconds_text(by_rays), nanoseconds_text(by_maps)});
    }
}

void add_list_lengths(const ShadowSubject& subject, int maps, int resolution, MarkdownTable& table)
{
    const ShadowMaps seed = bake_shadow_maps(subject.mesh, seed_options(maps, resolution));
    std::vector<std::size_t> lengths;
    for (std::size_t texel = 0; texel < std::size_t(resolution) * std::size_t(resolution); ++texel)
        lengths.push_back(seed.segments()->list(texel).size());
    std::sort(lengths.begin(), lengths.end());
    std::vector<std::string> row = {subject.name, with_thousands(std::size_t(maps))};
    for (const int hundredths : {0, 10, 25, 50, 75, 90, 99, 100})
        row.push_back(with_thousands(lengths[std::min(lengths.size() - 1, lengths.size() * std::size_t(hundredths) / 100)]));
    table.add(row);
}
