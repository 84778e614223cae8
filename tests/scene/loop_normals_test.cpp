// Normals of control meshes from a map in memory, and what they and the cut outline are worth in pictures.

#include "limn/scene/loop_normals.h"

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/lines/draw.h"
#include "limn/lines/regions.h"
#include "limn/raycast/gbuffer.h"
#include "limn/raycast/shading.h"
#include "limn/scene/loop_model.h"
#include "limn/subdivision/control_samples.h"

namespace limn {
namespace {

using Silhouette = SubdivisionOptions::Silhouette;
using Normals = SubdivisionOptions::Normals;

std::shared_ptr<const LoopModel> model(const std::string& sample, Silhouette silhouette, Normals normals, int map_size = 1024)
{
    SubdivisionOptions options;
    options.scheme = SubdivisionOptions::Scheme::loop;
    options.silhouette = silhouette;
    options.normals = normals;
    options.map_size = map_size;
    return std::make_shared<const LoopModel>(make_control_sample(sample), options);
}

Camera camera_of(const std::string& sample, ivec2 size, const std::string& view = "35,25")
{
    return Camera::framing(make_control_sample(sample).bounds(), {.view = view, .up_axis = 'y', .size = size});
}

double degrees_between(const vec3& a, const vec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi; }

/// Between two pictures' normals.
struct Angles {
    double root_mean_square = 0; ///< degrees
    double far = 0;              ///< share above 2 degrees
};

Angles angles_in(const GBuffer& a, const GBuffer& b)
{
    Angles angles;
    double count = 0;
    for (std::size_t i = 0; i < a.normals.size(); ++i)
        if (a.triangles[i] != none) {
            const double angle = degrees_between(a.normals[i], b.normals[i]);
            angles.root_mean_square += angle * angle;
            angles.far += angle > 2;
            ++count;
        }
    angles.root_mean_square = std::sqrt(angles.root_mean_square / count);
    angles.far /= count;
    return angles;
}

TEST(LoopNormals, OfAMapAreThoseOfTheLimit)
{
    for (const char* sample : {"creature", "mug", "leaf"}) {
        const Camera camera = camera_of(sample, {120, 100});
        const auto seen_with = [&](Normals normals, int map_size = 1024) {
            // Two of them, so that the second has normals that are turned.
            const auto shown = model(sample, Silhouette::exact, normals, map_size);
            const PlacedLoop placed[] = {{shown}, {shown, glm::rotate(glm::translate(dmat4(1), dvec3(0.4, 0.5, -0.7)), 1.3, dvec3(1, 2, 3))}};
            return trace_gbuffer(make_loop_view(placed, camera)->seen, camera);
        };
        const GBuffer exact = seen_with(Normals::limit);
        const Angles of_map = angles_in(exact, seen_with(Normals::map)), of_small = angles_in(exact, seen_with(Normals::map, 256)),
                     of_vertices = angles_in(exact, seen_with(Normals::vertex));
        fmt::print("[ angles   ] {}: map {:.3f} degrees ({:.2f} % above 2), of 256 texels {:.3f}, vertices {:.3f} ({:.2f} %)\n", sample, of_map.root_mean_square,
                   100 * of_map.far, of_small.root_mean_square, of_vertices.root_mean_square, 100 * of_vertices.far);
        EXPECT_LT(of_map.root_mean_square, 0.5 * of_small.root_mean_square) << sample;
        EXPECT_LT(of_small.root_mean_square, 0.5 * of_vertices.root_mean_square) << sample;
        EXPECT_LT(of_map.far, 0.01) << sample; // where an edge of the mug is rounded within a texel
    }
}

/// Of all samples of two pictures, in decibels.
double psnr(const Image& a, const Image& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.samples.size(); ++i)
        sum += std::pow(double(a.samples[i]) - double(b.samples[i]), 2);
    return -10 * std::log10(sum / double(a.samples.size()));
}

/// A fine mesh on the limit surface with the limit's normals at its vertices.
Image reference_picture(const LoopModel& of, const Camera& camera, const ShadeOptions& options, int levels)
{
    const PreparedMesh fine = of.fine_mesh(levels, Need::normals);
    const PlacedSurface placed = fine.placed(dmat4(1));
    const LineModel lines = build_line_model({&placed, 1});
    const RayScene rays = build_ray_scene(lines);
    return shade(seen_scene(lines, rays), camera, options);
}

// Checklist 33 of the silhouette-loop specification (figure 7.22 of the thesis).
TEST(LoopNormals, EachStepTowardsTheLimitIsSeenInThePicture)
{
    struct Way {
        const char* name;
        Silhouette silhouette;
        Normals normals;
    };
    const Way ways[] = {{"coarse", Silhouette::off, Normals::vertex}, {"map", Silhouette::off, Normals::map}, {"cut, map", Silhouette::exact, Normals::map},
                        {"cut, limit", Silhouette::exact, Normals::limit}};
    ShadeOptions options;
    options.to_light = dvec3(2, 3, 4);
    for (const char* sample : {"creature", "bracket"}) {
        const Camera camera = camera_of(sample, {192, 192});
        const Image reference = reference_picture(*model(sample, Silhouette::off, Normals::vertex), camera, options, 5);
        std::array<double, std::size(ways)> quality;
        for (std::size_t i = 0; i < std::size(ways); ++i) {
            const PlacedLoop placed = {model(sample, ways[i].silhouette, ways[i].normals, 512)};
            quality[i] = psnr(shade(make_loop_view({&placed, 1}, camera)->seen, camera, options), reference);
            fmt::print("[ psnr     ] {}, {}: {:.2f} dB\n", sample, ways[i].name, quality[i]);
        }
        EXPECT_GT(quality[1], quality[0] + 0.5) << sample; // outlines count for more than what is inside
        EXPECT_GT(quality[2], quality[1] + 4) << sample;
        EXPECT_GT(quality[3], quality[2]) << sample;
        EXPECT_GT(quality[3], 38) << sample;
    }
}

TEST(LoopNormals, AMapIsMadeWhereOneIsNeededAndFits)
{
    EXPECT_EQ(model("leaf", Silhouette::exact, Normals::vertex)->map(), nullptr);
    const auto limit = model("leaf", Silhouette::exact, Normals::limit, 64);
    ASSERT_NE(limit->map(), nullptr) << "for a GPU";
    EXPECT_EQ(limit->map()->texels.size(), ivec2(64));
    EXPECT_EQ(limit->map()->uvs.size(), 3 * limit->face_count());
    EXPECT_EQ(model("creature", Silhouette::exact, Normals::limit, 64)->map(), nullptr) << "normals are interpolated instead";
    try {
        model("creature", Silhouette::exact, Normals::map, 64);
        ADD_FAILURE() << "hundreds of charts fit into 64 x 64 texels";
    } catch (const Error::Input& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with("--map-size 64: ")) << error.what();
    }
}

TEST(LoopNormals, ObjectsThatShowOneModelShareItsMap)
{
    const auto leaf = model("leaf", Silhouette::off, Normals::map, 64);
    const dmat4 quarter = glm::rotate(glm::scale(dmat4(1), dvec3(3)), std::numbers::pi / 2, dvec3(0, 0, 1));
    const PlacedLoop placed[] = {{leaf}, {leaf, quarter}};
    const auto view = make_loop_view(placed, camera_of("leaf", {16, 16}));
    const MappedNormals mapped = view->mapped_normals();
    ASSERT_EQ(mapped.maps, (std::vector<const Image*>{&leaf->map()->texels}));
    ASSERT_EQ(mapped.parts.size(), 2u);
    EXPECT_LT(glm::distance(mapped.parts[1].rotation * vec3(1, 0, 0), vec3(0, 1, 0)), 1e-6f);
    ASSERT_EQ(mapped.uvs.size(), 3 * view->lines.faces.size());
    // The corners of the uncut mesh have the coordinates of the control mesh.
    EXPECT_EQ(std::vector<vec2>(mapped.uvs.begin(), mapped.uvs.begin() + std::ptrdiff_t(leaf->map()->uvs.size())), leaf->map()->uvs);
}

} // namespace
} // namespace limn
