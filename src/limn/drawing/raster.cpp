#include "limn/drawing/raster.h"

#include <cmath>
#include <memory>

#include <cairo.h>
#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/drawing/cairo_paint.h"
#include "limn/drawing/png.h"

namespace limn {
namespace {

struct DeleteCairo {
    void operator()(cairo_surface_t* surface) { cairo_surface_destroy(surface); }
    void operator()(cairo_t* cairo) { cairo_destroy(cairo); }
};
using Surface = std::unique_ptr<cairo_surface_t, DeleteCairo>;

ivec2 pixels_of(const PageLayout& page, double density)
{
    const dvec2 size = glm::round(dvec2(page.width, page.height) / page.scale * density);
    constexpr double largest = 32767; // Cairo's image surfaces
    if (!(size.x >= 1 && size.y >= 1 && size.x <= largest && size.y <= largest))
        throw Error::Input(fmt::format("--size: a picture of {:g} x {:g} pixels cannot be drawn; each side has 1..{:g}", size.x, size.y, largest));
    return size;
}

Image image_of(cairo_surface_t* surface)
{
    cairo_surface_flush(surface);
    Image image({cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface)}, 3);
    const unsigned char* data = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const std::uint32_t pixel = reinterpret_cast<const std::uint32_t*>(data + std::ptrdiff_t(y) * stride)[x];
            float* samples = image.at(x, y);
            for (int c = 0; c < 3; ++c)
                samples[c] = float(pixel >> (16 - 8 * c) & 255) / 255.0f;
        }
    return image;
}

Image rasterise(const Painting& painting, double density)
{
    const PageLayout& page = painting.page;
    const ivec2 size = pixels_of(page, density);
    const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.x, size.y));
    const std::unique_ptr<cairo_t, DeleteCairo> cairo(cairo_create(surface.get()));
    cairo_set_source_rgb(cairo.get(), double(painting.paper.r), double(painting.paper.g), double(painting.paper.b));
    cairo_paint(cairo.get());
    cairo_scale(cairo.get(), size.x / page.width, size.y / page.height);
    paint(cairo.get(), painting);
    if (const cairo_status_t status = cairo_status(cairo.get()); status != CAIRO_STATUS_SUCCESS)
        throw Error::Write(fmt::format("the picture of {} x {} pixels cannot be drawn: {}", size.x, size.y, cairo_status_to_string(status)));
    return image_of(surface.get());
}

/// A drawing without its background over two papers: over black the ink shows its colour times its cover; over white what is left of the white
/// says how much it covers.
struct OverBoth {
    Image on_black, on_white;
};

OverBoth over_both(Drawing drawing, Style style)
{
    drawing.background = {};
    style.page = {};
    style.paper = vec3(0);
    const Image on_black = rasterise(compose(drawing, style), 1);
    style.paper = vec3(1);
    return {on_black, rasterise(compose(drawing, style), 1)};
}

} // namespace

Image rasterise(const Drawing& drawing, const Style& style, double density) { return rasterise(compose(drawing, style), density); }

Image lay_over(const Image& picture, const Drawing& drawing, const Style& style)
{
    if (picture.channels != 3 || picture.size() != drawing.camera.size)
        throw Error::Input(fmt::format("a picture of {} x {} with {} channels does not lie under a drawing of {} x {}", picture.width, picture.height,
                                       picture.channels, drawing.camera.size.x, drawing.camera.size.y));
    const OverBoth ink = over_both(drawing, style);
    Image result = picture;
    for (std::size_t i = 0; i < result.samples.size(); ++i)
        result.samples[i] = ink.on_black.samples[i] + (ink.on_white.samples[i] - ink.on_black.samples[i]) * picture.samples[i];
    return result;
}

Image ink_cover(const Drawing& drawing, const Style& style)
{
    const OverBoth ink = over_both(drawing, style);
    Image cover(ink.on_black.size(), 1);
    for (std::size_t i = 0; i < cover.samples.size(); ++i)
        cover.samples[i] = 1 - (ink.on_white.samples[3 * i] - ink.on_black.samples[3 * i]);
    return cover;
}

std::string to_png(const Drawing& drawing, const Style& style)
{
    const Painting painting = compose(drawing, style);
    const PageLayout& page = painting.page;
    return encode_png(rasterise(painting, 1), {.bits = 8, .pixels_per_mm = 1 / (page.scale * page.mm_per_unit)});
}

void write_drawing_png(const Drawing& drawing, const std::filesystem::path& path, const Style& style)
{
    write_file(path, to_png(drawing, style));
}

} // namespace limn
