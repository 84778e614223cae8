// Visibility of suggestive contours and other lines inside faces against the exact shapes: section 5 of the line-visibility specification, and checklist item
// 28 of the contour-lines specification.

#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/lines/draw.h"
#include "limn/surface/estimate.h"
#include "limn/surface/shape_truth.h"
#include "lines/analytic.h"
#include "lines/cameras.h"

namespace limn {
namespace {

using namespace test;

/// Whether the eye sees the point of the exact surface closest to a drawn one; nothing where an outline passes closer than
/// the mesh can place it.
std::optional<bool> sees(const ShapeTruth& truth, const Camera& camera, const dvec3& drawn, double h)
{
    const SurfacePoint p = truth.project(drawn);
    const dvec3 v = camera.to_eye(p.position);
    const auto free = [&](const dvec3& from) {
        return !truth.first_inside(from, glm::normalize(v), 1e-3, camera.orthographic ? 20 : glm::length(v));
    };
    const double close = std::max(h * h / 4, 3e-4);
    const dvec3 across = glm::normalize(glm::cross(p.normal, v)), up = glm::cross(across, glm::normalize(v));
    // Just above the surface, so that it does not hide itself; then a little to each side in the picture.
    const dvec3 at = p.position + 1e-4 * p.normal;
    const bool seen = glm::dot(p.normal, v) > 0 && free(at);
    for (const dvec3& d : {across, -across, up, -up})
        if (const SurfacePoint q = truth.project(at + close * d); (glm::dot(q.normal, v) > 0 && free(q.position + 1e-4 * q.normal)) != seen)
            return std::nullopt;
    return seen;
}

struct Score {
    double length = 0, leak = 0, lost = 0, undecided = 0; ///< in space
};

Score score_of(LineType type, const std::string& name, std::size_t triangles, int views)
{
    Shape shape = make_shape({.name = name, .triangles = triangles, .jitter = 0.2, .float_positions = false});
    shape.exact = estimate_surface(shape.mesh);
    const LineModel model = model_of(shape);
    const RayScene rays = build_ray_scene(model);
    const ShapeTruth truth(name);
    LineOptions options;
    options.lines = {type};
    options.hidden = Hidden::keep;
    const LineFeatures features = find_line_features(model, options);
    const double h = std::sqrt(4 * std::numbers::pi / double(triangles));
    Score score;
    for (int k = 0; k < views; ++k) {
        const Camera camera = random_camera(shape.mesh.bounds(), 500 + std::uint64_t(k), k % 3 == 2);
        for (const Stroke& s : draw_lines(model, rays, features, camera, options).strokes)
            for (std::size_t i = 1; i < s.world.size(); ++i) {
                // Simplified pieces can be long: several samples on each.
                const double length = glm::distance(s.world[i], s.world[i - 1]);
                const int samples = std::max(1, int(std::ceil(length / h)));
                for (int j = 0; j < samples; ++j) {
                    const std::optional<bool> seen = sees(truth, camera, glm::mix(s.world[i - 1], s.world[i], (j + 0.5) / samples), h);
                    (seen ? score.length : score.undecided) += length / samples;
                    score.leak += seen == false && s.visible ? length / samples : 0;
                    score.lost += seen == true && !s.visible ? length / samples : 0;
                }
            }
    }
    fmt::print("[   score  ] {} lines of {} {}: leak {:.3f} %, lost {:.3f} %, undecided {:.2f} %\n", line_type_name(type), name, triangles, 100 * score.leak / score.length,
               100 * score.lost / score.length, 100 * score.undecided / (score.length + score.undecided));
    return score;
}

void expect_right(LineType type, const std::string& name, std::size_t triangles, int views)
{
    const Score score = score_of(type, name, triangles, views);
    ASSERT_GT(score.length, 1);
    EXPECT_LE(score.leak + score.lost, 0.005 * score.length) << name;
    EXPECT_LE(score.undecided, 0.1 * score.length) << name;
}

TEST(SuggestiveVisibility, IsRightOnTheBumpyTorus) { expect_right(LineType::suggestive, "bumpy-torus", 50000, 6); }

TEST(SuggestiveVisibility, IsRightOnTheBlob) { expect_right(LineType::suggestive, "blob", 50000, 6); }

TEST(SurfaceLineVisibility, OfEveryOtherLineInsideFacesIsRight)
{
    for (const LineType type : {LineType::highlight, LineType::ridge, LineType::valley, LineType::apparent})
        expect_right(type, "blob", 50000, 3);
}

TEST(SurfaceLineVisibility, IsRightOnLargeMeshesSlow)
{
    for (const LineType type : {LineType::suggestive, LineType::highlight, LineType::ridge, LineType::valley, LineType::apparent})
        expect_right(type, "blob", 500000, 10);
    expect_right(LineType::suggestive, "bumpy-torus", 500000, 20);
}

} // namespace
} // namespace limn
