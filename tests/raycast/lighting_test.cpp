#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/random.h"
#include "limn/base/srgb.h"
#include "limn/raycast/lighting.h"
#include "raycast/scene.h"

namespace limn {
namespace {

constexpr double pi = std::numbers::pi;

/// The mean over a light's directions of a number that depends on them, by cutting it into small pieces.
template <class F> double mean_over_rectangle(const RectangleShape& r, const vec3& from, F&& f)
{
    constexpr int pieces = 600;
    const vec3 normal = glm::normalize(glm::cross(r.side, r.other));
    double sum = 0, angle = 0;
    for (int y = 0; y < pieces; ++y)
        for (int x = 0; x < pieces; ++x) {
            const vec3 way = r.corner + (float(x) + 0.5f) / pieces * r.side + (float(y) + 0.5f) / pieces * r.other - from;
            const float far = glm::length(way);
            const double part = double(std::abs(glm::dot(normal, way / far)) / (far * far));
            angle += part, sum += part * f(way / far);
        }
    return sum / angle;
}

template <class F> double mean_over_view(const LightShape& shape, const vec3& from, F&& f)
{
    const LightView view(shape, from);
    const PixelSequence sequence({0, 0}, 1);
    constexpr int count = 1 << 16;
    double sum = 0;
    for (std::uint32_t i = 0; i < count; ++i)
        sum += f(glm::normalize(view.place(sequence.place(i)) - from));
    return sum / count;
}

TEST(LightView, IsEvenOverTheDirectionsOfARectangle)
{
    const RectangleShape rectangle = shape_of(RectangleLight{{1, 3, 0.5}, {2, 1}, dvec3(0.2, 0, 0)}, dvec3(0), 1, {0, 1, 0});
    EXPECT_NEAR(glm::dot(rectangle.side, rectangle.other), 0, 1e-6);
    EXPECT_NEAR(rectangle.side.y, 0, 1e-6) << "its width is level";
    EXPECT_NEAR(glm::length(rectangle.side), 2, 1e-6);
    for (const vec3& from : {vec3(0, 0, 0), vec3(0.8f, 2.7f, 0.2f), vec3(-20, 5, 3), vec3(1.1f, 3.5f, 0.6f)}) {
        const auto f = [](const vec3& d) { return double(d.x + 2 * d.y * d.y - d.z * d.x); };
        EXPECT_NEAR(mean_over_view(rectangle, from, f), mean_over_rectangle(rectangle, from, f), 2e-3);
        const LightView view(rectangle, from);
        Random random(1);
        for (int i = 0; i < 1000; ++i) { // on the rectangle
            const vec3 off = view.place({float(random.uniform()), float(random.uniform())}) - rectangle.corner;
            EXPECT_NEAR(glm::dot(off, glm::cross(rectangle.side, rectangle.other)), 0, 1e-4);
            EXPECT_GT(glm::dot(off, rectangle.side), -1e-4);
            EXPECT_LT(glm::dot(off, rectangle.side), 4 + 1e-4);
        }
    }
    EXPECT_THROW(shape_of(RectangleLight{{0, 0, 0}, {0, 1}, {}}, dvec3(0), 1, {0, 1, 0}), Error::Input);
}

TEST(LightView, IsEvenOverTheDirectionsOfABall)
{
    const BallShape ball = shape_of(SphereLight{{2, 4, 6}, 2}, dvec3(2, 0, 0), 2);
    EXPECT_EQ(ball.centre, vec3(0, 2, 3));
    EXPECT_EQ(ball.radius, 1);
    for (const vec3& from : {vec3(0, 0, 0), vec3(0, 0.9f, 3), vec3(30, -10, 4)}) {
        const vec3 axis = glm::normalize(ball.centre - from);
        const double sine = 1 / double(glm::distance(ball.centre, from)), cosine = std::sqrt(1 - sine * sine);
        EXPECT_NEAR(mean_over_view(ball, from, [&](const vec3& d) { return double(glm::dot(d, axis)); }), 0.5 * (1 + cosine), 1e-4);
        const LightView view(ball, from);
        Random random(2);
        for (int i = 0; i < 1000; ++i)
            EXPECT_NEAR(glm::distance(view.place({float(random.uniform()), float(random.uniform())}), ball.centre), 1, 2e-3) << "on the near side of it";
    }
    EXPECT_NEAR(mean_over_view(ball, {0.3f, 2, 3}, [](const vec3& d) { return double(d.x * d.x); }), 1.0 / 3, 0.1) << "from within, all around";
    EXPECT_THROW(shape_of(SphereLight{{0, 0, 0}, 0}, dvec3(0), 1), Error::Input);
}

TEST(Occlusion, MayBeBetweenWhereALineIs)
{
    Random random(6);
    int may = 0, is = 0;
    const auto some = [&](double size) { return vec3(dvec3(random.normal(), random.normal(), random.normal()) * size); };
    for (int i = 0; i < 20000; ++i) {
        const vec3 from = some(2);
        const Ball light = {some(3), float(random.uniform(0.01, 1))}, object = {some(1), float(random.uniform(0.1, 1.5))};
        bool meets = false;
        for (int k = 0; k < 30; ++k) {
            const vec3 q = light.centre + light.radius * glm::normalize(some(1)), way = q - from;
            const float along = glm::clamp(glm::dot(object.centre - from, way) / glm::dot(way, way), 0.0f, 1.0f);
            meets = meets || glm::distance(from + along * way, object.centre) < object.radius;
        }
        const bool answer = may_be_between(from, light, object);
        EXPECT_TRUE(answer || !meets) << i;
        may += answer, is += meets;
    }
    EXPECT_GT(is, 2000);
    EXPECT_LT(may, 1.3 * is) << "and seldom elsewhere";
    EXPECT_TRUE(may_be_between({0, 0, 0}, {{3, 0, 0}, 1}, {}));
}

/// A sun of 8 pixels in a dim sky over dark ground.
Image sky()
{
    Image image({64, 32}, 3, 0.02f);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 64; ++x)
            image.at(x, y)[0] = 0.3f, image.at(x, y)[1] = 0.4f, image.at(x, y)[2] = 0.6f;
    for (int y = 6; y < 8; ++y)
        for (int x = 40; x < 44; ++x)
            image.at(x, y)[0] = 60, image.at(x, y)[1] = 50, image.at(x, y)[2] = 40;
    return image;
}

TEST(Environment, IsDrawnAsOftenAsItIsBright)
{
    const EnvironmentMap map(sky());
    Random random(4);
    constexpr int count = 200000;
    dvec3 light(0);
    int sun = 0;
    for (int i = 0; i < count; ++i) {
        const EnvironmentMap::Drawn drawn = map.draw({float(random.uniform()), float(random.uniform())});
        ASSERT_NEAR(glm::length(drawn.direction), 1, 1e-5);
        ASSERT_NEAR(drawn.density, luminance(drawn.light) * map.density_of_luminance(), 1e-5 * drawn.density);
        if (i % 16 == 0) { // rounding at a pixel's border aside
            ASSERT_LT(glm::distance(map.light(drawn.direction), drawn.light), drawn.light.x > 1 || map.light(drawn.direction).x > 1 ? 100 : 1);
        }
        light += dvec3(drawn.light) / double(drawn.density);
        sun += drawn.light.x > 1;
    }
    const double step = 2 * pi / 64, suns = 4 * step * (std::cos(6 * pi / 32) - std::cos(8 * pi / 32));
    const double blue = 0.6 * (2 * pi - suns) + 40 * suns + 0.02 * 2 * pi;
    EXPECT_NEAR(light.z / count, blue, 0.01 * blue);
    const double brightness = double(luminance(vec3(60, 50, 40))) * suns, all = brightness + double(luminance(vec3(0.3f, 0.4f, 0.6f))) * (2 * pi - suns) + 0.02 * 2 * pi;
    EXPECT_NEAR(double(sun) / count, brightness / all, 0.01);
    EXPECT_NEAR(EnvironmentMap(Image({16, 8}, 3, 0.5f)).most_received(), 0.5 * pi, 0.02 * pi);
    EXPECT_THROW(EnvironmentMap(Image({16, 8}, 3)), Error::Input);
    EXPECT_THROW(EnvironmentMap(Image({16, 8}, 1, 1)), Error::Input);
}

/// The middle of a picture is in front, where cameras of azimuth 0 stand, and what is right of it is on the right of who looks there.
TEST(Environment, StandsUprightInTheWorld)
{
    Image picture({8, 4}, 3);
    for (int c = 0; c < 3; ++c)
        picture.at(4, 1)[c] = 1, picture.at(6, 1)[c] = 2, picture.at(0, 0)[c] = 3;
    const EnvironmentMap map(picture);
    const auto at = [&](const vec3& up, const vec3& d) { return map.light(environment_axes(up) * glm::normalize(d)).x; };
    EXPECT_EQ(at({0, 1, 0}, {-0.2f, 0.3f, 1}), 1);
    EXPECT_EQ(at({0, 1, 0}, {-1, 0.3f, -0.2f}), 2) << "who looks along z has x on the left";
    EXPECT_EQ(at({0, 0, 1}, {-0.2f, -1, 0.3f}), 1);
    EXPECT_EQ(at({0, 0, 1}, {-1, 0.2f, 0.3f}), 2) << "who looks along -y has x on the left, too";
    EXPECT_EQ(at({0, 0, 1}, {0.1f, 0.2f, 3}), 3);
}

/// Reflection is a density: a lobe gives back what its parts say, however it is sampled.
TEST(Lobe, GivesBackItsPartsOfEvenLight)
{
    const EnvironmentMap map(Image({32, 16}, 3, 1.0f));
    const Look open = [](std::span<const LightPlace> to, std::uint8_t* lit) { std::fill_n(lit, to.size(), std::uint8_t(1)); };
    const vec3 normal(0, 1, 0);
    for (const Lobe& lobe : {Lobe{1, 0, 1}, Lobe{0, 1, 200}, Lobe{0.4f, 0.5f, 60}})
        for (const LightStrategy strategy : {LightStrategy::light, LightStrategy::surface, LightStrategy::both}) {
            const vec3 light = reflected_light(map, glm::mat3(1), {normal, normal, lobe}, strategy, PixelSequence({0, 0}, 1), {0, 1 << 17}, open);
            EXPECT_NEAR(light.x, lobe.diffuse + lobe.specular, 0.02) << int(strategy); // the lobe's cosine is a little below 1
        }
}

/// Something between a place and its sky, in coarse steps, as maps have it.
bool is_open(const vec3& d) { return (int(std::floor(8 * d.x)) + int(std::floor(8 * d.y)) + int(std::floor(8 * d.z))) % 3 != 0; }

/// Checklist 28: no bias, and both ways together are not worse than the better one of them.
TEST(ReflectedLight, HasNoBiasAndIsBestByBothWays)
{
    const EnvironmentMap sun(sky()), even(Image({64, 32}, 3, 0.5f));
    const Look look = [](std::span<const LightPlace> to, std::uint8_t* lit) {
        for (std::size_t k = 0; k < to.size(); ++k)
            lit[k] = is_open(vec3(to[k].place));
    };
    const vec3 normal = glm::normalize(vec3(0.3f, 1, 0.2f)), to_eye = glm::normalize(vec3(-0.5f, 1, 0.4f));
    for (const EnvironmentMap* map : {&sun, &even})
        for (const Lobe& lobe : {Lobe{0.8f, 0, 1}, Lobe{0.3f, 0.6f, 40}, Lobe{0.05f, 0.9f, 300}}) {
            double reference = 0; // over all directions in small cells
            constexpr int rows = 1200, columns = 2400;
            for (int y = 0; y < rows; ++y)
                for (int x = 0; x < columns; ++x) {
                    const double height = 1 - 2 * (y + 0.5) / rows, turn = 2 * pi * (x + 0.5) / columns, sine = std::sqrt(1 - height * height);
                    const vec3 d(dvec3(sine * std::cos(turn), height, sine * std::sin(turn)));
                    if (is_open(d) && glm::dot(d, normal) > 0)
                        reference += double(map->light(d).y * lobe.reflectance(normal, to_eye, d) * glm::dot(d, normal));
                }
            reference *= 4 * pi / (double(rows) * columns);
            double deviation[3];
            for (const LightStrategy strategy : {LightStrategy::light, LightStrategy::surface, LightStrategy::both}) {
                constexpr int runs = 1000;
                double sum = 0, square = 0;
                for (int run = 0; run < runs; ++run) {
                    const ivec2 somewhere((run * 97) % 251, (run * 57) % 241);
                    const double light = double(reflected_light(*map, glm::mat3(1), {normal, to_eye, lobe}, strategy, PixelSequence(somewhere, 16), {0, 16}, look).y);
                    sum += light, square += (light - reference) * (light - reference);
                }
                deviation[int(strategy)] = std::sqrt(square / runs);
                EXPECT_NEAR(sum / runs, reference, 3 * deviation[int(strategy)] / std::sqrt(double(runs)) + 2e-3 * reference) << int(strategy);
            }
            fmt::print("{} lobe {}+{} ^{}: reference {:.4f}, deviations of 16 samples: light {:.4f}, surface {:.4f}, both {:.4f}\n", map == &sun ? "sun" : "even", lobe.diffuse, lobe.specular,
                       lobe.exponent, reference, deviation[0], deviation[1], deviation[2]);
            EXPECT_LE(deviation[2], 1.1 * std::min(deviation[0], deviation[1]) + 1e-4 * reference);
        }
}

struct Squares : test::ShapeScene {
    void add_square(const vec3& corner, const vec3& u, const vec3& v)
    {
        positions.push_back({corner, corner + u, corner + u + v, corner + v, vec3(0)});
        triangles.push_back({{0, 1, 2}, {0, 2, 3}});
        normals.emplace_back();
    }
};

/// A floor at z = 0 and a square screen above it.
struct ScreenScene : Squares {
    ScreenScene()
    {
        add_square({-4, -4, 0}, {8, 0, 0}, {0, 8, 0});
        add_square({-4, 0, 1}, {4, 0, 0}, {0, 4, 0}); // hides what is at x < 0, y > 0 of light straight from above
        finish();
    }
};

Camera from_above(int size)
{
    Camera camera;
    camera.orthographic = true;
    camera.eye = {1, -2, 0.9}; // under the screen
    camera.look = {1, -2, 0};
    camera.up = {0, 1, 0};
    camera.ortho_height = 3;
    camera.size = {size, size};
    return camera;
}

ShadeOptions shadowed(const SeenScene& scene)
{
    ShadeOptions options;
    options.dark = vec3(0.2f);
    options.light = vec3(0.8f);
    options.up = {0, 0, 1};
    options.occlusion = std::make_shared<RayOcclusion>(*scene.rays);
    return options;
}

TEST(Lighting, UnlitPlacesHaveTheDarkTone)
{
    ScreenScene scene;
    ShadeOptions options = shadowed(scene.seen);
    Camera camera = from_above(24);
    camera.eye = {-2, 2, 0.9}, camera.look = {-2, 2, 0};
    camera.ortho_height = 1;
    const auto all_are = [&](float wanted) {
        const Image image = shade(scene.seen, camera, options);
        for (const float sample : image.samples)
            ASSERT_NEAR(sample, wanted, 2e-6);
    };
    options.to_light = dvec3(0, 0, 1);
    all_are(0.2f);
    options.to_light.reset(), options.lamp = dvec3(-2, 2, 30);
    all_are(0.2f);
    options.lamp.reset(), options.wide = SphereLight{{-2, 2, 5}, 0.1};
    all_are(0.2f);
    options.wide = RectangleLight{{-2, 2, 5}, {0.1, 0.1}, {}};
    all_are(0.2f);
    options.occlusion.reset(), options.wide = SphereLight{{-2, 2, 1e4}, 0.1};
    all_are(0.8f); // nothing hides the light
    options.wide.reset();
    all_are(0.8f); // a headlight
    options.open_radius = 0.5;
    all_are(0.8f); // the screen is farther
    options.open_radius = 1e9;
    options.occlusion = std::make_shared<RayOcclusion>(*scene.seen.rays);
    const Image closed = shade(scene.seen, camera, options);
    EXPECT_LT(*closed.at(12, 12), 0.5f);
}

/// Half in the shadow is halfway in light, not in the numbers of the file.
TEST(Lighting, AddsUpAsLight)
{
    ScreenScene scene;
    ShadeOptions options = shadowed(scene.seen);
    options.light_samples = 4096;
    options.wide = RectangleLight{{0, 2, 101}, {1, 1}, dvec3(0, 2, 0)};
    Camera camera = from_above(1);
    camera.eye = {0, 2, 0.9}, camera.look = {0, 2, 0}, camera.ortho_height = 1e-4;
    const float half_lit = srgb_from_linear(0.5f * (linear_from_srgb(0.2f) + linear_from_srgb(0.8f)));
    EXPECT_NEAR(*shade(scene.seen, camera, options).at(0, 0), half_lit, 2e-3);
    EXPECT_GT(half_lit, 0.55f);
}

/// The penumbra of a square light behind an edge is as wide as similar triangles say, and even.
TEST(Lighting, HasThePenumbraOfSimilarTriangles)
{
    ScreenScene scene;
    ShadeOptions options = shadowed(scene.seen);
    options.dark = vec3(0), options.light = vec3(1);
    options.light_samples = 1024;
    options.wide = RectangleLight{{0, 2, 11}, {2, 2}, dvec3(0, 2, 0)}; // 10 above the edge, which is 1 above the floor
    Camera camera = from_above(60);
    camera.eye = {0, 2, 0.9}, camera.look = {0, 2, 0}, camera.ortho_height = 0.4, camera.size = {30, 30};
    const Image image = shade(scene.seen, camera, options);
    for (int x = 0; x < 30; ++x) {
        const double place = 0.4 * ((x + 0.5) / 30 - 0.5), wanted = std::clamp(0.5 + place / 0.2, 0.0, 1.0);
        EXPECT_NEAR(double(linear_from_srgb(*image.at(x, 15))), wanted, 0.04) << place;
    }
}

TEST(Lighting, IsAsOpenAsTheSkyThatIsSeen)
{
    Squares corner; // of two walls, each as long as matters
    corner.add_square({-1e3, -1e3, 0}, {2e3, 0, 0}, {0, 2e3, 0});
    corner.add_square({0, -1e3, 0}, {0, 2e3, 0}, {0, 0, 1e3});
    corner.finish();
    ShadeOptions options;
    options.dark = options.light = vec3(1);
    options.light_samples = 4096;
    Camera camera = from_above(1);
    camera.ortho_height = 1e-5;
    const auto openness_at = [&](double x) {
        camera.eye = {x, 0, 5}, camera.look = {x, 0, 0};
        return double(linear_from_srgb(*shade(corner.seen, camera, options).at(0, 0)));
    };
    options.open_radius = std::numeric_limits<double>::infinity();
    EXPECT_NEAR(openness_at(-0.02), 0.5, 0.01) << "half the sky";
    options.open_radius = 1;
    EXPECT_NEAR(openness_at(-2), 1, 1e-6) << "the wall is too far";
    const double near = openness_at(-0.1), farther = openness_at(-0.5);
    EXPECT_GT(near, 0.5);
    EXPECT_GT(farther, near + 0.05);
    options.open_radius = -1;
    EXPECT_THROW(openness_at(-1), Error::Input);
}

/// A ground hides what is under it.
TEST(Lighting, ComesNotThroughTheGround)
{
    ScreenScene scene;
    ShadeOptions options = shadowed(scene.seen);
    options.to_light = dvec3(0, 0, -1);
    Camera camera = from_above(4);
    camera.eye = {1, -2, -5}, camera.look = {1, -2, 0}; // the floor from below
    EXPECT_FLOAT_EQ(*shade(scene.seen, camera, options).at(1, 1), 0.8f);
    options.ground = Ground{{0, 0, -1}, {0, 0, 1}, 4, {}};
    EXPECT_FLOAT_EQ(*shade(scene.seen, camera, options).at(1, 1), 0.2f);
}

/// Checklist 23: the error falls with the samples.
TEST(Lighting, IsTheNearerToTheTruthTheMoreSamplesItTakes)
{
    test::ShapeScene scene;
    scene.add(test::shape("knot", 8000));
    ShadeOptions options = shadowed(scene.finish());
    options.samples = 1;
    options.up = {0, 1, 0};
    const Camera camera = Camera::framing({dvec3(-1.5), dvec3(1.5)}, {.view = "iso", .size = {40, 40}});
    for (const WideLight& light : {WideLight(SphereLight{{3, 4, 2}, 1.5}), WideLight(RectangleLight{{-2, 3, 3}, {2, 3}, {}}),
                                   WideLight(EnvironmentLight{std::make_shared<const EnvironmentMap>(sky())})}) {
        options.wide = light;
        const auto picture = [&](int count) {
            options.light_samples = count;
            return shade(scene.seen, camera, options);
        };
        const Image truth = picture(2048);
        std::vector<double> errors;
        for (const int count : {4, 16, 64, 128}) {
            const Image image = picture(count);
            double sum = 0;
            for (std::size_t i = 0; i < image.samples.size(); ++i)
                sum += std::pow(double(image.samples[i] - truth.samples[i]), 2);
            errors.push_back(std::sqrt(sum / double(image.samples.size())));
        }
        const double exponent = std::log(errors[3] / errors[0]) / std::log(32.0);
        fmt::print("light {}: errors of 4, 16, 64, 128 samples {:.4f} {:.4f} {:.4f} {:.4f}: exponent {:.2f}\n", light.index(), errors[0], errors[1], errors[2], errors[3], exponent);
        EXPECT_LT(exponent, -0.4);
        EXPECT_GT(exponent, -1.1);
    }
}

TEST(Lighting, RefusesWhatIsNone)
{
    ScreenScene scene;
    const Camera camera = from_above(4);
    const auto refuses = [&](const std::function<void(ShadeOptions&)>& change) {
        ShadeOptions options = shadowed(scene.seen);
        change(options);
        EXPECT_THROW(shade(scene.seen, camera, options), Error::Input);
    };
    refuses([](ShadeOptions& o) { o.wide = SphereLight{{0, 0, 0}, -1}; });
    refuses([](ShadeOptions& o) { o.wide = SphereLight(), o.lamp = dvec3(1); });
    refuses([](ShadeOptions& o) { o.light_samples = 0; });
    refuses([](ShadeOptions& o) { o.open_radius = 0; });
}

} // namespace
} // namespace limn
