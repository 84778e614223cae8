#include "limn/drawing/cairo_paint.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <cairo.h>

namespace limn {
namespace {

struct DeleteSurface {
    void operator()(cairo_surface_t* surface) { cairo_surface_destroy(surface); }
};

std::uint32_t pixel_of(const Image& image, int x, int y)
{
    const float* samples = image.at(x, y);
    const bool grey = image.channels < 3;
    const float alpha = image.channels == 2 ? samples[1] : image.channels == 4 ? samples[3] : 1.0f;
    const auto byte = [&](float c) { return std::uint32_t(std::lround(std::clamp(c * alpha, 0.0f, 1.0f) * 255)); };
    return std::uint32_t(std::lround(std::clamp(alpha, 0.0f, 1.0f) * 255)) << 24 | byte(samples[0]) << 16 | byte(samples[grey ? 0 : 1]) << 8 |
           byte(samples[grey ? 0 : 2]);
}

std::unique_ptr<cairo_surface_t, DeleteSurface> surface_of(const Image& image)
{
    const bool opaque = image.channels % 2 == 1;
    std::unique_ptr<cairo_surface_t, DeleteSurface> surface(
        cairo_image_surface_create(opaque ? CAIRO_FORMAT_RGB24 : CAIRO_FORMAT_ARGB32, image.width, image.height));
    cairo_surface_flush(surface.get());
    auto* data = cairo_image_surface_get_data(surface.get());
    const int stride = cairo_image_surface_get_stride(surface.get());
    for (int y = 0; data && y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            reinterpret_cast<std::uint32_t*>(data + std::ptrdiff_t(y) * stride)[x] = pixel_of(image, x, y);
    cairo_surface_mark_dirty(surface.get());
    return surface;
}

void paint_background(cairo_t* cairo, const Painting& painting)
{
    const auto surface = surface_of(*painting.background);
    cairo_save(cairo);
    cairo_translate(cairo, painting.page.corner.x, painting.page.corner.y);
    cairo_scale(cairo, painting.page.scale, painting.page.scale);
    cairo_set_source_surface(cairo, surface.get(), 0, 0);
    cairo_paint(cairo);
    cairo_restore(cairo);
}

void trace(cairo_t* cairo, const Path& path)
{
    cairo_move_to(cairo, path.start.x, path.start.y);
    for (const CurveSpan& s : path.spans) {
        if (s.straight)
            cairo_line_to(cairo, s.end.x, s.end.y);
        else
            cairo_curve_to(cairo, s.control1.x, s.control1.y, s.control2.x, s.control2.y, s.end.x, s.end.y);
    }
    if (path.closed)
        cairo_close_path(cairo);
}

void paint_mark(cairo_t* cairo, const Layer& layer, const Mark& mark)
{
    cairo_set_source_rgba(cairo, double(layer.colour.r), double(layer.colour.g), double(layer.colour.b), mark.opacity);
    cairo_new_path(cairo);
    for (const Path& path : mark.paths)
        trace(cairo, path);
    if (layer.width <= 0)
        return cairo_fill(cairo);
    cairo_set_line_cap(cairo, mark.butt_caps || layer.dash > 0 ? CAIRO_LINE_CAP_BUTT : CAIRO_LINE_CAP_ROUND);
    cairo_stroke(cairo);
}

void paint_layer(cairo_t* cairo, const Layer& layer)
{
    const bool grouped = layer.opacity < 1;
    cairo_save(cairo);
    if (grouped)
        cairo_push_group(cairo);
    cairo_set_antialias(cairo, CAIRO_ANTIALIAS_BEST);
    cairo_set_fill_rule(cairo, layer.even_odd ? CAIRO_FILL_RULE_EVEN_ODD : CAIRO_FILL_RULE_WINDING);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_width(cairo, layer.width);
    const double dashes[] = {layer.dash, layer.gap};
    cairo_set_dash(cairo, dashes, layer.dash > 0 ? 2 : 0, 0);
    for (const Mark& mark : layer.marks)
        paint_mark(cairo, layer, mark);
    if (grouped) {
        cairo_pop_group_to_source(cairo);
        cairo_paint_with_alpha(cairo, layer.opacity);
    }
    cairo_restore(cairo);
}

} // namespace

void paint(_cairo* cairo, const Painting& painting)
{
    if (painting.background)
        paint_background(cairo, painting);
    for (const Layer& layer : painting.layers)
        paint_layer(cairo, layer);
}

} // namespace limn
