#include "limn/pattern/bead_colours.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <limits>

#include <fmt/format.h>

#include "limn/pattern/cusp.h"
#include "limn/pattern/filament.h"

namespace limn {
namespace {

using Rgb = std::array<float, 3>;

vec3 colour_of(const Rgb& c) { return {c[0], c[1], c[2]}; }

/// By feature, in their order: walls warm, what fills them cool, what comes off grey or green.
constexpr Rgb feature_colours[bead_feature_count] = {
    {0.93f, 0.55f, 0.19f}, {0.96f, 0.80f, 0.35f}, {0.35f, 0.36f, 0.80f}, {0.84f, 0.25f, 0.24f}, {0.62f, 0.30f, 0.62f},
    {0.66f, 0.16f, 0.23f}, {0.29f, 0.51f, 0.80f}, {0.95f, 0.93f, 0.85f}, {0.95f, 0.60f, 0.62f}, {0.20f, 0.50f, 0.36f},
    {0.28f, 0.70f, 0.35f}, {0.15f, 0.58f, 0.55f}, {0.66f, 0.72f, 0.60f}, {0.55f, 0.55f, 0.55f},
};
constexpr Rgb tool_colours[] = {
    {0.93f, 0.55f, 0.19f}, {0.20f, 0.48f, 0.72f}, {0.35f, 0.65f, 0.30f}, {0.78f, 0.25f, 0.30f},
    {0.55f, 0.40f, 0.70f}, {0.90f, 0.80f, 0.30f}, {0.30f, 0.30f, 0.32f}, {0.92f, 0.92f, 0.90f},
};

double value_of(PrintColour kind, const PrintMove& move) { return double(kind == PrintColour::height ? move.height : move.speed); }

} // namespace

vec3 travel_colour() { return {0.24f, 0.62f, 0.86f}; }
vec3 feature_colour(BeadFeature feature) { return colour_of(feature_colours[int(feature)]); }
vec3 tool_colour(int tool) { return colour_of(tool_colours[std::size_t(tool) % std::size(tool_colours)]); }

BeadColours::BeadColours(const PrintPath& path, const PrintOptions& options, const vec3& filament)
    : kind_(options.colour), filament_(linear_colour(filament))
{
    std::bitset<bead_feature_count> features;
    std::bitset<256> tools;
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (const PrintMove& move : path.moves) {
        if (!move.extrudes())
            continue;
        features.set(std::size_t(move.feature));
        tools.set(move.tool);
        low = std::min(low, value_of(kind_, move));
        high = std::max(high, value_of(kind_, move));
    }
    for (int k = 0; kind_ == PrintColour::feature && k < bead_feature_count; ++k)
        if (features[std::size_t(k)])
            legend_.swatches.push_back({feature_colour(BeadFeature(k)), std::string(feature_name(BeadFeature(k)))});
    for (int k = 0; kind_ == PrintColour::tool && k < int(tools.size()); ++k)
        if (tools[std::size_t(k)])
            legend_.swatches.push_back({tool_colour(k), fmt::format("tool {}", k)});
    if (kind_ == PrintColour::height || kind_ == PrintColour::speed) {
        legend_.scale = true;
        legend_.low = low;
        legend_.high = high;
        legend_.unit = kind_ == PrintColour::height ? "mm" : "mm/s";
    }
    if (options.travel)
        legend_.swatches.push_back({travel_colour(), "travel"});
}

vec3 BeadColours::of(const PrintMove& move) const
{
    if (!move.extrudes())
        return linear_colour(travel_colour());
    switch (kind_) {
    case PrintColour::feature: return linear_colour(feature_colour(move.feature));
    case PrintColour::tool: return linear_colour(tool_colour(move.tool));
    case PrintColour::height:
    case PrintColour::speed: {
        const double range = legend_.high - legend_.low;
        return linear_colour(cusp_colour(range > 1e-4 * legend_.high ? float((value_of(kind_, move) - legend_.low) / range) : 0.5f));
    }
    default: return filament_;
    }
}

} // namespace limn
