#include "limn/drawing/json.h"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "limn/base/file.h"

namespace limn {
namespace {

/// Appends "[" items "]", each written by `write(item)`.
template <class Items, class Write> void add_array(std::string& json, const Items& items, Write&& write)
{
    json += '[';
    bool first = true;
    for (const auto& item : items) {
        if (!first)
            json += ',';
        first = false;
        write(item);
    }
    json += ']';
}

void add_pixel(std::string& json, const dvec2& p)
{
    fmt::format_to(std::back_inserter(json), "[{},{}]", std::round(p.x * 1e4) / 1e4, std::round(p.y * 1e4) / 1e4);
}

std::string text_literal(std::string_view text)
{
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            out += '\\';
        if (static_cast<unsigned char>(c) < 0x20)
            out += fmt::format("\\u{:04x}", int(c));
        else
            out += c;
    }
    return out + '"';
}

void add_stroke(std::string& json, const Stroke& stroke)
{
    const auto to = std::back_inserter(json);
    fmt::format_to(to, "{{\"type\":\"{}\",\"visible\":{},\"closed\":{},\"object\":{},\"points\":", line_type_name(stroke.type), stroke.visible, stroke.closed,
                   stroke.object);
    add_array(json, stroke.points, [&](const dvec2& p) { add_pixel(json, p); });
    json += ",\"world\":";
    add_array(json, stroke.world, [&](const dvec3& p) { fmt::format_to(to, "[{},{},{}]", p.x, p.y, p.z); });
    json += ",\"ink\":";
    add_array(json, stroke.ink, [&](float ink) { fmt::format_to(to, "{}", std::round(double(ink) * 1e4) / 1e4); });
    json += ",\"faces\":";
    add_array(json, stroke.faces, [&](std::uint32_t face) { fmt::format_to(to, "{}", face == none ? "null" : fmt::to_string(face)); });
    json += '}';
}

void add_region(std::string& json, const Region& region)
{
    fmt::format_to(std::back_inserter(json), "{{\"name\":{},\"colour\":[{},{},{}],\"rings\":", text_literal(region.name), region.colour.r, region.colour.g, region.colour.b);
    add_array(json, region.rings, [&](const std::vector<dvec2>& ring) { add_array(json, ring, [&](const dvec2& p) { add_pixel(json, p); }); });
    json += '}';
}

void add_caption(std::string& json, const Caption& caption)
{
    fmt::format_to(std::back_inserter(json), "{{\"text\":{},\"height\":{},\"position\":", text_literal(caption.text), caption.height);
    add_pixel(json, caption.position);
    if (caption.angle != 0)
        fmt::format_to(std::back_inserter(json), ",\"angle\":{}", caption.angle);
    json += '}';
}

} // namespace

std::string to_json(const Drawing& drawing)
{
    std::string json = "{\"camera\":" + camera_to_json(drawing.camera);
    if (drawing.mm_per_pixel > 0)
        json += fmt::format(",\n\"mm_per_pixel\":{}", drawing.mm_per_pixel);
    json += ",\n\"strokes\":";
    add_array(json, drawing.strokes, [&](const Stroke& stroke) {
        json += '\n';
        add_stroke(json, stroke);
    });
    json += ",\n\"regions\":";
    add_array(json, drawing.regions, [&](const Region& region) {
        json += '\n';
        add_region(json, region);
    });
    if (!drawing.captions.empty()) {
        json += ",\n\"captions\":";
        add_array(json, drawing.captions, [&](const Caption& caption) { add_caption(json, caption); });
    }
    return json + "}\n";
}

void write_json(const Drawing& drawing, const std::filesystem::path& path) { write_file(path, to_json(drawing)); }

} // namespace limn
