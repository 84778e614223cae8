#include "shadow_figures.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "image_tiles.h"
#include "limn/base/parallel.h"
#include "limn/drawing/png.h"
#include "limn/lines/regions.h"
#include "limn/scene/render.h"
#include "limn/shadow/map_occlusion.h"
#include "limn/shadow/map_pictures.h"
#include "scratch_folder.h"
#include "shadow_studies.h"

using namespace limn;

namespace {

constexpr ivec2 tile_size = {320, 240}, scene_size = {960, 540}, square = {256, 256};
constexpr const char* view = "30,25";
constexpr float times_error = 10;

struct Figures {
    std::filesystem::path folder;
    std::vector<int> maps, resolutions;
    std::map<std::string, ShadowSubject> subjects = {};

    const ShadowSubject& subject(const std::string& name)
    {
        const auto found = subjects.find(name);
        return found != subjects.end() ? found->second : subjects.emplace(name, shadow_subject(name)).first->second;
    }
    int finest() const { return resolutions.back(); }
    void write(const Image& image, const char* name) const { write_png(image, folder / name); }
};

ShadowMaps baked(const ShadowSubject& subject, int maps, int resolution)
{
    BakeOptions options;
    options.maps = maps, options.resolution = resolution;
    return bake_shadow_maps(subject.mesh, options);
}

SceneObject object_of(const ShadowSubject& subject, const std::filesystem::path& maps)
{
    SceneObject object;
    object.mesh = std::make_shared<const Mesh>(subject.mesh);
    object.shadow_maps = maps;
    return object;
}

/// Objects on a ground.
Scene scene_of(std::vector<SceneObject> objects, const Light& light, int samples)
{
    Scene scene;
    scene.objects = std::move(objects);
    scene.lights = {light};
    scene.render.ground = true;
    scene.render.shadow_samples = samples;
    scene.view.up_axis = 'y';
    return scene;
}

/// A place above and beside a mesh, in lengths of its diagonal from its middle.
dvec3 place_beside(const Mesh& mesh, const dvec3& offset)
{
    const Bounds bounds = mesh.bounds();
    return bounds.centre() + glm::length(bounds.high - bounds.low) * offset;
}

Light lamp_over(const Mesh& mesh) { return Lamp{place_beside(mesh, {0.7, 1.1, 0.7})}; }
Light ball_over(const Mesh& mesh)
{
    const Bounds bounds = mesh.bounds();
    return SphereLight{place_beside(mesh, {0.7, 1.1, 0.7}), 0.1 * glm::length(bounds.high - bounds.low)};
}

Image picture_of(Scene& scene, const ivec2& size, ShadowMethod method)
{
    scene.render.shadow = method;
    const SceneModel model = prepare_scene(scene);
    return render(scene, model, Camera::framing(model.bounds, {.view = view, .size = size}));
}

Image difference(const Image& a, const Image& b)
{
    Image image(a.size(), 3);
    for (std::size_t i = 0; i < image.samples.size(); ++i)
        image.samples[i] = std::min(1.0f, times_error * std::abs(a.samples[i] - b.samples[i]));
    return image;
}

/// (a) Shadows of an object by number of maps, downwards, and texels; and ten times how far they are from those of rays.
void write_floors(Figures& figures, const ScratchFolder& scratch)
{
    const ShadowSubject& knot = figures.subject("knot");
    std::vector<Image> pictures, errors;
    const std::filesystem::path file = scratch / "floor.csm";
    for (const int count : figures.maps)
        for (const int resolution : figures.resolutions) {
            write_csm(baked(knot, count, resolution), file);
            Scene scene = scene_of({object_of(knot, file)}, lamp_over(knot.mesh), 1);
            pictures.push_back(picture_of(scene, tile_size, ShadowMethod::maps));
            errors.push_back(difference(pictures.back(), picture_of(scene, tile_size, ShadowMethod::rays)));
        }
    figures.write(tile_images(pictures, int(figures.resolutions.size())), "floor.png");
    figures.write(tile_images(errors, int(figures.resolutions.size())), "floor-errors.png");
}

/// (b) Leaves, the hardest case, and a thick object with a ball; by maps and by rays.
void write_scenes(Figures& figures, const ScratchFolder& scratch)
{
    const ShadowSubject &tree = figures.subject("tree"), &blob = figures.subject("blob"), &sphere = figures.subject("sphere");
    const std::filesystem::path tree_file = scratch / "tree.csm", blob_file = scratch / "blob.csm", ball_file = scratch / "ball.csm";
    write_csm(baked(tree, figures.maps.back(), figures.finest()), tree_file);
    write_csm(baked(blob, figures.maps.back(), figures.finest()), blob_file);
    write_csm(baked(sphere, figures.maps.back(), figures.finest()), ball_file);
    SceneObject ball = object_of(sphere, ball_file);
    const Bounds of_blob = blob.mesh.bounds(), of_ball = sphere.mesh.bounds();
    const double size = 0.4 * (of_blob.high.y - of_blob.low.y) / (of_ball.high.y - of_ball.low.y);
    ball.transform = dmat4(size);
    ball.transform[3] = dvec4(dvec3(of_blob.high.x, of_blob.low.y, of_blob.high.z) - size * dvec3(of_ball.centre().x, of_ball.low.y, of_ball.centre().z), 1);
    std::vector<Image> pictures;
    Scene leaves = scene_of({object_of(tree, tree_file)}, ball_over(tree.mesh), 64), pair = scene_of({object_of(blob, blob_file), ball}, ball_over(blob.mesh), 64);
    for (Scene* scene : {&leaves, &pair})
        for (const ShadowMethod method : {ShadowMethod::maps, ShadowMethod::rays})
            pictures.push_back(picture_of(*scene, scene_size, method));
    figures.write(tile_images(pictures, 2), "scenes.png");
}

/// (c) An object and a ground lit by a lamp, each place as light as a mean of texels says.
Image picture_of_taps(const ShadowSubject& subject, const ShadowMaps& maps, MapTaps taps)
{
    Scene scene = scene_of({object_of(subject, "")}, lamp_over(subject.mesh), 1);
    const SceneModel model = prepare_scene(scene);
    const SeenScene seen = seen_scene(model.lines, model.rays);
    const Camera camera = Camera::framing(model.bounds, {.view = view, .size = tile_size});
    const Ground ground = ground_under(seen, camera.up);
    const GroundPlane plane(ground, seen.centre, seen.scale);
    const vec3 lamp((place_beside(subject.mesh, {0.7, 1.1, 0.7}) - seen.centre) / seen.scale);
    const UnitPlacement unit = unit_placement(maps.info().sphere, dmat4(1), seen.centre, seen.scale);
    const LookUp<ShadowMaps> look(maps.layout(), maps);
    const FragmentTracer tracer(seen, camera);
    const auto tone = [&](const vec3& place, const vec3& normal) {
        const float facing = std::max(0.0f, glm::dot(normal, glm::normalize(lamp - place)));
        return 0.15f + 0.8f * facing * look.lit_share({unit.turn * place + unit.shift, vec4(unit.turn * lamp + unit.shift, 1)}, taps).value_or(1.0f);
    };
    Image image(tile_size, 1, 1.0f);
    parallel_each(std::size_t(tile_size.y), 4, [&](std::size_t y) {
        for (int x = 0; x < tile_size.x; ++x) {
            const dvec2 pixel(x + 0.5, double(y) + 0.5);
            const Fragment fragment = tracer.at(pixel);
            const GroundPlane::Point below = fragment.hit() ? GroundPlane::Point() : plane.meet(tracer.sight(pixel));
            if (fragment.hit())
                *image.at(x, int(y)) = tone(fragment.position, glm::dot(fragment.normal, fragment.to_eye) < 0 ? -fragment.normal : fragment.normal);
            else if (below.cover > 0)
                *image.at(x, int(y)) = glm::mix(1.0f, tone(below.position, plane.up()), below.cover);
        }
    });
    return image;
}

void write_taps(Figures& figures)
{
    const ShadowSubject& knot = figures.subject("knot");
    const ShadowMaps maps = baked(knot, figures.maps.back(), figures.finest());
    std::vector<Image> pictures;
    for (const MapTaps taps : {MapTaps::one, MapTaps::four, MapTaps::sixteen, MapTaps::four_maps, MapTaps::four_maps_four})
        pictures.push_back(picture_of_taps(knot, maps, taps));
    figures.write(tile_images(pictures, 3), "taps.png");
}

/// Near is light.
Image layer_picture(const std::vector<float>& depths, int size)
{
    Image image(square, 1);
    for (int y = 0; y < square.y; ++y)
        for (int x = 0; x < square.x; ++x) {
            const float depth = depths[std::size_t((square.y - 1 - y) * size / square.y) * std::size_t(size) + std::size_t(x * size / square.x)];
            *image.at(x, y) = depth == no_surface ? 0.0f : 1.0f - 0.8f * depth;
        }
    return image;
}

/// (d) to (f) Both layers of three objects; maps as they are decoded, where each brick has taken what depths it liked between them; which texels compress well.
void write_maps(Figures& figures)
{
    std::vector<Image> layers, decoded, coherences;
    for (const char* name : {"knot", "blob", "dragonfly"}) {
        const ShadowSubject& subject = figures.subject(name);
        const ShadowCaster caster = make_shadow_caster(subject.mesh);
        DepthLayers drawn;
        DepthPainter(caster, square.x).paint(DirectionGrid{DirectionSpread::even, {16, 16}}.frame({5, 2}), drawn);
        layers.push_back(layer_picture(drawn.near, drawn.size));
        layers.push_back(layer_picture(drawn.far, drawn.size));
        const ShadowMaps seed = bake_shadow_maps(subject.mesh, seed_options(figures.maps.back(), figures.finest()));
        decoded.push_back(map_sheet(seed, {2, 2}));
        coherences.push_back(coherence_map(run_counts(seed), seed.info()));
    }
    figures.write(tile_images(layers, 2), "layers.png");
    figures.write(tile_images(decoded, 3), "decoded.png");
    figures.write(tile_images(coherences, 3), "coherence.png");
}

/// (g) Soft shadows by number of maps.
void write_numbers(Figures& figures, const ScratchFolder& scratch)
{
    const ShadowSubject& knot = figures.subject("knot");
    const std::filesystem::path file = scratch / "numbers.csm";
    std::vector<Image> pictures;
    for (const int count : figures.maps) {
        write_csm(baked(knot, count, figures.finest()), file);
        Scene scene = scene_of({object_of(knot, file)}, ball_over(knot.mesh), 64);
        pictures.push_back(picture_of(scene, scene_size, ShadowMethod::maps));
    }
    figures.write(tile_images(pictures, 2), "numbers.png");
}

} // namespace

void write_shadow_figures(const std::filesystem::path& folder, const std::vector<int>& maps, const std::vector<int>& resolutions, Console& console)
{
    std::filesystem::create_directories(folder);
    const ScratchFolder scratch;
    Figures figures = {folder, maps, resolutions};
    console.progress("figures: floors", 0);
    write_floors(figures, scratch);
    console.progress("figures: scenes", 0.3);
    write_scenes(figures, scratch);
    console.progress("figures: texels", 0.6);
    write_taps(figures);
    console.progress("figures: maps", 0.7);
    write_maps(figures);
    console.progress("figures: numbers", 0.8);
    write_numbers(figures, scratch);
}
