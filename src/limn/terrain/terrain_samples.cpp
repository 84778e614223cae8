#include "limn/terrain/terrain_samples.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_invoke.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/terrain/mountains.h"
#include "limn/terrain/write_height_map.h"

namespace limn {
namespace {

constexpr int fewest = 2, most = 1 << 20;
constexpr double mountain_spacing = 10;
/// Rows that are made before they are written: enough for every thread.
constexpr std::size_t samples_together = std::size_t(1) << 22;

/// The height of column x and row y, a function of nothing else.
using Landform = std::function<float(int x, int y)>;

long remainder(long u, long period) { return (u % period + period) % period; }

/// A triangle wave of period 2 p between 0 and p.
long triangle(long u, long p) { return std::abs(remainder(u, 2 * p) - p); }

float reference(int column, int row)
{
    const long x = column, y = row;
    return float(3 * triangle(x + y / 2, 96) + 2 * triangle(2 * x - 3 * y + 1000, 70) + 4 * triangle(5 * x + 7 * y, 45) / 3 +
                 remainder(31 * x * x + 17 * y * y + 13 * x * y, 61) / 12);
}

Landform spike(const TerrainSampleOptions& options)
{
    constexpr float height = 100;
    const bool reaches = options.columns > 101 && options.rows > 77;
    const ivec2 at = reaches ? ivec2(101, 77) : ivec2(options.columns / 2, options.rows / 2);
    return [at](int x, int y) { return x == at.x && y == at.y ? height : 0.0f; };
}

Landform mountains(const TerrainSampleOptions& options)
{
    const Mountains terrain(
        {.extent = mountain_spacing * std::max(options.columns, options.rows), .spacing = mountain_spacing, .seed = options.seed});
    return [terrain](int x, int y) { return float(terrain.height({mountain_spacing * x, mountain_spacing * y})); };
}

using MakeLandform = std::function<Landform(const TerrainSampleOptions&)>;

const std::vector<std::pair<std::string, MakeLandform>>& landforms()
{
    static const std::vector<std::pair<std::string, MakeLandform>> all = {
        {"mountains", mountains},
        {"reference", [](const TerrainSampleOptions&) { return Landform(reference); }},
        {"paraboloid",
         [](const TerrainSampleOptions&) { return Landform([](int x, int y) { return float(double(x) * x + double(y) * y); }); }},
        {"spike", spike},
        {"sine", [](const TerrainSampleOptions&) {
             return Landform([](int x, int y) { return float(8 * std::sin(x / 20.0) * std::cos(y / 25.0)); });
         }}};
    return all;
}

Landform landform_of(const TerrainSampleOptions& options)
{
    if (std::min(options.columns, options.rows) < fewest || std::max(options.columns, options.rows) > most)
        throw Error::Input(fmt::format("--size: {}x{} is outside {}x{}..{}x{}", options.columns, options.rows, fewest, fewest, most, most));
    for (const auto& [name, make] : landforms())
        if (name == options.landform)
            return make(options);
    throw Error::Input(fmt::format("there is no landform '{}'; known are {}", options.landform, fmt::join(landform_names(), ", ")));
}

HeightMap frame_of(const TerrainSampleOptions& options)
{
    const double spacing = options.landform == "mountains" ? mountain_spacing : 1;
    return {.columns = options.columns, .rows = options.rows, .heights = {}, .spacing = dvec2(spacing), .origin = {}, .system = {}};
}

void fill_rows(const Landform& height, int columns, int first, int count, float* heights)
{
    parallel_each(std::size_t(count), 1, [&](std::size_t row) {
        float* const out = heights + row * std::size_t(columns);
        for (int x = 0; x < columns; ++x)
            out[x] = height(x, first + int(row));
    });
}

int parse_side(std::string_view text, std::string_view whole)
{
    const bool digits = !text.empty() && text.size() <= 7 && text.find_first_not_of("0123456789") == std::string_view::npos;
    const int side = digits ? std::stoi(std::string(text)) : 0;
    if (!digits)
        throw Error::Input(fmt::format("--size: '{}' is neither N nor COLUMNSxROWS", whole));
    if (side < fewest || side > most)
        throw Error::Input(fmt::format("--size: '{}' is outside {}..{} samples a side", whole, fewest, most));
    return side;
}

void set_size(TerrainSampleOptions& options, std::string_view text)
{
    const std::size_t x = text.find('x');
    options.columns = parse_side(text.substr(0, x), text);
    options.rows = x == std::string_view::npos ? options.columns : parse_side(text.substr(x + 1), text);
}

} // namespace

HeightMap make_terrain(const TerrainSampleOptions& options)
{
    const Landform height = landform_of(options);
    HeightMap map = frame_of(options);
    map.heights.resize(std::size_t(map.columns) * std::size_t(map.rows));
    fill_rows(height, map.columns, 0, map.rows, map.heights.data());
    return map;
}

void write_terrain_sample(const TerrainSampleOptions& options, const std::filesystem::path& path,
                          const std::function<void(double)>& progress)
{
    const Landform height = landform_of(options);
    const HeightMap frame = frame_of(options);
    HeightMapWriter writer(frame, path);
    const int together = std::max(1, int(samples_together / std::size_t(frame.columns)));
    const auto made = [&](int row) {
        const int count = std::clamp(frame.rows - row, 0, together);
        std::vector<float> heights(std::size_t(frame.columns) * std::size_t(count));
        fill_rows(height, frame.columns, row, count, heights.data());
        return heights;
    };
    std::vector<float> heights = made(0), next;
    for (int row = 0; row < frame.rows; row += together) {
        const int count = std::min(together, frame.rows - row);
        tbb::parallel_invoke([&] { writer.write_rows(heights.data(), count); }, [&] { next = made(row + together); });
        std::swap(heights, next);
        if (progress)
            progress(double(row + count) / frame.rows);
    }
    writer.finish();
}

const std::vector<std::string>& landform_names()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const auto& [name, make] : landforms())
            all.push_back(name);
        return all;
    }();
    return names;
}

const OptionTable<TerrainSampleOptions>& terrain_sample_option_table()
{
    static const OptionTable<TerrainSampleOptions> table = [] {
        std::vector<std::pair<std::string, std::string>> words;
        for (const std::string& name : landform_names())
            words.emplace_back(name, name);
        return OptionTable<TerrainSampleOptions>{
            choice_row<TerrainSampleOptions, std::string>("landform", words, "what the terrain is like", &TerrainSampleOptions::landform),
            {"size", "samples", "N|COLUMNSxROWS", "how large the terrain is", set_size, [](const TerrainSampleOptions& options) {
                 return options.columns == options.rows ? std::to_string(options.columns)
                                                        : fmt::format("{}x{}", options.columns, options.rows);
             }}};
    }();
    return table;
}

} // namespace limn
