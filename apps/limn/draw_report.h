#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common.h"
#include "eyes.h"
#include "limn/lines/draw.h"
#include "models.h"

/// How a view's lines were found in clusters of faces.
struct ClusterReport {
    double survivors = 0; ///< part of the clusters looked into in the last view that was bounded
    bool bounded = true;  ///< false: every cluster was looked into
};

/// One camera's drawing and how it came about.
struct DrawnView {
    limn::Camera camera;
    limn::DrawReport report;
    EyePlace eye = EyePlace::outside;
    std::optional<ClusterReport> clusters; ///< where clusters were built
};

/// Seconds of a run that belong to no single view.
struct Times {
    double rays = 0, features = 0, shade = 0, write = 0, total = 0;
};

/// The report of `limn draw --json` and `limn render --json`: where pixels were computed, inputs, warnings, cameras, counts and lengths by type, and seconds by stage.
/// @param more  an object whose members the report holds too
std::string draw_report(const std::string& command, const std::string& device, const Models& models, const std::vector<DrawnView>& views,
                        const std::vector<std::string>& written, const Warnings& warnings, const Times& times, const nlohmann::ordered_json& more);
