#include <cmath>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/formulas/formulas.h"
#include "limn/lines/draw.h"
#include "limn/lines/regions.h"
#include "limn/scene/passes.h"
#include "limn/scene/render_options.h"
#include "limn/surface/shape_truth.h"
#include "limn/surface/shapes.h"

namespace limn {
namespace {

/// A generated shape with its exact fields, twice as large as the frame of the model would have it, and what a camera sees of it.
struct Seen {
    Shape shape;
    LineModel model;
    RayScene rays;
    Camera camera;
    GBuffer buffer;

    Seen(const std::string& name, std::size_t triangles)
        : shape(make_shape({.name = name, .triangles = triangles, .float_positions = false})), model(model_of(shape)), rays(build_ray_scene(model))
    {
        camera.eye = {3, 2, 4};
        camera.size = {120, 100};
        camera.up = {0, 0, 1};
        const SeenScene scene = seen_scene(model, rays);
        buffer = trace_gbuffer(scene, camera);
    }

    static LineModel model_of(const Shape& shape)
    {
        const PlacedSurface placed = {&shape.mesh, &shape.exact};
        return build_line_model({&placed, 1});
    }

    PassImage pass(Pass which) const { return make_pass(model, buffer, camera, which); }

    /// Calls f(world point, pixel value) for the pixels that show the shape; returns how many there are.
    template <class F> int each(const PassImage& pass, F&& f) const
    {
        int count = 0;
        for (int y = 0; y < camera.size.y; ++y)
            for (int x = 0; x < camera.size.x; ++x)
                if (const std::size_t i = buffer.index(x, y); buffer.triangles[i] != none) {
                    f(model.to_world(buffer.positions[i]), pass.values.at(x, y));
                    ++count;
                }
        return count;
    }
};

TEST(Passes, OfASphereAreWhatGeometrySays)
{
    const Seen sphere("sphere", 50000);
    const auto view = [&](const dvec3& p) { return glm::normalize(sphere.camera.eye - p); };
    EXPECT_GT(sphere.each(sphere.pass(Pass::ndotv), [&](const dvec3& p, const float* v) { EXPECT_NEAR(v[0], glm::dot(glm::normalize(p), view(p)), 1e-3); }), 1000);
    sphere.each(sphere.pass(Pass::normal), [&](const dvec3& p, const float* v) { EXPECT_LE(glm::distance(dvec3(v[0], v[1], v[2]), glm::normalize(p)), 1e-3); });
    sphere.each(sphere.pass(Pass::position), [&](const dvec3& p, const float* v) { EXPECT_LE(glm::distance(dvec3(v[0], v[1], v[2]), p), 1e-6); });
    sphere.each(sphere.pass(Pass::depth), [&](const dvec3& p, const float* v) { EXPECT_NEAR(v[0], sphere.camera.project(p).depth, 1e-4); });
    for (const Pass pass : {Pass::k1, Pass::k2, Pass::kr})
        sphere.each(sphere.pass(pass), [&](const dvec3&, const float* v) { EXPECT_NEAR(v[0], 1, 1e-4); });
    sphere.each(sphere.pass(Pass::dwkr), [&](const dvec3&, const float* v) { EXPECT_NEAR(v[0], 0, 1e-3); });
    sphere.each(sphere.pass(Pass::id), [&](const dvec3&, const float* v) { EXPECT_EQ(v[0], 1); });
}

// The same quantities straight from the exact shape at the point that each pixel shows.
TEST(Passes, OfATorusFollowTheExactCurvature)
{
    const Seen torus("torus", 150000);
    const ShapeTruth truth("torus");
    const auto terms = [&](const SurfacePoint& x) {
        return formulas::radial_terms(vec3(torus.camera.eye - x.position), vec3(x.normal), vec3(x.e1), vec3(x.e2), float(x.k1), float(x.k2));
    };
    EXPECT_GT(torus.each(torus.pass(Pass::kr), [&](const dvec3& p, const float* v) {
        const SurfacePoint x = truth.project(p);
        const formulas::RadialTerms t = terms(x);
        if (t.w2 > 0.2f * t.vv) { // not seen head-on, where no direction is radial
            EXPECT_NEAR(v[0], formulas::radial_curvature(t, float(x.k1), float(x.k2)), 0.02);
        }
    }), 1000);
    torus.each(torus.pass(Pass::dwkr), [&](const dvec3& p, const float* v) {
        const SurfacePoint x = truth.project(p);
        const formulas::RadialTerms t = terms(x);
        if (t.w2 > 0.2f * t.vv && t.nv * t.nv > 0.01f * t.vv) { // seen neither head-on nor edge-on
            EXPECT_NEAR(v[0], formulas::radial_curvature_derivative(t, float(x.k1), float(x.k2), vec4(x.derivative)), 0.15);
        }
    });
}

TEST(Passes, BackgroundIsNoNumberAndIdZero)
{
    const Seen sphere("sphere", 1000);
    EXPECT_TRUE(std::isnan(sphere.pass(Pass::kr).values.at(0, 0)[0]));
    EXPECT_EQ(sphere.pass(Pass::id).values.at(0, 0)[0], 0);
}

TEST(Passes, WholeNumbersGiveTheValuesBackWithinAStep)
{
    const Seen torus("torus", 20000);
    for (const Pass pass : {Pass::kr, Pass::depth, Pass::normal, Pass::ndotv}) {
        const PassImage image = torus.pass(pass);
        const Image whole = pass_for_whole_numbers(image);
        const double step = (image.high - image.low) / 65534;
        for (std::size_t i = 0; i < whole.samples.size(); ++i) {
            const double sample = std::round(65535.0 * double(whole.samples[i]));
            if (std::isnan(image.values.samples[i]))
                ASSERT_EQ(sample, 0);
            else
                ASSERT_NEAR(image.low + (sample - 1) * step, image.values.samples[i], 0.51 * step + 1e-6);
        }
    }
    PassImage many = torus.pass(Pass::id);
    EXPECT_EQ(std::round(65535 * pass_for_whole_numbers(many).at(60, 50)[0]), many.values.at(60, 50)[0]);
    many.high = 65536;
    EXPECT_THROW(pass_for_whole_numbers(many), Error::Input);
}

TEST(Passes, AreNamedOnTheCommandLineAndSayWhatTheyNeed)
{
    EXPECT_EQ(passes_from_text("kr,depth,kr"), (std::vector<Pass>{Pass::kr, Pass::depth}));
    EXPECT_EQ(passes_from_text("all").size(), 10u);
    EXPECT_TRUE(passes_from_text("").empty());
    EXPECT_THROW(passes_from_text("kr,cheese"), Error::Input);
    EXPECT_EQ(pass_need(std::vector{Pass::depth}), Need::normals);
    EXPECT_EQ(pass_need(std::vector{Pass::depth, Pass::kr}), Need::curvature);
    EXPECT_EQ(pass_need(std::vector{Pass::dwkr}), Need::derivative);
    Seen bare("sphere", 1000);
    bare.model.derivative.clear();
    EXPECT_THROW(bare.pass(Pass::dwkr), Error::Input);
}

TEST(RenderOptions, TableSetsEveryFieldAndTakesItsOwnTextBack)
{
    RenderOptions options;
    const auto set = [&](std::string_view name, std::string_view text) {
        for (const auto& row : render_option_table())
            if (row.name == name)
                row.set(options, text);
    };
    set("light", "1,-2,3.5");
    set("background", "#ff8000");
    set("shading", "toon");
    set("bits", "16");
    EXPECT_EQ(*options.light, dvec3(1, -2, 3.5));
    EXPECT_NEAR(options.background.g, 128 / 255.0, 1e-6);
    EXPECT_EQ(options.shading, Shading::toon);
    EXPECT_EQ(options.bits, 16);
    for (const auto& row : render_option_table()) {
        RenderOptions again;
        EXPECT_NO_THROW(row.set(again, row.get(options))) << row.name;
        EXPECT_EQ(row.get(again), row.get(options)) << row.name;
    }
    for (const char* bad : {"1,2", "1,2,3,4", "a,b,c", "1,,2", ""})
        EXPECT_THROW(set("light", bad), Error::Input) << bad;
    EXPECT_THROW(set("background", "red"), Error::Input);
}

} // namespace
} // namespace limn
