#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "limn/base/image.h"
#include "limn/base/vec.h"
#include "limn/camera/camera.h"

namespace limn {

/// The kinds of line Limn draws. The order is the drawing order: later kinds lie on top. Iso lines are of heights on a map (heavy: every so
/// many of them); draw_lines() finds all others.
enum class LineType : std::uint8_t { iso, iso_heavy, highlight, valley, ridge, apparent, suggestive, crease, border, mesh_contour, contour, outline };
inline constexpr int line_type_count = 12;

/// The name of a type as on the command line ("mesh-contour").
std::string_view line_type_name(LineType type);
/// @throws Error::Input naming the word and the known ones.
LineType line_type_from_name(std::string_view name);

/// A chain of line after projection: one visible or one hidden run.
struct Stroke {
    LineType type = LineType::contour;
    bool closed = false;              ///< the last point joins the first, which is not repeated
    bool visible = true;              ///< false: hidden, kept for --hidden dash|keep
    std::uint32_t object = 0;         ///< index of the placed model
    std::vector<dvec2> points;        ///< pixels, x right, y down
    std::vector<dvec3> world;         ///< the same points in space
    std::vector<float> ink;           ///< per point in [0,1]: 0 background, 1 full (fading)
    std::vector<std::uint32_t> faces; ///< per point: face of the object it lies on, or `none`
};

/// A filled area under the lines: closed rings, even-odd rule.
struct Region {
    std::string name;                        ///< "silhouette", "toon"
    vec3 colour = vec3(1);                   ///< encoded (sRGB) RGB in [0,1]
    std::vector<std::vector<dvec2>> rings;   ///< pixels
};

/// One line of text, centred over a point of its base line.
struct Caption {
    dvec2 position;  ///< pixels
    double height;   ///< of capital letters, pixels
    std::string text;
    double angle = 0; ///< radians, counter-clockwise on paper, that its base line is turned about the point
};

/// A line drawing: what every writer takes.
struct Drawing {
    Camera camera;
    std::vector<Region> regions; ///< bottom first
    std::vector<Stroke> strokes; ///< sorted by type, then as found
    Image background;            ///< RGB, camera.size, or empty
    std::vector<Caption> captions; ///< of a sheet, and heights of iso lines
    double mm_per_pixel = 0;     ///< true scale on paper (--scale 1:N); 0: the page decides
};

} // namespace limn
