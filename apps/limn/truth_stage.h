#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "limn/scene/render.h"
#include "print_truth.h"

/// A model that is compared with its print, printed along z: as models of layers see it, and by which light.
struct TruthStage {
    limn::Scene scene;
    limn::SceneModel model;
    limn::Camera camera;            ///< from the front, a little to the right and above; the model fills its picture
    std::vector<std::uint8_t> mask; ///< pixels that show the model: 1 for each
    limn::SeenScene seen;
    limn::ShadeOptions shade; ///< a studio's light, and what the model hides of it
    limn::PatternPlace place = {1, {}, limn::dvec3(0, 0, 1)};
    limn::PatternLight light;

    TruthStage(const limn::Mesh& mesh, const limn::ivec2& size);
    TruthStage(const TruthStage&) = delete;
    TruthStage& operator=(const TruthStage&) = delete;
    /// Shows the middle of the picture alone, so many times as large.
    void look_closer(double factor);
    /// Height of layers that are so many pixels on an upright wall in the middle.
    double layer_height(double pixels) const;
    /// The picture that a model of layers makes. Beads are as round as those of a single wall are.
    limn::Image painted(limn::LayerModel model, double layer_height) const;
    /// And rays, of a print.
    TracedPrint traced(const PrintBody& print) const;
    /// "2.31": length over width of the highlight, or "none". @param filled  pixels that the print fills: what is behind it is no highlight
    std::string aspect_text(const limn::Image& image, const std::vector<std::uint8_t>& filled) const;
};

inline constexpr const char* truth_filament = "petg-grey";
inline constexpr int truth_side = 12;          ///< samples of a pixel, squared
inline constexpr double single_wall_bulge = 1; ///< half circles
