#include "limn/drawing/sheet.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

/// Where the cells of a sheet lie, in pixels.
struct Grid {
    int columns = 1, rows = 1;
    ivec2 cell = {0, 0};
    int gap = 0, caption = 0; ///< caption: height of the strip under each picture

    ivec2 size() const { return {columns * cell.x + (columns - 1) * gap, rows * (cell.y + caption) + (rows - 1) * gap}; }
    ivec2 corner(int index) const
    {
        return {(index % columns) * (cell.x + gap), (index / columns) * (cell.y + caption + gap)};
    }
};

void check(std::span<const Drawing> drawings, const SheetOptions& options)
{
    if (drawings.empty())
        throw Error::Input("a sheet needs at least one drawing");
    if (!options.captions.empty() && options.captions.size() != drawings.size())
        throw Error::Input(fmt::format("a sheet of {} drawings has {} captions", drawings.size(), options.captions.size()));
    for (const Drawing& drawing : drawings)
        if (drawing.mm_per_pixel != drawings[0].mm_per_pixel)
            throw Error::Input(fmt::format("the drawings of a sheet have different scales: {} and {} mm per pixel", drawings[0].mm_per_pixel, drawing.mm_per_pixel));
}

Grid grid_for(std::span<const Drawing> drawings, const SheetOptions& options)
{
    Grid grid;
    for (const Drawing& drawing : drawings)
        grid.cell = glm::max(grid.cell, drawing.camera.size);
    const int larger = std::max(grid.cell.x, grid.cell.y), count = int(drawings.size());
    grid.gap = int(std::lround(std::max(0.0, options.gap) * larger));
    grid.caption = options.captions.empty() ? 0 : std::max(1, int(std::lround(0.06 * larger)));
    const auto with_columns = [&](int columns) {
        Grid tried = grid;
        tried.columns = std::clamp(columns, 1, count);
        tried.rows = (count + tried.columns - 1) / tried.columns;
        return tried;
    };
    if (options.columns > 0)
        return with_columns(options.columns);
    // Unlikeness to 4 : 3, where an empty cell counts like a tenth of it.
    const auto unlikeness = [&](const Grid& g) {
        return std::abs(std::log(0.75 * g.size().x / g.size().y)) + 0.1 * (g.columns * g.rows - count);
    };
    Grid best = with_columns(1);
    for (int columns = 2; columns <= count; ++columns)
        if (const Grid tried = with_columns(columns); unlikeness(tried) < unlikeness(best))
            best = tried;
    return best;
}

void copy_picture(const Image& from, Image& to, const ivec2& corner)
{
    for (int y = 0; y < from.height; ++y)
        for (int x = 0; x < from.width; ++x)
            for (int c = 0; c < 3; ++c)
                to.at(corner.x + x, corner.y + y)[c] = from.at(x, y)[from.channels < 3 ? 0 : c];
}

void add_strokes(Drawing& sheet, const Drawing& drawing, const dvec2& corner)
{
    for (Stroke stroke : drawing.strokes) {
        for (dvec2& p : stroke.points)
            p += corner;
        sheet.strokes.push_back(std::move(stroke));
    }
}

/// Region k of every drawing before region k + 1 of any, so that regions of one kind stay together.
void add_regions(Drawing& sheet, std::span<const Drawing> drawings, const std::vector<ivec2>& corners)
{
    std::size_t most = 0;
    for (const Drawing& drawing : drawings)
        most = std::max(most, drawing.regions.size());
    for (std::size_t k = 0; k < most; ++k)
        for (std::size_t i = 0; i < drawings.size(); ++i) {
            if (k >= drawings[i].regions.size())
                continue;
            Region region = drawings[i].regions[k];
            for (auto& ring : region.rings)
                for (dvec2& p : ring)
                    p += dvec2(corners[i]);
            sheet.regions.push_back(std::move(region));
        }
}

} // namespace

Drawing make_sheet(std::span<const Drawing> drawings, const SheetOptions& options)
{
    check(drawings, options);
    const Grid grid = grid_for(drawings, options);
    Drawing sheet;
    sheet.camera = drawings[0].camera;
    sheet.camera.size = grid.size();
    sheet.mm_per_pixel = drawings[0].mm_per_pixel;
    std::vector<ivec2> corners;
    for (std::size_t i = 0; i < drawings.size(); ++i)
        corners.push_back(grid.corner(int(i)) + (grid.cell - drawings[i].camera.size) / 2);
    if (std::any_of(drawings.begin(), drawings.end(), [](const Drawing& d) { return !d.background.empty(); }))
        sheet.background = Image(grid.size(), 3, 1.0f);
    for (std::size_t i = 0; i < drawings.size(); ++i) {
        add_strokes(sheet, drawings[i], corners[i]);
        if (!drawings[i].background.empty())
            copy_picture(drawings[i].background, sheet.background, corners[i]);
        if (!options.captions.empty())
            sheet.captions.push_back({dvec2(grid.corner(int(i))) + dvec2(0.5 * grid.cell.x, grid.cell.y + 0.75 * grid.caption), 0.5 * grid.caption,
                                      options.captions[i]});
    }
    add_regions(sheet, drawings, corners);
    std::stable_sort(sheet.strokes.begin(), sheet.strokes.end(), [](const Stroke& a, const Stroke& b) { return a.type < b.type; });
    return sheet;
}

} // namespace limn
