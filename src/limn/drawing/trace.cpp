#include "limn/drawing/trace.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "limn/drawing/simplify.h"

namespace limn {
namespace {

/// A side between two neighbouring samples; a ring crosses it at most once.
using Side = std::uint64_t;

/// The sides of a cell of four samples, clockwise on the screen.
enum CellSide : std::uint8_t { top, right, bottom, left };
struct Crossing {
    CellSide from, to;
};

/// How a ring with its inside on the right crosses a cell. Bits of `inside`: top left 1, top right 2, bottom right 4, bottom left 8.
std::span<const Crossing> crossings(unsigned inside, bool centre_inside)
{
    static constexpr std::array<std::array<Crossing, 2>, 16> table = {{
        {}, {{{top, left}}}, {{{right, top}}}, {{{right, left}}}, {{{bottom, right}}}, {{{top, left}, {bottom, right}}}, {{{bottom, top}}},
        {{{bottom, left}}}, {{{left, bottom}}}, {{{top, bottom}}}, {{{right, top}, {left, bottom}}}, {{{right, bottom}}}, {{{left, right}}},
        {{{top, right}}}, {{{left, top}}}, {}}};
    static constexpr std::array<Crossing, 2> joined_falling = {{{top, right}, {bottom, left}}}, joined_rising = {{{left, top}, {right, bottom}}};
    if (inside == 5 && centre_inside)
        return joined_falling;
    if (inside == 10 && centre_inside)
        return joined_rising;
    const std::size_t count = inside == 0 || inside == 15 ? 0 : inside == 5 || inside == 10 ? 2 : 1;
    return {table[inside].data(), count};
}

/// The samples of a picture with a frame of one outside sample around it.
class FramedField {
public:
    FramedField(const Image& field, float level) : field_(field), level_(level) {}

    bool inside(int x, int y) const { return in_picture(x, y) && *field_.at(x, y) >= level_; }
    float mean_of_cell(int x, int y) const
    {
        return (value_or_level(x, y) + value_or_level(x + 1, y) + value_or_level(x, y + 1) + value_or_level(x + 1, y + 1)) / 4;
    }
    Side side(int x, int y, CellSide which) const
    {
        const bool vertical = which == left || which == right;
        const std::uint64_t column = std::uint64_t(x + 1 + (which == right)), row = std::uint64_t(y + 1 + (which == bottom));
        return (row * std::uint64_t(field_.width + 2) + column) * 2 + vertical;
    }
    /// Where the level is crossed on a side: pixels.
    dvec2 crossing(Side side) const
    {
        const std::uint64_t sample = side / 2, width = std::uint64_t(field_.width + 2);
        const int x = int(sample % width) - 1, y = int(sample / width) - 1;
        const int x2 = side % 2 ? x : x + 1, y2 = side % 2 ? y + 1 : y;
        double t = 0.5; // the border of the picture
        if (in_picture(x, y) && in_picture(x2, y2)) {
            const double a = double(*field_.at(x, y)), b = double(*field_.at(x2, y2));
            t = (double(level_) - a) / (b - a);
        }
        return {x + 0.5 + t * (x2 - x), y + 0.5 + t * (y2 - y)};
    }

private:
    bool in_picture(int x, int y) const { return x >= 0 && y >= 0 && x < field_.width && y < field_.height; }
    float value_or_level(int x, int y) const { return in_picture(x, y) ? *field_.at(x, y) : level_ - 1; }
    const Image& field_;
    float level_;
};

struct Link {
    Side from, to;
};

/// All pieces of rings in the order of their cells.
std::vector<Link> find_links(const Image& picture, const FramedField& field, float level)
{
    std::vector<Link> links;
    for (int y = -1; y < picture.height; ++y)
        for (int x = -1; x < picture.width; ++x) {
            const unsigned inside = unsigned(field.inside(x, y)) | unsigned(field.inside(x + 1, y)) << 1
                                  | unsigned(field.inside(x + 1, y + 1)) << 2 | unsigned(field.inside(x, y + 1)) << 3;
            if (inside == 0 || inside == 15)
                continue;
            for (const Crossing& c : crossings(inside, field.mean_of_cell(x, y) >= level))
                links.push_back({field.side(x, y, c.from), field.side(x, y, c.to)});
        }
    return links;
}

/// The rings as lists of sides, each begun at its first link.
std::vector<std::vector<Side>> walk(const std::vector<Link>& links)
{
    std::vector<std::pair<Side, std::size_t>> by_from;
    by_from.reserve(links.size());
    for (std::size_t i = 0; i < links.size(); ++i)
        by_from.push_back({links[i].from, i});
    std::sort(by_from.begin(), by_from.end());
    auto next = [&](std::size_t link) {
        return std::lower_bound(by_from.begin(), by_from.end(), std::pair(links[link].to, std::size_t(0)))->second;
    };
    std::vector<std::vector<Side>> rings;
    std::vector<char> used(links.size(), 0);
    for (std::size_t first = 0; first < links.size(); ++first) {
        if (used[first])
            continue;
        std::vector<Side>& ring = rings.emplace_back();
        for (std::size_t link = first; !used[link]; link = next(link)) {
            used[link] = 1;
            ring.push_back(links[link].from);
        }
    }
    return rings;
}

double ring_area(const std::vector<dvec2>& ring)
{
    double sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const dvec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
        sum += a.x * b.y - b.x * a.y;
    }
    return sum / 2;
}

} // namespace

std::vector<std::vector<dvec2>> trace_rings(const Image& field, float level, double tolerance)
{
    const FramedField framed(field, level);
    std::vector<std::vector<dvec2>> rings;
    for (const std::vector<Side>& sides : walk(find_links(field, framed, level))) {
        std::vector<dvec2> points;
        for (const Side side : sides) {
            const dvec2 p = framed.crossing(side);
            if (points.empty() || (p != points.back() && p != points.front()))
                points.push_back(p);
        }
        if (points.size() >= 3)
            rings.push_back(simplified_ring(points, tolerance));
    }
    return rings;
}

std::vector<dvec2> simplified_ring(const std::vector<dvec2>& ring, double tolerance)
{
    if (tolerance == 0)
        return ring;
    SimplifyOptions options;
    options.tolerance = tolerance;
    std::vector<dvec2> kept;
    for (const std::uint32_t i : simplified_points(ring, {}, true, options))
        kept.push_back(ring[i]);
    return kept;
}

double rings_area(const std::vector<std::vector<dvec2>>& rings)
{
    double sum = 0;
    for (const std::vector<dvec2>& ring : rings)
        sum += ring_area(ring);
    return sum;
}

} // namespace limn
