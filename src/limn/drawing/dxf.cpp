#include "limn/drawing/dxf.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "limn/base/file.h"

namespace limn {
namespace {

/// AutoCAD colour indices in the order of LineType; 7 is black on white and white on black.
constexpr std::array<int, line_type_count> colours = {32, 34, 40, 6, 3, 4, 1, 34, 8, 5, 7, 7};

std::string layer_name(LineType type, bool visible)
{
    std::string name = visible ? "" : "HIDDEN_";
    for (const char c : line_type_name(type))
        name += c == '-' ? '_' : char(std::toupper(static_cast<unsigned char>(c)));
    return name;
}

/// Group codes and values, one to a line.
class Groups {
public:
    void add(int code, std::string_view value) { fmt::format_to(std::back_inserter(text), "{}\n{}\n", code, value); }
    void add(int code, int value) { fmt::format_to(std::back_inserter(text), "{}\n{}\n", code, value); }
    void add(int code, double value) { fmt::format_to(std::back_inserter(text), "{}\n{:.4f}\n", code, value); }
    void point(const dvec2& p)
    {
        add(10, p.x);
        add(20, p.y);
        add(30, 0.0);
    }
    std::string text;
};

void add_header(Groups& dxf, const dvec2& page)
{
    dxf.add(999, "Limn line drawing, millimetres");
    dxf.add(0, "SECTION");
    dxf.add(2, "HEADER");
    dxf.add(9, "$ACADVER");
    dxf.add(1, "AC1009");
    for (const char* name : {"$EXTMIN", "$LIMMIN", "$EXTMAX", "$LIMMAX"}) {
        const bool is_low = std::string_view(name).ends_with("MIN");
        dxf.add(9, name);
        dxf.add(10, is_low ? 0.0 : page.x);
        dxf.add(20, is_low ? 0.0 : page.y);
        if (std::string_view(name).starts_with("$EXT"))
            dxf.add(30, 0.0);
    }
    dxf.add(0, "ENDSEC");
}

void add_line_type(Groups& dxf, const char* name, const char* description, std::initializer_list<double> dashes)
{
    dxf.add(0, "LTYPE");
    dxf.add(2, name);
    dxf.add(70, 0);
    dxf.add(3, description);
    dxf.add(72, 65);
    dxf.add(73, int(dashes.size()));
    double length = 0;
    for (const double dash : dashes)
        length += std::abs(dash);
    dxf.add(40, length);
    for (const double dash : dashes)
        dxf.add(49, dash);
}

struct LayerUse {
    LineType type;
    bool visible;
};

std::vector<LayerUse> used_layers(const Drawing& drawing)
{
    std::vector<LayerUse> layers;
    for (const bool visible : {false, true})
        for (int type = 0; type < line_type_count; ++type)
            if (std::any_of(drawing.strokes.begin(), drawing.strokes.end(),
                            [&](const Stroke& s) { return s.visible == visible && s.type == LineType(type); }))
                layers.push_back({LineType(type), visible});
    return layers;
}

void add_layer(Groups& dxf, std::string_view name, int colour, bool dashed)
{
    dxf.add(0, "LAYER");
    dxf.add(2, name);
    dxf.add(70, 0);
    dxf.add(62, colour);
    dxf.add(6, dashed ? "DASHED" : "CONTINUOUS");
}

void add_tables(Groups& dxf, const Drawing& drawing, const Style& style)
{
    dxf.add(0, "SECTION");
    dxf.add(2, "TABLES");
    dxf.add(0, "TABLE");
    dxf.add(2, "LTYPE");
    dxf.add(70, 2);
    add_line_type(dxf, "CONTINUOUS", "Solid line", {});
    add_line_type(dxf, "DASHED", "__ __ __", {style.dash_mm, -style.dash_gap_mm});
    dxf.add(0, "ENDTAB");
    const std::vector<LayerUse> layers = used_layers(drawing);
    dxf.add(0, "TABLE");
    dxf.add(2, "LAYER");
    dxf.add(70, int(layers.size()) + 1);
    for (const LayerUse& layer : layers)
        add_layer(dxf, layer_name(layer.type, layer.visible), colours[std::size_t(layer.type)], !layer.visible && style.dash_mm > 0);
    add_layer(dxf, "CAPTIONS", 7, false);
    dxf.add(0, "ENDTAB");
    dxf.add(0, "ENDSEC");
}

void add_polyline(Groups& dxf, const Stroke& stroke, const PageLayout& page)
{
    const std::string layer = layer_name(stroke.type, stroke.visible);
    dxf.add(0, "POLYLINE");
    dxf.add(8, layer);
    dxf.add(66, 1);
    dxf.point(dvec2(0));
    dxf.add(70, stroke.closed ? 1 : 0);
    for (const dvec2& p : stroke.points) {
        const dvec2 on_page = page.on_page(p);
        dxf.add(0, "VERTEX");
        dxf.add(8, layer);
        dxf.point(page.mm_per_unit * dvec2(on_page.x, page.height - on_page.y));
    }
    dxf.add(0, "SEQEND");
    dxf.add(8, layer);
}

void add_caption(Groups& dxf, const Caption& caption, const PageLayout& page)
{
    const dvec2 on_page = page.on_page(caption.position), place = page.mm_per_unit * dvec2(on_page.x, page.height - on_page.y);
    dxf.add(0, "TEXT");
    dxf.add(8, "CAPTIONS");
    dxf.point(place);
    dxf.add(40, page.mm_per_unit * page.scale * caption.height);
    dxf.add(1, caption.text);
    if (caption.angle != 0)
        dxf.add(50, glm::degrees(caption.angle));
    dxf.add(72, 1); // centred about the second point
    dxf.add(11, place.x);
    dxf.add(21, place.y);
    dxf.add(31, 0.0);
}

} // namespace

std::string to_dxf(const Drawing& drawing, const Style& style)
{
    const PageLayout page = lay_out(drawing, style);
    Groups dxf;
    add_header(dxf, page.mm_per_unit * dvec2(page.width, page.height));
    add_tables(dxf, drawing, style);
    dxf.add(0, "SECTION");
    dxf.add(2, "ENTITIES");
    for (const Stroke& stroke : drawing.strokes)
        if (stroke.points.size() >= 2)
            add_polyline(dxf, stroke, page);
    for (const Caption& caption : drawing.captions)
        add_caption(dxf, caption, page);
    dxf.add(0, "ENDSEC");
    dxf.add(0, "EOF");
    return std::move(dxf.text);
}

void write_dxf(const Drawing& drawing, const std::filesystem::path& path, const Style& style) { write_file(path, to_dxf(drawing, style)); }

} // namespace limn
