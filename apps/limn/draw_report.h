#pragma once

#include <string>
#include <vector>

#include "common.h"
#include "limn/lines/draw.h"
#include "models.h"

/// One camera's drawing and how it came about.
struct DrawnView {
    limn::Camera camera;
    limn::DrawReport report;
};

/// Seconds of a run that belong to no single view.
struct Times {
    double rays = 0, features = 0, shade = 0, write = 0, total = 0;
};

/// The report of `limn draw --json`: inputs, warnings, cameras, counts and lengths by type, and seconds by stage.
std::string draw_report(const Models& models, const std::vector<DrawnView>& views, const std::vector<std::string>& written,
                        const Warnings& warnings, const Times& times);
