#include "limn/scene/terrain_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "limn/lines/features.h"
#include "limn/lines/strokes.h"
#include "limn/scene/iso_labels.h"
#include "limn/scene/iso_strokes.h"
#include "limn/terrain/iso_lines.h"
#include "limn/terrain/smooth_heights.h"
#include "limn/terrain/terrain_surface.h"

namespace limn {
namespace {

Bounds map_bounds(const HeightMap& map)
{
    Bounds bounds;
    for (int row = 0; row < map.rows; ++row)
        for (int column = 0; column < map.columns; ++column)
            if (map.has_data(column, row))
                bounds.add(map.position(column, row));
    return bounds;
}

/// How wide the Gaussians of generalised_for() are.
class Generalising {
public:
    Generalising(const HeightMap& map, const Camera& camera, const TerrainLineOptions& options) : camera_(camera)
    {
        constexpr double least_samples = 2; // what differences of the third order need
        const bool curved = surface_need(options.lines) == Need::derivative;
        pixels_ = options.generalise.value_or(is_plan(camera) && !curved ? 1 : 4);
        least_ = curved ? least_samples * std::max(map.spacing.x, map.spacing.y) : 0;
    }
    double pixels() const { return pixels_; }
    /// Metres.
    double deviation(const dvec3& p) const
    {
        const double depth = camera_.project(p).depth;
        return std::max(least_, camera_.orthographic || depth > 0 ? pixels_ / camera_.pixels_per_unit(depth) : 0.0);
    }

private:
    const Camera& camera_;
    double pixels_, least_;
};

/// Short pieces of contour on slopes that only just turn away read as specks, not as edges.
bool is_speck(const Stroke& stroke, const LineOptions& options)
{
    return stroke.type == LineType::contour && stroke.visible && length_in_picture(stroke) < options.min_length / 3;
}

/// The lines of a map's levels, light or heavy ones.
std::vector<IsoLine> lines_of_levels(const HeightMap& map, const TerrainLineOptions& options, bool heavy)
{
    const double step = options.iso.metres() * options.exaggerate;
    const IsoFactors factors = iso_factors(map, step);
    std::vector<double> levels;
    for (long long k = factors.first; k < factors.end; ++k)
        if ((options.iso_heavy > 0 && k % options.iso_heavy == 0) == heavy)
            levels.push_back(double(k) * step);
    return iso_lines(map, levels);
}

/// The height of an iso line's stroke as it is written: in the step's unit.
std::string height_text(const Stroke& stroke, const TerrainLineOptions& options)
{
    const double factor = std::round(stroke.world.front().z / (options.iso.metres() * options.exaggerate));
    return fmt::format("{:.6g}", factor * options.iso.value);
}

void add_iso_strokes(Drawing& drawing, const HeightMap& map, const IsoScene& scene, const TerrainLineOptions& options, DrawReport& report)
{
    std::vector<Stroke> all;
    IsoLabels labels(options.iso_text, scene.camera.size, drawing.strokes);
    for (const bool heavy : {false, true}) {
        const LineType type = heavy ? LineType::iso_heavy : LineType::iso;
        DrawReport::PerType& counts = report.types[std::size_t(type)];
        for (Stroke& stroke : iso_strokes(scene, lines_of_levels(map, options, heavy), type, options.lines)) {
            counts.segments += stroke.points.size();
            counts.strokes += stroke.visible;
            (stroke.visible ? counts.visible_pixels : counts.hidden_pixels) += length_in_picture(stroke);
            if (heavy)
                std::ranges::move(labels.write(stroke, height_text(stroke, options)), std::back_inserter(all));
            else
                all.push_back(std::move(stroke));
        }
    }
    drawing.strokes.insert(drawing.strokes.begin(), std::make_move_iterator(all.begin()), std::make_move_iterator(all.end()));
    drawing.captions = labels.captions();
}

void set_generalise(TerrainLineOptions& options, std::string_view text)
{
    if (text == "usual") {
        options.generalise.reset();
        return;
    }
    const double pixels = parse_number("generalise", text);
    if (!(pixels >= 0 && pixels <= 100))
        throw Error::Input(fmt::format("--generalise: {} is outside 0..100", text));
    options.generalise = pixels;
}

} // namespace

TerrainLineOptions::TerrainLineOptions()
{
    lines.lines = {LineType::suggestive, LineType::border, LineType::contour};
    lines.min_length = 25;
}

IsoStep iso_step_from_text(std::string_view text)
{
    IsoStep step;
    std::string_view number = text;
    if (number.ends_with("ft"))
        step.in_feet = true, number.remove_suffix(2);
    else if (number.ends_with("m"))
        number.remove_suffix(1);
    while (number.ends_with(' '))
        number.remove_suffix(1);
    try {
        step.value = parse_number("iso", number);
    } catch (const Error::Input&) {
        throw Error::Input(fmt::format("--iso: '{}' is neither metres (50m) nor feet (200ft)", text));
    }
    if (step.value < 0)
        throw Error::Input(fmt::format("--iso: {} is below 0", text));
    return step;
}

std::string iso_step_text(const IsoStep& step) { return fmt::format("{}{}", step.value, step.in_feet ? "ft" : "m"); }

const OptionTable<TerrainLineOptions>& terrain_line_option_table()
{
    using Options = TerrainLineOptions;
    static const OptionTable<Options> table = {
        {"iso", "", "0m or more, or feet (200ft)", "lines of equal height, so far apart; 0m: none",
         [](Options& options, std::string_view text) { options.iso = iso_step_from_text(text); }, [](const Options& options) { return iso_step_text(options.iso); }},
        number_row("iso-heavy", "", 0, 1000, "every so many iso lines are heavier, counted from height 0; 0: none", &Options::iso_heavy),
        number_row("iso-text", "px", 0, 200, "height of the figures in heavy iso lines; 0: none", &Options::iso_text),
        {"generalise", "px", "usual|0..100", "what is narrower is left out of drawings: heights are smoothed so far; usual: 4, in plans of iso lines 1; 0: not at all",
         set_generalise, [](const Options& options) { return options.generalise ? fmt::format("{}", *options.generalise) : "usual"; }},
    };
    return table;
}

const OptionTable<LineOptions>& terrain_shape_line_table()
{
    static const OptionTable<LineOptions> table = [] {
        static constexpr std::array<std::string_view, 10> used = {"lines", "hidden", "suggestive-limit", "highlight-limit", "ridge-limit",
                                                                  "apparent-limit", "fade", "feature-size", "min-length", "tolerance"};
        OptionTable<LineOptions> rows;
        std::copy_if(line_option_table().begin(), line_option_table().end(), std::back_inserter(rows),
                     [](const OptionRow<LineOptions>& row) { return std::find(used.begin(), used.end(), row.name) != used.end(); });
        return rows;
    }();
    return table;
}

bool is_plan(const Camera& camera)
{
    constexpr double straight_down = 0.999; // 2.6 degrees from it
    return camera.orthographic && -camera.forward().z > straight_down;
}

HeightMap generalised_for(const HeightMap& map, const Camera& camera, const TerrainLineOptions& options)
{
    const Generalising generalising(map, camera, options);
    return generalising.pixels() > 0 ? smooth_heights(map, [&](const dvec3& p) { return generalising.deviation(p); }) : map;
}

TerrainMove how_moved(const HeightMap& from, const HeightMap& to)
{
    TerrainMove move;
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < from.heights.size(); ++i)
        if (const double d = std::abs(double(to.heights[i]) - double(from.heights[i])); d == d) {
            move.maximum = std::max(move.maximum, d);
            sum += d * d;
            ++count;
        }
    move.rms = count > 0 ? std::sqrt(sum / double(count)) : 0;
    return move;
}

double drawn_edge(const HeightMap& map, const Camera& camera, const TerrainLineOptions& options)
{
    const double finest = 2 * std::max(map.spacing.x, map.spacing.y);
    return 1.5 * std::max(finest, Generalising(map, camera, options).deviation(map_bounds(map).centre()));
}

Drawing draw_terrain(const HeightMap& map, const Mesh& mesh, const Camera& camera, const TerrainLineOptions& options, DrawReport* report)
{
    DrawReport unread;
    DrawReport& measured = report ? *report : unread;
    const Surface surface = terrain_surface(map, mesh, surface_need(options.lines));
    const PlacedSurface placed = {&mesh, &surface};
    const LineModel model = build_line_model({&placed, 1});
    const RayScene rays = build_ray_scene(model);
    Drawing drawing = draw_lines(model, rays, camera, options.lines, &measured);
    const std::size_t specks = std::erase_if(drawing.strokes, [&](const Stroke& stroke) { return is_speck(stroke, options.lines); });
    measured.types[std::size_t(LineType::contour)].strokes -= specks;
    if (options.iso.value > 0)
        add_iso_strokes(drawing, map, {model, rays, camera}, options, measured);
    return drawing;
}

} // namespace limn
