// Checklist 4 to 9 of the procedural structures specification: lights and reflection.

#include <cmath>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/base/random.h"
#include "limn/formulas/formulas.h"
#include "limn/pattern/filament.h"
#include "limn/raycast/fragment.h"
#include "limn/surface/shapes.h"

namespace limn {
namespace {

using namespace formulas;

constexpr float pi = 3.14159265f;

vec3 at_angle(float degrees, float turn = 0)
{
    const float a = degrees * pi / 180, b = turn * pi / 180;
    return {std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)};
}

const vec3 up = {0, 0, 1};

/// Light from everywhere that comes back from a direction, by even directions on the hemisphere.
template <class Brdf> float albedo(Brdf&& brdf)
{
    float sum = 0;
    const int n = 400;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const float cosine = (float(i) + 0.5f) / float(n), sine = std::sqrt(1 - cosine * cosine),
                        turn = 2 * pi * (float(j) + 0.5f) / float(n);
            sum += brdf(vec3(sine * std::cos(turn), sine * std::sin(turn), cosine)) * cosine;
        }
    return sum * 2 * pi / float(n * n);
}

TEST(Checklist4, DirectionalLightFollowsTheCosine)
{
    EXPECT_FLOAT_EQ(facing(up, at_angle(0)), 1);
    EXPECT_NEAR(facing(up, at_angle(60)), 0.5f, 1e-6f);
    EXPECT_EQ(facing(up, at_angle(120)), 0.0f);
}

TEST(Checklist5, PointLightsFallOffWithTheSquareOrSofter)
{
    EXPECT_FLOAT_EQ(point_falloff(1, {0, 0, 1}) / point_falloff(2, {0, 0, 1}), 4);
    EXPECT_FLOAT_EQ(point_falloff(2, {1, 2, 3}), 1.0f / 17);
    const Illumination lit = lit_by_point({}, vec3(0, 0, 4), vec3(8), vec3(0, 0, 1), vec3(0, 0, 2));
    EXPECT_EQ(lit.to_light, vec3(0, 0, 1));
    EXPECT_FLOAT_EQ(lit.light.x, 2);
}

TEST(Checklist6, ModifiedPhongHasItsPeakIsReciprocalAndKeepsEnergy)
{
    const float m = 100, rho_d = 0.9f, rho_s = 0.1f;
    EXPECT_NEAR(rho_d / pi + rho_s * phong_lobe(up, at_angle(40), at_angle(40, 180), m), rho_d / pi + rho_s * (m + 2) / (2 * pi), 1e-3f);
    for (int i = 0; i < 100; ++i) {
        Random random(1, std::uint64_t(i));
        const vec3 a = at_angle(float(random.uniform(0, 89)), float(random.uniform(0, 360))),
                   b = at_angle(float(random.uniform(0, 89)), float(random.uniform(0, 360)));
        EXPECT_NEAR(phong_lobe(up, a, b, 20), phong_lobe(up, b, a, 20), 2e-5f);
    }
    for (const float angle : {0.0f, 30.0f, 60.0f, 85.0f})
        EXPECT_LE(albedo([&](const vec3& l) { return rho_d / pi + rho_s * phong_lobe(up, l, at_angle(angle), 20); }), 1.0f) << angle;
}

/// Full width at half maximum of a lobe over the angle of the eye, the light straight above, degrees.
template <class Lobe> float width_of(Lobe&& lobe)
{
    const float half = 0.5f * lobe(at_angle(0));
    float angle = 0;
    while (lobe(at_angle(angle)) > half)
        angle += 0.01f;
    return 2 * angle;
}

TEST(Checklist7, ModifiedBlinnPhongIsAsWideAsPhongWithAQuarterOfTheExponent)
{
    EXPECT_NEAR(blinn_phong_lobe(up, at_angle(30), at_angle(30, 180), 100), 108 / (8 * pi), 1e-3f);
    const float blinn = width_of([](const vec3&v) { return blinn_phong_lobe(up, up, v, 100); }),
                phong = width_of([](const vec3&v) { return phong_lobe(up, up, v, 25); });
    EXPECT_NEAR(blinn / phong, 1, 0.05f);
}

/// Extent of the half-maximum spot that a fixed eye sees over normals, across and along the plane of incidence.
template <class Lobe> float aspect(Lobe&& lobe)
{
    const float top = lobe(at_angle(80)), half = 0.5f * top;
    float along = 0, across = 0;
    while (lobe(at_angle(80 - along)) > half)
        along += 0.05f;
    while (lobe(glm::normalize(at_angle(80) + vec3(0, std::tan(across * pi / 180), 0))) > half && across < 80)
        across += 0.05f;
    return along / across;
}

TEST(Checklist7, GrazingHighlightsAreElongatedWithBlinnPhongAndRoundWithPhong)
{
    const vec3 light = at_angle(80, 180);
    EXPECT_GT(aspect([&](const vec3& v) { return blinn_phong_lobe(up, light, v, 100); }), 1.5f);
    EXPECT_NEAR(aspect([&](const vec3& v) { return phong_lobe(up, light, v, 25); }), 1, 0.1f);
}

