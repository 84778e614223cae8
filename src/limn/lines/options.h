#pragma once

#include <array>
#include <vector>

#include "limn/base/options.h"
#include "limn/drawing/drawing.h"
#include "limn/lines/feature_size.h"
#include "limn/surface/surface.h"

namespace limn {

enum class Hidden : std::uint8_t { remove, dash, keep };
enum class ExtractMethod : std::uint8_t { exact, stochastic };

/// What is drawn, and where lines stop. Limits are without unit (they apply to feature_size^2 * D kr).
struct LineOptions {
    std::vector<LineType> lines = {LineType::contour, LineType::suggestive, LineType::crease, LineType::border};
    Hidden hidden = Hidden::remove;
    ExtractMethod method = ExtractMethod::exact;
    double suggestive_limit = 0.02;  ///< t_d; 0 keeps every suggestive contour, however short
    double highlight_limit = 0.02;   ///< t_h
    double ridge_limit = 0.5;        ///< ridges and valleys: smallest feature_size * curvature
    double apparent_limit = 0.5;     ///< apparent ridges: smallest feature_size * view-dependent curvature
    double fade = 5;                 ///< full ink from `fade` limits above a limit; 0: no fading
    double speed_limit = 0;          ///< drop suggestive lines faster than this (model radii per radius of camera motion); 0: off
    double crease_angle = 40;        ///< dihedral deviation from flat, degrees, from which an edge is a crease
    FeatureSize feature_size = {};
    double min_length = 10;          ///< drop strokes with less ink than a full line of this length, px (contours, borders and creases stay)
    double tolerance = 0.1;          ///< simplification of strokes, px
    double sample_fraction = 0.01;   ///< stochastic: part of the candidate faces tested
    double discovery = 0.2;          ///< stochastic: part of the seeds traded for random faces
    std::uint32_t seed = 1;          ///< stochastic

    bool has(LineType type) const;
};

/// How much of a surface the lines asked for look at.
Need surface_need(const LineOptions& options);

/// The numbers above as data, for the command line, help and scene files.
const OptionTable<LineOptions>& line_option_table();

} // namespace limn
