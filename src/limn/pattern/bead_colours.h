#pragma once

#include <string>
#include <vector>

#include "limn/pattern/print_options.h"

namespace limn {

/// What the colours of a picture of a print mean.
struct PrintLegend {
    struct Swatch {
        vec3 colour; ///< encoded (sRGB)
        std::string text;
    };
    std::vector<Swatch> swatches; ///< of features or tools; empty for a scale
    bool scale = false;           ///< from low to high: cusp_colour
    double low = 0, high = 0;
    std::string unit;
    bool empty() const { return swatches.empty() && !scale; }
};

/// The colours of a print's beads.
class BeadColours {
public:
    /// @param filament  encoded colour of the filament
    BeadColours(const PrintPath& path, const PrintOptions& options, const vec3& filament);
    /// Linear.
    vec3 of(const PrintMove& move) const;
    const PrintLegend& legend() const { return legend_; }

private:
    PrintColour kind_;
    vec3 filament_; ///< linear
    PrintLegend legend_;
};

/// Encoded; of ways without beads: the first.
vec3 travel_colour();
vec3 feature_colour(BeadFeature feature);
vec3 tool_colour(int tool);

} // namespace limn
