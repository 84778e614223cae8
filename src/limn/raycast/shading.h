#pragma once

#include <optional>
#include <vector>

#include "limn/base/image.h"
#include "limn/raycast/ground.h"
#include "limn/raycast/light.h"
#include "limn/raycast/material.h"

namespace limn {

class Occlusion;

enum class Shading : std::uint8_t {
    smooth,  ///< diffuse, from the interpolated normals
    flat,    ///< diffuse, from the normals of the triangles
    toon,    ///< few even tones, from the interpolated normals
    gouraud, ///< diffuse at vertices, from their normals, and interpolated; flat where they have none
    normals, ///< no light: normals as colours, x, y and z of -1 to 1 as red, green and blue; a ground is lit as ever
};

/// How a picture is shaded. Tones are mixed as encoded colours, as pens and printers do.
struct ShadeOptions {
    Shading shading = Shading::smooth;
    std::optional<dvec3> to_light; ///< world direction towards a distant light, any length; absent: a headlight at the eye
    std::optional<dvec3> lamp;     ///< world position of a point light, instead of either
    std::optional<WideLight> wide; ///< a light with a size, instead of any of them (raycast/lighting.h); gouraud is as smooth under it
    std::shared_ptr<const Occlusion> occlusion; ///< what hides light, in the frame of the scene; null: nothing does
    std::optional<double> open_radius; ///< places darken by what is so near to them, world units; infinity: however far
    int light_samples = 64;        ///< places of a light with a size, and directions of openness, that a pixel looks at, 1..65536
    dvec3 up = dvec3(0, 1, 0);     ///< of the world, unit: one side of a light that is a rectangle is level, and environments stand upright
    int toon_levels = 2;           ///< tones of toon shading, 2..16
    float toon_limit = 0.3f;       ///< diffuse value below which toon shading is dark, in (0,1)
    vec3 dark = vec3(0.25f);       ///< encoded (sRGB) colour of unlit places
    vec3 light = vec3(1);          ///< of fully lit ones
    std::vector<Material> materials; ///< one for each part of the scene (SeenScene::part_of), instead of `dark` and `light`; empty: all are alike
    vec3 background = vec3(1);
    std::optional<Ground> ground;  ///< lit as the objects are
    int samples = 16;              ///< rays of a pixel on an edge, 1..256
};

/// The shaded picture, RGB, of the camera's size. Anti-aliased with a box filter: one ray at each pixel's centre, and
/// `samples` rays where one of the eight pixels around has another colour; what is narrower than a pixel may be missed where it
/// hits no centre. Multi-threaded; same bytes for any number of threads.
/// Where light has a size or openness darkens, a pixel on an edge shares the samples of the light among its rays.
/// @throws Error::Input for a number out of range, a light without direction or size, several kinds of light at once, and materials for
///         another number of parts than the scene has.
Image shade(const SeenScene& scene, const Camera& camera, const ShadeOptions& options = {});

/// @param parts  of the scene
/// @throws Error::Input as shade().
void check(const ShadeOptions& options, std::size_t parts);

/// Diffuse value of a fragment in [0,1]: Lambert's law for the side that is seen.
/// @param to_light  unit; zero for a headlight
float diffuse_value(const Fragment& fragment, const vec3& normal, const vec3& to_light);

} // namespace limn
