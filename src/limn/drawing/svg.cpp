#include "limn/drawing/svg.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/file.h"
#include "limn/drawing/png.h"

namespace limn {
namespace {

/// A number in its shortest form with at most `decimals` decimals and without exponent: "-.5", "12", "3.25".
std::string number(double value, int decimals)
{
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.')
            text.pop_back();
    }
    if (text == "-0")
        return "0";
    if (text.starts_with("0."))
        text.erase(0, 1);
    if (text.starts_with("-0."))
        text.erase(1, 1);
    return text;
}

/// Path data under construction. Coordinates are in hundredths of a page unit.
class PathData {
public:
    explicit PathData(std::string& out) : out_(out) {}

    void add(const Path& path)
    {
        command_ = 0;
        put('M', {path.start});
        command_ = 'L'; // what numbers after M mean
        for (std::size_t i = 0; i < path.spans.size(); ++i) {
            const CurveSpan& span = path.spans[i];
            if (path.closed && span.straight && i + 1 == path.spans.size())
                break; // Z draws it
            if (span.straight)
                put('L', {span.end});
            else
                put('C', {span.control1, span.control2, span.end});
        }
        if (path.closed)
            out_ += 'Z';
    }

private:
    void put(char command, std::initializer_list<dvec2> points)
    {
        if (command != command_) {
            out_ += command;
            command_ = command;
            separate_ = false;
        }
        for (const dvec2& p : points) {
            coordinate(p.x);
            coordinate(p.y);
        }
    }

    void coordinate(double value)
    {
        long long hundredths = std::llround(value * 100);
        if (hundredths < 0) {
            out_ += '-';
            hundredths = -hundredths;
        } else if (separate_) {
            out_ += ' ';
        }
        separate_ = true;
        const long long whole = hundredths / 100;
        const int rest = int(hundredths % 100);
        if (whole != 0 || rest == 0)
            fmt::format_to(std::back_inserter(out_), "{}", whole);
        if (rest != 0) {
            out_ += '.';
            out_ += char('0' + rest / 10);
            if (rest % 10 != 0)
                out_ += char('0' + rest % 10);
        }
    }

    std::string& out_;
    char command_ = 0;
    bool separate_ = false;
};

std::string hex_colour(const vec3& colour)
{
    const auto byte = [](float c) { return int(std::lround(std::clamp(c, 0.0f, 1.0f) * 255)); };
    const int r = byte(colour.r), g = byte(colour.g), b = byte(colour.b);
    if (r % 17 == 0 && g % 17 == 0 && b % 17 == 0)
        return fmt::format("#{:x}{:x}{:x}", r / 17, g / 17, b / 17);
    return fmt::format("#{:02x}{:02x}{:02x}", r, g, b);
}

std::string escaped(std::string_view text)
{
    std::string out;
    for (const char c : text) {
        switch (c) {
        case '&': out += "&amp;"; break;
        case '<': out += "&lt;"; break;
        case '>': out += "&gt;"; break;
        case '"': out += "&quot;"; break;
        default: out += c;
        }
    }
    return out;
}

std::string base64(std::string_view bytes)
{
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        const std::size_t have = std::min<std::size_t>(3, bytes.size() - i);
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < have ? std::uint8_t(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            out += k <= have ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

void add_background(std::string& svg, const Painting& painting)
{
    const PageLayout& page = painting.page;
    const Image& image = *painting.background;
    fmt::format_to(std::back_inserter(svg),
                   "<g id=\"background\" inkscape:groupmode=\"layer\" inkscape:label=\"Background\">\n<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" "
                   "preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64,{}\"/>\n</g>\n",
                   number(page.corner.x, 3), number(page.corner.y, 3), number(page.scale * image.width, 3), number(page.scale * image.height, 3),
                   base64(encode_png(image)));
}

void open_layer(std::string& svg, const Layer& layer)
{
    fmt::format_to(std::back_inserter(svg), "<g id=\"{}\" inkscape:groupmode=\"layer\" inkscape:label=\"{}\"", escaped(layer.id), escaped(layer.label));
    if (layer.width > 0)
        fmt::format_to(std::back_inserter(svg), " fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linecap=\"{}\" stroke-linejoin=\"round\"",
                       hex_colour(layer.colour), number(layer.width, 3), layer.dash > 0 ? "butt" : "round");
    else
        fmt::format_to(std::back_inserter(svg), " fill=\"{}\"{}", hex_colour(layer.colour), layer.even_odd ? " fill-rule=\"evenodd\"" : "");
    if (layer.dash > 0)
        fmt::format_to(std::back_inserter(svg), " stroke-dasharray=\"{} {}\"", number(layer.dash, 3), number(layer.gap, 3));
    if (layer.opacity < 1)
        fmt::format_to(std::back_inserter(svg), " opacity=\"{}\"", number(layer.opacity, 3));
    svg += ">\n";
}

void add_layer(std::string& svg, const Layer& layer)
{
    open_layer(svg, layer);
    bool butt = false; // pieces of fading strokes stand in a group of their own
    for (const Mark& mark : layer.marks) {
        if (mark.butt_caps != butt)
            svg += butt ? "</g>\n" : "<g stroke-linecap=\"butt\">\n";
        butt = mark.butt_caps;
        svg += "<path d=\"";
        PathData data(svg);
        for (const Path& path : mark.paths)
            data.add(path);
        svg += '"';
        if (mark.opacity < 1)
            fmt::format_to(std::back_inserter(svg), " opacity=\"{}\"", number(mark.opacity, 2));
        svg += "/>\n";
    }
    svg += butt ? "</g>\n</g>\n" : "</g>\n";
}

} // namespace

std::string to_svg(const Painting& painting)
{
    const PageLayout& page = painting.page;
    std::string svg = fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
                                  "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" width=\"{}mm\" height=\"{}mm\" viewBox=\"0 0 {} {}\">\n",
                                  number(page.width * page.mm_per_unit, 4), number(page.height * page.mm_per_unit, 4), number(page.width, 4), number(page.height, 4));
    if (painting.paper != vec3(1))
        svg += fmt::format("<rect id=\"paper\" width=\"100%\" height=\"100%\" fill=\"{}\"/>\n", hex_colour(painting.paper));
    if (painting.background)
        add_background(svg, painting);
    for (const Layer& layer : painting.layers)
        add_layer(svg, layer);
    return svg + "</svg>\n";
}

std::string to_svg(const Drawing& drawing, const Style& style) { return to_svg(compose(drawing, style)); }

void write_svg(const Drawing& drawing, const std::filesystem::path& path, const Style& style) { write_file(path, to_svg(drawing, style)); }

} // namespace limn
