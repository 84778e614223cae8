#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limn/base/options.h"
#include "limn/base/vec.h"

namespace limn {

/// What is computed on the surface.
enum class PatternKind : std::uint8_t { plain, layers, bricks, thread };

enum class LayerModel : std::uint8_t {
    bead,  ///< steps as the slope has them, with rounded edges
    slope, ///< the same with flat edges
    seed,  ///< the share of treads is that of the line of sight, as the seed's study has it
    soft,  ///< the same with its smoothstep
    voxel, ///< the same along two axes: blocks
};

/// How a pixel sees what is finer than it.
enum class PatternFilter : std::uint8_t {
    gauss, ///< in closed form, through a Gauss kernel
    box,   ///< in closed form, through a square
    even,  ///< by samples spread evenly under the Gauss kernel
    seed,  ///< by the seed's samples
    off,   ///< what is at its centre
};

enum class PatternReflection : std::uint8_t { filament, phong, blinn_phong, matte };

/// What a picture of a print shows.
enum class PrintShow : std::uint8_t {
    print, ///< the print
    cusp,  ///< how far its steps stand out of the model, as colours
};

/// A pattern with everything that it can be told. Colours are encoded (sRGB) RGB in [0,1]; lengths of prints are millimetres, those of bricks parts of
/// the scene's longest side, those of thread parts of the way around.
struct PatternOptions {
    PatternKind kind = PatternKind::plain;

    double layer_height = 0.2;
    double first_layer = 0;            ///< 0: as the others
    std::vector<double> layer_heights; ///< of all layers from the lowest, instead of both; empty: none
    std::optional<dvec3> direction;    ///< layers follow each other along it, any length above 0; absent: up
    LayerModel layer_model = LayerModel::bead;
    double bulge = 0.5; ///< of beads: how far they stand out, by half their height
    double soft_low = 0, soft_high = 0.2;
    double variety = 0.06; ///< how much layers and bricks differ in colour
    PrintShow show = PrintShow::print;
    double overhang = 0; ///< degrees from upright from which overhangs are marked; 0: none are
    char units = 'a';    ///< of the models: 'a' as their format has them, 'm' mm, 'c' cm, 'M' metres, 'i' inches

    std::string filament = "pla-grey";
    std::optional<vec3> colour; ///< instead of the filament's
    PatternReflection reflection = PatternReflection::filament;
    double specular = 0.1, exponent = 100; ///< of both Phong models

    double brick_width = 0.1, brick_height = 0.032, brick_depth = 0.038, mortar = 0.004, brick_relief = 0.0012;
    vec3 brick_colour = vec3(0.66f, 0.32f, 0.22f), mortar_colour = vec3(0.75f, 0.73f, 0.7f);
    bool brick_solid = true; ///< carved out of a block; else a wall in x and y, seen through
    bool brick_bond = true;  ///< of solid ones: every other row is shifted on all sides; else in x alone, as the study has it

    double hole = 0.012, thread = 0.008;
    vec3 thread_colour = vec3(0.25f, 0.42f, 0.65f);
    double thread_specular = 0.3, thread_exponent = 20;
    bool woven = true;
    bool mirror_cone = true; ///< highlights about the mirror cone of the light; else as the seed prints it

    PatternFilter filter = PatternFilter::gauss;
    double filter_width = 0.5; ///< standard deviation, pixels
    int filter_box = 2;        ///< side of the square and of the seed's samples, pixels
    int pattern_samples = 50;
    int sample_seed = 1;                      ///< of the seed's generator
    bool with_object = false;                 ///< the pattern moves with its object; else it stays in the world
    glm::dvec4 turn = glm::dvec4(0, 0, 0, 1); ///< quaternion x, y, z, w that turns the pattern; any length above 0
};

/// The options above as data, without the table of layer heights, which is a file.
const OptionTable<PatternOptions>& pattern_option_table();

} // namespace limn
