// Patterns under environments, with places that are closed in, and on faceted models (checklist 1 of the procedural structures specification).

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "limn/base/srgb.h"
#include "limn/formulas/formulas.h"
#include "limn/lines/regions.h"
#include "limn/pattern/filament.h"
#include "limn/raycast/gbuffer.h"
#include "limn/scene/render.h"
#include "limn/surface/shapes.h"

namespace limn {
namespace {

constexpr double whole_environment = 3.4; ///< irradiance on the side that gets most

Mesh shape(const std::string& name, std::size_t triangles = 4000) { return make_shape({.name = name, .triangles = triangles}).mesh; }

/// A level plate and, along its far edge, an upright one, both 20 long: y is up.
Mesh crease()
{
    Mesh mesh;
    mesh.positions = {{-10, 0, 0}, {10, 0, 0}, {10, 0, 1}, {-10, 0, 1}, {-10, 1, 0}, {10, 1, 0}};
    mesh.triangles = {{0, 3, 2}, {0, 2, 1}, {0, 1, 5}, {0, 5, 4}};
    return mesh;
}

/// Bricks without joints, reliefs and differences: one even colour, matte.
PatternOptions even_bricks(const vec3& encoded)
{
    PatternOptions pattern;
    pattern.kind = PatternKind::bricks;
    pattern.brick_relief = 0;
    pattern.variety = 0;
    pattern.brick_colour = pattern.mortar_colour = encoded;
    return pattern;
}

Scene scene_of(const Mesh& mesh, const PatternOptions& pattern)
{
    Scene scene;
    SceneObject object;
    object.mesh = std::make_shared<const Mesh>(mesh);
    scene.objects = {object};
    scene.pattern = pattern;
    scene.render.samples = 1;
    return scene;
}

Camera camera_at(const dvec3& eye, const dvec3& look, double height, ivec2 size = {80, 80})
{
    Camera camera;
    camera.eye = eye;
    camera.look = look;
    if (std::abs(glm::normalize(look - eye).y) > 0.99)
        camera.up = {0, 0, -1};
    camera.size = size;
    camera.orthographic = true;
    camera.ortho_height = height;
    return camera;
}

vec3 linear_at(const Image& image, int x, int y)
{
    const float* c = image.at(x, y);
    return {linear_from_srgb(c[0]), linear_from_srgb(c[1]), linear_from_srgb(c[2])};
}

WantedWideLight environment(const Image& picture) { return EnvironmentFile{"given", std::make_shared<const EnvironmentMap>(picture)}; }

TEST(PatternEnvironment, OfOneRadianceGivesEveryPlaceItsAlbedoTimesThatRadiance)
{
    Scene scene = scene_of(shape("sphere"), even_bricks({0.5f, 0.4f, 0.3f}));
    scene.render.wide = environment(Image({32, 16}, 3, 0.7f));
    scene.render.shadow = ShadowMethod::nothing;
    scene.render.shadow_samples = 256;
    for (const dvec3& from : {dvec3(0, 0, 9), dvec3(6, 6, -3)}) {
        const Image image = render(scene, camera_at(from, dvec3(0), 2.4));
        for (int y = 10; y < 70; y += 6)
            for (int x = 10; x < 70; x += 6) {
                if (std::hypot(x - 40, y - 40) > 30)
                    continue;
                const vec3 wanted = linear_colour({0.5f, 0.4f, 0.3f}) * float(whole_environment / std::numbers::pi),
                           seen = linear_at(image, x, y);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(seen[c] / wanted[c], 1, 0.04) << x << " " << y << " from " << from.x;
            }
    }
}

TEST(PatternEnvironment, LightsTheSideThatItIsBrightOnAndTakesItsColour)
{
    // Its left half is yellow: one who looks at the front, along z, has x above 0 to the left.
    Image picture({64, 32}, 3, 0.0f);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            picture.at(x, y)[0] = picture.at(x, y)[1] = 1;
    for (const PatternKind kind : {PatternKind::layers, PatternKind::bricks, PatternKind::thread}) {
        Scene scene = scene_of(shape("sphere"), even_bricks(vec3(0.7f)));
        scene.pattern.kind = kind;
        scene.pattern.layer_height = 5;
        scene.pattern.filter_width = 3;
        scene.render.wide = environment(picture);
        scene.render.background = vec3(0);
        const Image image = render(scene, camera_at({0, 0, 9}, dvec3(0), 2.4));
        double right = 0, left = 0, other = 0;
        for (int y = 20; y < 60; ++y)
            for (int x = 12; x < 28; ++x) {
                left += double(linear_at(image, x, y).x);
                right += double(linear_at(image, 79 - x, y).x);
                other += double(linear_at(image, 79 - x, y).z);
            }
        EXPECT_GT(right, 2.5 * left) << int(kind);
        EXPECT_GT(left, 0) << "half of it reaches around the middle";
        EXPECT_LT(other, 1e-3 * right);
    }
}

TEST(PatternEnvironment, IsHiddenByWhatStandsBeforeIt)
{
    // Over the foot of a wall half of the sky is hidden, and a quarter of all directions' cosine less on a plate of its length.
    Scene scene = scene_of(crease(), even_bricks(vec3(0.6f)));
    scene.render.wide = environment(Image({32, 16}, 3, 1.0f));
    scene.render.shadow_samples = 512;
    scene.render.shadow = ShadowMethod::rays;
    const Image image = render(scene, camera_at({0, 9, 0.5}, {0, 0, 0.5}, 1));
    for (const int y : {4, 12, 24, 40, 60, 76}) {
        const double away = (y + 0.5) / 80, open = 0.5 * (1 + away / std::hypot(away, 1.0));
        double seen = 0;
        for (int x = 0; x < 80; ++x) // each pixel turns the light its own way
            seen += double(linear_at(image, x, y).y) / 80;
        EXPECT_NEAR(seen / (double(linear_from_srgb(0.6f)) * whole_environment / std::numbers::pi), open, 0.04) << away;
    }
}

TEST(PatternOpenness, DarkensACreaseAsItHidesItsSurroundingsAndLeavesAPlateAlone)
{
    Scene scene = scene_of(crease(), even_bricks(vec3(0.6f)));
    scene.render.light = dvec3(0, 1, 1);
    scene.render.shadow = ShadowMethod::nothing;
    scene.render.shadow_samples = 256;
    const Camera camera = camera_at({0, 9, 0.5}, {0, 0, 0.5}, 1);
    const Image plain = render(scene, camera);
    scene.render.openness = 1e6; // as far as anything is
    const Image closed = render(scene, camera);
    for (const int y : {2, 12, 24, 40, 60, 76}) {
        const double away = (y + 0.5) / 80, open = 0.5 * (1 + away / std::hypot(away, 1.0));
        double share = 0;
        for (int x = 0; x < 80; ++x)
            share += double(linear_at(closed, x, y).y / linear_at(plain, x, y).y) / 80;
        EXPECT_NEAR(share, open, 0.02) << "the wall, 1 high, seen from " << away << " before it";
    }
    Scene alone = scene_of(shape("plane"), even_bricks(vec3(0.6f)));
    const Camera front = camera_at({0, 0, 9}, dvec3(0), 1);
    const Image without = render(alone, front);
    alone.render.openness = 1e6;
    EXPECT_EQ(render(alone, front).samples, without.samples);
}

TEST(PatternOpenness, DarkensPrintsBricksAndThreadAlike)
{
    for (const PatternKind kind : {PatternKind::layers, PatternKind::bricks, PatternKind::thread}) {
        Scene scene = scene_of(shape("knot", 8000), {});
        scene.pattern.kind = kind;
        scene.pattern.layer_height = 1;
        scene.render.shadow_samples = 16;
        const Camera camera = camera_at({0, 0, 20}, dvec3(0), 8);
        const Image open = render(scene, camera);
        scene.render.openness = 0.5;
        const Image closed = render(scene, camera);
        std::size_t darker = 0, lighter = 0;
        for (std::size_t i = 0; i < open.samples.size(); ++i) {
            darker += closed.samples[i] < open.samples[i] - 0.03f;
            lighter += closed.samples[i] > open.samples[i] + 1e-4f;
        }
        EXPECT_GT(darker, open.samples.size() / 100) << int(kind);
        EXPECT_EQ(lighter, 0u) << int(kind);
    }
}

// Faceted: all three corners of a face are shaded by its own normal, to 1e-5.
TEST(Checklist1, FacesOfAFacetedModelAreShadedByTheirOwnNormal)
{
    const Mesh ball = shape("sphere", 300);
    Scene scene = scene_of(ball, even_bricks(vec3(0.6f)));
    scene.render.shading = Shading::flat;
    scene.render.light = dvec3(1, 2, 3);
    scene.render.shadow = ShadowMethod::nothing;
    const Camera camera = camera_at({0, 0, 9}, dvec3(0), 2.2, {160, 160});
    const SceneModel model = prepare_scene(scene);
    const GBuffer seen = trace_gbuffer(seen_scene(model.lines, model.rays), camera);
    const Image image = render(scene, model, camera);
    const vec3 to_light = glm::normalize(vec3(1, 2, 3));
    const auto shaded = [&](const vec3& n) { // light, sky and floor as a light far away has them
        const formulas::Illumination lit = {to_light, vec3(2.6f), 0.05f, {0, 1, 0}, vec3(0.4f), vec3(0.14f)};
        return formulas::shown_light(
            formulas::reflected({formulas::FINISH_MATTE, linear_colour(vec3(0.6f)), 0, 1, 1, 1, 0}, n, {1, 0, 0}, {0, 0, 1}, 0, lit));
    };
    std::vector<int> corners(model.lines.faces.size(), 0); // one bit for each that pixels are near to
    int pixels = 0;
    for (int y = 0; y < 160; ++y)
        for (int x = 0; x < 160; ++x) {
            const std::size_t i = std::size_t(160 * y + x);
            if (seen.objects[i] == none)
                continue;
            const std::uint32_t face = seen.triangles[i];
            const uvec3& t = model.lines.faces[face];
            const auto corner = [&](std::uint32_t v) { return model.lines.centre + model.lines.scale * dvec3(model.lines.positions[v]); };
            const dvec3 a = corner(t.x), b = corner(t.y), c = corner(t.z);
            const vec3 n(glm::normalize(glm::cross(b - a, c - a))), wanted = shaded(n), found = linear_at(image, x, y);
            ASSERT_LT(glm::length(found - wanted), 1e-5f * 10) << "radiance changes up to 3 times as fast as the normal";
            ++pixels;
            const dvec2 at = {(x + 0.5 - 80) * 2.2 / 160, (80 - y - 0.5) * 2.2 / 160};
            int k = 0;
            for (const dvec3& place : {a, b, c}) {
                corners[face] |= glm::length(dvec2(place) - at) < 0.03 ? 1 << k : 0;
                ++k;
            }
        }
    EXPECT_GT(pixels, 10000);
    EXPECT_GT(std::count(corners.begin(), corners.end(), 7), 40) << "faces of which all three corners were looked at";
}

} // namespace
} // namespace limn