TEST(Checklist8, HairIsTheSameForBothWaysAlongIt)
{
    const vec3 t = at_angle(50, 20), l = at_angle(30, 70), v = at_angle(60, 200);
    EXPECT_FLOAT_EQ(hair_diffuse(t, l), hair_diffuse(-t, l));
    EXPECT_FLOAT_EQ(hair_specular(t, l, v, 8, -1), hair_specular(-t, l, v, 8, -1));
    EXPECT_NEAR(hair_diffuse(t, t), 0, 1e-3f);
    EXPECT_NEAR(hair_diffuse(vec3(1, 0, 0), vec3(0, 0, 1)), 1, 1e-6f);
}

TEST(Checklist8, HighlightsOfHairLieOnTheConeOfTheirSign)
{
    const vec3 t = {1, 0, 0};
    const float light = 50 * pi / 180; // between light and tangent
    const vec3 l = {std::cos(light), 0, std::sin(light)};
    for (const float sign : {-1.0f, 1.0f}) {
        float best = -1, best_angle = 0;
        for (float angle = 0; angle <= 180; angle += 0.25f) {
            const vec3 v = {std::cos(angle * pi / 180), std::sin(angle * pi / 180), 0};
            const float value = hair_specular(t, l, v, 20, sign);
            if (value > best)
                best = value, best_angle = angle;
        }
        EXPECT_NEAR(best_angle, sign > 0 ? 50 : 130, 0.3f);
        EXPECT_NEAR(best, 1, 1e-3f);
    }
}

TEST(Ggx, KeepsEnergyAndIsReciprocal)
{
    for (const float angle : {0.0f, 40.0f, 75.0f})
        EXPECT_LE(albedo([&](const vec3& l) { return ggx_lobe(up, {1, 0, 0}, l, at_angle(angle), 0.3f, 0.5f); }), 1.01f) << angle;
    EXPECT_GT(albedo([&](const vec3& l) { return ggx_lobe(up, {1, 0, 0}, l, at_angle(20), 0.2f, 0.2f); }), 0.9f);
    const vec3 a = at_angle(30, 10), b = at_angle(60, 130);
    EXPECT_FLOAT_EQ(ggx_lobe(up, {1, 0, 0}, a, b, 0.2f, 0.5f), ggx_lobe(up, {1, 0, 0}, b, a, 0.2f, 0.5f));
}

TEST(Ggx, AmbientShareIsTheAlbedoOfTheLobe)
{
    for (const float alpha : {0.15f, 0.4f, 0.8f})
        for (const float angle : {0.0f, 45.0f, 70.0f}) {
            const vec3 v = at_angle(angle);
            const float exact = albedo([&](const vec3& l) {
                return ggx_lobe(up, {1, 0, 0}, l, v, alpha, alpha) * schlick(0.04f, glm::dot(v, glm::normalize(l + v)));
            });
            EXPECT_NEAR(ggx_ambient(0.04f, alpha, v.z), exact, 0.02f) << alpha << " " << angle;
        }
}

TEST(Filaments, AreFoundByNameAndAMistypedOneIsAnswered)
{
    EXPECT_GE(filaments().size(), 15u);
    for (const Filament& filament : filaments()) {
        const Finish finish = finish_of(find_filament(filament.name));
        EXPECT_GT(finish.along, 0.0f);
        EXPECT_LE(finish.across, 1.0f);
        EXPECT_LT(finish.f0, 0.2f);
    }
    try {
        find_filament("petg-balck");
        ADD_FAILURE() << "was found";
    } catch (const Error::Input& error) {
        EXPECT_STREQ(error.what(), "--filament: there is no 'petg-balck'; did you mean 'petg-black'?");
    }
    for (float c = 0; c <= 1; c += 0.05f)
        EXPECT_NEAR(encoded_colour(linear_colour(vec3(c))).x, c, 1e-5f);
}

// Of a coarse sphere with normals at its vertices.
TEST(Checklist9, HighlightOfACoarseSphereIsWhereThatOfTheSphereIs)
{
    const Mesh mesh = make_shape({.name = "sphere", .triangles = 600}).mesh;
    std::vector<vec3> positions, normals;
    for (const dvec3& p : mesh.positions) {
        positions.push_back(vec3(p));
        normals.push_back(vec3(glm::normalize(p)));
    }
    const std::size_t count = positions.size();
    positions.emplace_back(0);
    const RayTriangles triangles = {std::span(positions.data(), count), mesh.triangles};
    const RayScene rays(std::span(&triangles, 1));
    SeenScene scene;
    scene.rays = &rays;
    scene.objects = {{triangles, normals}};
    Camera camera;
    camera.size = {200, 200};
    camera.eye = {0, 0, 5};
    const FragmentTracer tracer(scene, camera);
    const vec3 light = glm::normalize(vec3(0.5f, 0.6f, 1));
    float best = -1;
    ivec2 found(0);
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 200; ++x) {
            const Fragment fragment = tracer.at({x + 0.5, y + 0.5});
            const float shine = fragment.hit() ? blinn_phong_lobe(fragment.normal, light, fragment.to_eye, 100) : 0;
            if (shine > best)
                best = shine, found = {x, y};
        }
    vec3 n = glm::normalize(light + vec3(0, 0, 1)); // where the half vector is the normal, by iteration
    for (int i = 0; i < 20; ++i)
        n = glm::normalize(light + glm::normalize(vec3(0, 0, 5) - n));
    const dvec2 wanted = camera.project(dvec3(n)).pixel;
    EXPECT_LT(glm::length(dvec2(found) + 0.5 - wanted), 2.0);
}

} // namespace
} // namespace limn
