#include "limn/drawing/painting.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "limn/base/parallel.h"
#include "limn/drawing/lettering.h"
#include "limn/drawing/pen_order.h"
#include "limn/drawing/stroke_marks.h"

namespace limn {
namespace {

constexpr std::string_view labels[line_type_count] = {"Iso lines", "Heavy iso lines", "Suggestive highlights", "Valleys", "Ridges", "Apparent ridges", "Suggestive contours",
                                                      "Creases", "Borders", "Mesh contours", "Contours", "Outline"};

/// Layers of filled areas: regions that follow each other with one name and colour share a layer.
std::vector<Layer> region_layers(const Drawing& drawing, const Style& style, const PageLayout& page)
{
    std::vector<Layer> layers;
    std::map<std::string, int> used;
    std::string_view last_name;
    for (const Region& region : drawing.regions) {
        if (layers.empty() || last_name != region.name || layers.back().colour != region.colour) {
            Layer layer;
            const int number = ++used[region.name];
            layer.id = number > 1 ? fmt::format("fill-{}-{}", region.name, number) : fmt::format("fill-{}", region.name);
            layer.label = fmt::format("Fill: {}", region.name);
            layer.colour = region.colour;
            layer.even_odd = true;
            layers.push_back(std::move(layer));
            last_name = region.name;
        }
        if (Mark mark = region_mark(region, style, page); !mark.paths.empty())
            layers.back().marks.push_back(std::move(mark));
    }
    return layers;
}

/// The strokes of one layer in the order a pen draws them best.
std::vector<PenStep> order_strokes(const std::vector<const Stroke*>& strokes)
{
    std::vector<PenLine> lines;
    for (const Stroke* stroke : strokes)
        lines.push_back({stroke->points.front(), stroke->closed ? stroke->points.front() : stroke->points.back()});
    return pen_order(lines);
}

Layer stroke_layer(const Drawing& drawing, LineType type, bool visible, const Style& style, const PageLayout& page)
{
    std::vector<const Stroke*> strokes;
    for (const Stroke& stroke : drawing.strokes)
        if (stroke.type == type && stroke.visible == visible && stroke.points.size() >= 2)
            strokes.push_back(&stroke);
    const bool outlined = visible && style.stroke == StrokeMode::outline;
    const LineStyle& line = style.line(type);
    Layer layer;
    layer.id = fmt::format("{}{}", visible ? "" : "hidden-", line_type_name(type));
    layer.label = fmt::format("{}{}", visible ? "" : "Hidden: ", line_type_label(type));
    layer.colour = line.colour;
    layer.opacity = line.opacity * (visible ? 1 : style.hidden_opacity);
    const double width = page.units(line.width_mm * (visible ? 1 : style.hidden_width));
    layer.width = outlined ? 0 : width;
    layer.dash = visible ? 0 : page.units(style.dash_mm);
    layer.gap = visible ? 0 : page.units(style.dash_gap_mm);
    const std::vector<PenStep> order = order_strokes(strokes);
    layer.marks = parallel_collect<Mark>(order.size(), 16, [&](std::size_t begin, std::size_t end, std::vector<Mark>& out) {
        for (std::size_t i = begin; i < end; ++i) {
            const Stroke& stroke = *strokes[order[i].line];
            std::vector<Mark> marks = outlined ? outline_marks(stroke, width, style, page) : line_marks(stroke, order[i].reversed, style, page);
            std::move(marks.begin(), marks.end(), std::back_inserter(out));
        }
    });
    return layer;
}

Layer caption_layer(const Drawing& drawing, const PageLayout& page)
{
    Layer layer;
    layer.id = "captions";
    layer.label = "Captions";
    for (const Caption& caption : drawing.captions) {
        layer.width = std::max(layer.width, 0.1 * page.scale * caption.height);
        const double cosine = std::cos(caption.angle), sine = std::sin(caption.angle);
        for (std::vector<dvec2>& line : letter(caption.text)) {
            for (dvec2& p : line)
                p = page.on_page(caption.position + caption.height * dvec2(cosine * p.x + sine * p.y, cosine * p.y - sine * p.x)); // y is down
            Path path = {line[0], straight_spans(line, false)};
            layer.marks.push_back({{std::move(path)}});
        }
    }
    return layer;
}

} // namespace

std::string_view line_type_label(LineType type) { return labels[std::size_t(type)]; }

Painting compose(const Drawing& drawing, const Style& style)
{
    Painting painting;
    painting.page = lay_out(drawing, style);
    painting.paper = style.paper;
    painting.background = drawing.background.empty() ? nullptr : &drawing.background;
    painting.layers = region_layers(drawing, style, painting.page);
    for (const bool visible : {false, true})
        for (int type = 0; type < line_type_count; ++type)
            if (Layer layer = stroke_layer(drawing, LineType(type), visible, style, painting.page); !layer.marks.empty())
                painting.layers.push_back(std::move(layer));
    if (Layer captions = caption_layer(drawing, painting.page); !captions.marks.empty())
        painting.layers.push_back(std::move(captions));
    return painting;
}

} // namespace limn
