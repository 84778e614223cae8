#include "limn/drawing/sheet.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

void check(const std::vector<Drawing>& pictures, std::span<const ivec2> corners, ivec2 size, std::span<const std::string> captions)
{
    if (pictures.empty())
        throw Error::Input("a sheet needs at least one picture");
    if (corners.size() != pictures.size() || (!captions.empty() && captions.size() != pictures.size()))
        throw Error::Input(fmt::format("a sheet of {} pictures has {} places and {} captions", pictures.size(), corners.size(), captions.size()));
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const ivec2 low = corners[i], high = corners[i] + pictures[i].camera.size;
        if (low.x < 0 || low.y < 0 || high.x > size.x || high.y > size.y)
            throw Error::Input(fmt::format("picture {} at {},{} is not on the sheet of {}x{}", i + 1, low.x, low.y, size.x, size.y));
        if (pictures[i].mm_per_pixel != pictures[0].mm_per_pixel)
            throw Error::Input(fmt::format("the pictures of a sheet have different scales: {} and {} mm per pixel", pictures[0].mm_per_pixel, pictures[i].mm_per_pixel));
    }
}

void shift(std::vector<dvec2>& points, const dvec2& by)
{
    for (dvec2& p : points)
        p += by;
}

/// Strokes, regions and captions to their place on the sheet.
void shift(Drawing& picture, const dvec2& by)
{
    for (Stroke& stroke : picture.strokes)
        shift(stroke.points, by);
    for (Region& region : picture.regions)
        for (auto& ring : region.rings)
            shift(ring, by);
    for (Caption& caption : picture.captions)
        caption.position += by;
}

void paste(Image& sheet, const Image& picture, const ivec2& corner)
{
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            for (int c = 0; c < 3; ++c)
                sheet.at(corner.x + x, corner.y + y)[c] = picture.at(x, y)[picture.channels < 3 ? 0 : c];
}

Caption caption_for(const Drawing& picture, const std::string& text)
{
    const dvec2 size = picture.camera.size;
    const double shorter = std::min(size.x, size.y);
    return {{0.5 * size.x, size.y - 0.01 * shorter}, 0.03 * shorter, text};
}

template <class T> void append(std::vector<T>& to, std::vector<T>& from) { std::move(from.begin(), from.end(), std::back_inserter(to)); }

/// Region k of every picture before region k + 1 of any, so that regions of one kind stay together.
void add_regions(Drawing& sheet, std::vector<Drawing>& pictures)
{
    std::size_t most = 0;
    for (const Drawing& picture : pictures)
        most = std::max(most, picture.regions.size());
    for (std::size_t k = 0; k < most; ++k)
        for (Drawing& picture : pictures)
            if (k < picture.regions.size())
                sheet.regions.push_back(std::move(picture.regions[k]));
}

} // namespace

Drawing lay_on_sheet(std::vector<Drawing> pictures, std::span<const ivec2> corners, ivec2 size, std::span<const std::string> captions)
{
    check(pictures, corners, size, captions);
    Drawing sheet;
    sheet.camera = pictures[0].camera;
    sheet.camera.size = size;
    sheet.mm_per_pixel = pictures[0].mm_per_pixel;
    if (std::any_of(pictures.begin(), pictures.end(), [](const Drawing& d) { return !d.background.empty(); }))
        sheet.background = Image(size, 3, 1.0f);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        if (!captions.empty())
            pictures[i].captions.push_back(caption_for(pictures[i], captions[i]));
        shift(pictures[i], dvec2(corners[i]));
        paste(sheet.background, pictures[i].background, corners[i]);
        append(sheet.strokes, pictures[i].strokes);
        append(sheet.captions, pictures[i].captions);
    }
    add_regions(sheet, pictures);
    std::stable_sort(sheet.strokes.begin(), sheet.strokes.end(), [](const Stroke& a, const Stroke& b) { return a.type < b.type; });
    return sheet;
}

} // namespace limn
