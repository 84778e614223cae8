#include "print_info.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common.h"
#include "console.h"
#include "limn/base/file.h"
#include "models.h"
#include "raster_info.h"

using namespace limn;

namespace {

std::string height_text(const PrintFacts& facts)
{
    return facts.thickest - facts.thinnest < 1e-4 ? fmt::format("{:.4g} mm", facts.thickest)
                                                  : fmt::format("{:.4g} to {:.4g} mm", facts.thinnest, facts.thickest);
}

/// Slicers write "1h 2m 3s", or seconds.
std::string stated_time(const std::string& told)
{
    if (told.find_first_not_of("0123456789") != std::string::npos)
        return told;
    return duration_text(std::atof(told.c_str()));
}

} // namespace

bool is_gcode(const std::string& file, const std::string& from) { return is_gcode_format(input_format(file, from)); }

std::string duration_text(double seconds)
{
    const auto minutes = std::int64_t(std::min(seconds, 1e15)) / 60;
    if (minutes >= 60)
        return fmt::format("{} h {} min", minutes / 60, minutes % 60);
    return minutes > 0 ? fmt::format("{} min {:.0f} s", minutes, std::floor(seconds) - double(minutes * 60))
                       : fmt::format("{:.3g} s", seconds);
}

std::string print_text(const PrintPath& path)
{
    const PrintFacts facts = print_facts(path);
    const dvec3 size = facts.bounds.size(), low = facts.bounds.low;
    std::string text = fact_row("slicer", path.slicer.empty() ? "not told" : path.slicer);
    text += fact_row("size",
                     fmt::format("{:.4g} x {:.4g} x {:.4g} mm, from {:.4g}, {:.4g}, {:.4g}", size.x, size.y, size.z, low.x, low.y, low.z));
    text += fact_row("layers", fmt::format("{}, {} high", with_thousands(path.layers.size()), height_text(facts)));
    text += fact_row("moves", fmt::format("{}, {} of them beads", with_thousands(path.moves.size()), with_thousands(facts.beads)));
    text += fact_row("beads", fmt::format("{:.4g} m", facts.extruded / 1000));
    for (int k = 0; k < bead_feature_count; ++k)
        if (const double length = facts.length[std::size_t(k)]; length > 0)
            text += fact_row("  " + std::string(feature_name(BeadFeature(k))), fmt::format("{:.4g} m", length / 1000));
    text += fact_row("travel", fmt::format("{:.4g} m, {}", facts.travel / 1000, counted(path.retractions, "retraction")));
    text += fact_row("filament", fmt::format("{:.4g} m of {:.4g} mm, {:.4g} cm³, {}", path.filament / 1000, path.filament_diameter,
                                             path.volume / 1000, counted(std::size_t(facts.tools), "tool")));
    text += fact_row("time", (path.stated_time.empty() ? "" : stated_time(path.stated_time) + " as the slicer says; ") + "above " +
                                 duration_text(path.seconds) + " (all moves at full speed)");
    for (std::size_t i = 0; i < path.notes.size(); ++i)
        text += fact_row(i == 0 ? "notes" : "", path.notes[i]);
    return text;
}

std::string print_json(const PrintPath& path, const std::string& file, double seconds)
{
    const PrintFacts facts = print_facts(path);
    const auto list = [](const dvec3& v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
    nlohmann::ordered_json features = nlohmann::ordered_json::object();
    for (int k = 0; k < bead_feature_count; ++k)
        if (const double length = facts.length[std::size_t(k)]; length > 0)
            features[std::string(feature_name(BeadFeature(k)))] = length;
    const nlohmann::ordered_json print = {
        {"slicer", path.slicer},
        {"bounds", {{"low", list(facts.bounds.low)}, {"high", list(facts.bounds.high)}}},
        {"layers", path.layers.size()},
        {"layer_height", {{"lowest", facts.thinnest}, {"highest", facts.thickest}}},
        {"lines", path.lines},
        {"moves", path.moves.size()},
        {"beads", facts.beads},
        {"extruded", facts.extruded},
        {"features", features},
        {"travel", facts.travel},
        {"retractions", path.retractions},
        {"tools", facts.tools},
        {"filament", {{"diameter", path.filament_diameter}, {"length", path.filament}, {"volume", path.volume}}},
        {"seconds", {{"stated", path.stated_time}, {"at_full_speed", path.seconds}}},
        {"notes", path.notes}};
    const nlohmann::ordered_json json = {
        {"limn", LIMN_VERSION}, {"command", "info"}, {"file", file}, {"print", print}, {"seconds", {{"read", seconds}}}};
    return json.dump(2) + "\n";
}
