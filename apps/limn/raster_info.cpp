#include "raster_info.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common.h"
#include "console.h"
#include "limn/base/file.h"
#include "limn/geometry/read_mesh.h"

using namespace limn;

bool is_raster(const std::string& file, const std::string& from)
{
    const std::string ending = from.empty() ? file_ending(file) : from;
    if (is_mesh_format(ending))
        return false;
    return (!ending.empty() && is_raster_format(ending)) || (from.empty() && file != "-" && is_raster_file(file));
}

RasterFacts raster_facts(const std::string& file, const ReadHeightMapOptions& options, const std::function<void(double)>& progress)
{
    HeightRaster raster(file, options);
    RasterFacts facts;
    facts.frame = raster.frame();
    const HeightMap& frame = facts.frame;
    float lowest = std::numeric_limits<float>::infinity(), highest = -lowest;
    double sum = 0;
    std::vector<float> heights;
    for (int row = 0; row < frame.rows;) {
        const int count = raster.rows_together(row);
        heights.resize(std::size_t(count) * std::size_t(frame.columns));
        raster.read_rows(row, count, heights.data());
        for (const float h : heights) {
            if (std::isnan(h)) {
                ++facts.no_data;
                continue;
            }
            lowest = std::min(lowest, h);
            highest = std::max(highest, h);
            sum += double(h);
        }
        row += count;
        progress(double(row) / frame.rows);
    }
    facts.notes = raster.notes();
    facts.infinite = raster.infinite();
    if (const std::size_t known = std::size_t(frame.columns) * std::size_t(frame.rows) - facts.no_data; known > 0) {
        facts.lowest = lowest;
        facts.highest = highest;
        facts.mean = sum / double(known);
    }
    return facts;
}

std::string fact_row(const std::string& name, const std::string& value) { return fmt::format("{:<16}{}\n", name, value); }

std::string map_rows(const HeightMap& frame)
{
    return fact_row("columns", std::to_string(frame.columns)) + fact_row("rows", std::to_string(frame.rows)) +
           fact_row("spacing", fmt::format("{:.8g} x {:.8g} m", frame.spacing.x, frame.spacing.y)) +
           fact_row("size", fmt::format("{:.6g} x {:.6g} m", (frame.columns - 1) * frame.spacing.x, (frame.rows - 1) * frame.spacing.y)) +
           fact_row("system", frame.system.empty() ? "none" : frame.system) +
           fact_row("origin", fmt::format("{:.10g}, {:.10g} (south-western sample)", frame.origin.x, frame.origin.y));
}

nlohmann::ordered_json map_json(const HeightMap& frame)
{
    return {{"columns", frame.columns},
            {"rows", frame.rows},
            {"spacing", {frame.spacing.x, frame.spacing.y}},
            {"system", frame.system},
            {"origin", {frame.origin.x, frame.origin.y}}};
}

std::string raster_text(const RasterFacts& facts)
{
    std::string text = map_rows(facts.frame);
    text += fact_row("heights",
                     facts.has_data() ? fmt::format("{:.7g} to {:.7g} m, mean {:.7g} m", facts.lowest, facts.highest, facts.mean) : "none");
    text += fact_row("no data",
                     counted(facts.no_data, "sample") + (facts.infinite > 0 ? fmt::format(", {} of them infinite", facts.infinite) : ""));
    for (std::size_t i = 0; i < facts.notes.size(); ++i)
        text += fact_row(i == 0 ? "notes" : "", facts.notes[i]);
    return text;
}

std::string raster_json(const RasterFacts& facts, const std::string& file, double seconds)
{
    nlohmann::ordered_json heights; // null where nothing has data
    if (facts.has_data())
        heights = {{"lowest", facts.lowest}, {"highest", facts.highest}, {"mean", facts.mean}};
    nlohmann::ordered_json raster = map_json(facts.frame);
    raster.update({{"heights", heights}, {"no_data", facts.no_data}, {"infinite", facts.infinite}, {"notes", facts.notes}});
    const nlohmann::ordered_json json = {
        {"limn", LIMN_VERSION}, {"command", "info"}, {"file", file}, {"raster", raster}, {"seconds", {{"read", seconds}}}};
    return json.dump(2) + "\n";
}
