#include "limn/terrain/iso_lines.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"

namespace limn {
namespace {

constexpr long long most_levels = 10000;

/// An edge between two neighbouring samples: twice the index of its north-western one, and 1 more where it runs south.
using EdgeId = std::size_t;
EdgeId edge_east(const HeightMap& map, int column, int row) { return 2 * map.index(column, row); }
EdgeId edge_south(const HeightMap& map, int column, int row) { return 2 * map.index(column, row) + 1; }

/// Where a line crosses a cell.
struct Piece {
    EdgeId from, to;
};

/// Least and greatest heights of the rows' samples.
struct RowRange {
    float low, high;
};

std::vector<RowRange> row_ranges(const HeightMap& map)
{
    std::vector<RowRange> ranges(std::size_t(map.rows));
    parallel_each(ranges.size(), 64, [&](std::size_t row) {
        RowRange range = {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
        for (int column = 0; column < map.columns; ++column) // comparisons with NaN are false
            if (const float h = map.height(column, int(row)); h == h)
                range = {std::min(range.low, h), std::max(range.high, h)};
        ranges[row] = range;
    });
    return ranges;
}

class LevelLines {
public:
    LevelLines(const HeightMap& map, std::span<const RowRange> ranges, double level, std::size_t number) : map_(map), level_(level), number_(number)
    {
        for (int row = 0; row + 1 < map.rows; ++row) {
            const RowRange &north = ranges[std::size_t(row)], &south = ranges[std::size_t(row) + 1];
            if (double(std::max(north.high, south.high)) >= level && double(std::min(north.low, south.low)) < level)
                for (int column = 0; column + 1 < map.columns; ++column)
                    add_cell(column, row);
        }
    }
    std::vector<IsoLine> lines()
    {
        // Each edge is where at most one piece starts, and where at most one ends.
        std::vector<std::size_t> by_start(pieces_.size());
        for (std::size_t i = 0; i < by_start.size(); ++i)
            by_start[i] = i;
        std::sort(by_start.begin(), by_start.end(), [&](std::size_t i, std::size_t j) { return pieces_[i].from < pieces_[j].from; });
        std::vector<std::size_t> next(pieces_.size(), nothing);
        std::vector<bool> is_start(pieces_.size(), true);
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
            const auto found = std::lower_bound(by_start.begin(), by_start.end(), pieces_[i].to, [&](std::size_t j, EdgeId id) { return pieces_[j].from < id; });
            if (found != by_start.end() && pieces_[*found].from == pieces_[i].to)
                next[i] = *found, is_start[*found] = false;
        }
        std::vector<IsoLine> lines;
        std::vector<bool> used(pieces_.size(), false);
        for (const bool open : {true, false})
            for (std::size_t i = 0; i < pieces_.size(); ++i)
                if (!used[i] && (!open || is_start[i]))
                    add_line(i, !open, next, used, lines);
        return lines;
    }

private:
    static constexpr std::size_t nothing = std::size_t(-1);

    bool is_high(int column, int row) const { return double(map_.height(column, row)) >= level_; }

    void add_cell(int column, int row)
    {
        // Counter-clockwise from the south-west, each corner with the edge after it.
        const std::array<ivec2, 4> corners = {ivec2(column, row + 1), {column + 1, row + 1}, {column + 1, row}, {column, row}};
        std::array<bool, 4> high;
        int count = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            if (!map_.has_data(corners[k].x, corners[k].y))
                return;
            high[k] = is_high(corners[k].x, corners[k].y);
            count += high[k];
        }
        if (count == 0 || count == 4)
            return;
        const std::array<EdgeId, 4> edges = {edge_east(map_, column, row + 1), edge_south(map_, column + 1, row), edge_east(map_, column, row), edge_south(map_, column, row)};
        const bool saddle = count == 2 && high[0] == high[2];
        // With the higher ground on its left a line starts where the border goes down; it ends where that rises next, around the low corner
        // between them, or in a saddle whose middle is low where it rose last, around the high one.
        const bool backwards = saddle && !is_middle_high(corners);
        for (std::size_t k = 0; k < 4; ++k) {
            if (!high[k] || high[(k + 1) % 4])
                continue;
            std::size_t end = k;
            do
                end = (end + (backwards ? 3 : 1)) % 4;
            while (high[end] || !high[(end + 1) % 4]);
            pieces_.push_back({edges[k], edges[end]});
        }
    }
    bool is_middle_high(const std::array<ivec2, 4>& corners) const
    {
        double sum = 0;
        for (const ivec2& c : corners)
            sum += double(map_.height(c.x, c.y)) - level_;
        return sum >= 0;
    }
    dvec3 point_on(EdgeId edge) const
    {
        const int column = int(edge / 2 % std::size_t(map_.columns)), row = int(edge / 2 / std::size_t(map_.columns));
        const bool south = edge % 2 == 1;
        const dvec3 a = map_.position(column, row), b = map_.position(column + (south ? 0 : 1), row + (south ? 1 : 0));
        const double t = (level_ - a.z) / (b.z - a.z); // one is below the level and one is not
        return {dvec2(a) + t * dvec2(b - a), level_};
    }
    void add_line(std::size_t piece, bool closed, std::span<const std::size_t> next, std::vector<bool>& used, std::vector<IsoLine>& lines) const
    {
        IsoLine line = {number_, closed, {}};
        const auto add = [&](const dvec3& p) {
            if (line.points.empty() || line.points.back() != p)
                line.points.push_back(p);
        };
        add(point_on(pieces_[piece].from));
        for (std::size_t i = piece; i != nothing && !used[i]; i = next[i]) {
            used[i] = true;
            add(point_on(pieces_[i].to));
        }
        while (closed && line.points.size() > 1 && line.points.back() == line.points.front())
            line.points.pop_back();
        if (line.points.size() >= (closed ? 3u : 2u))
            lines.push_back(std::move(line));
    }

    const HeightMap& map_;
    double level_;
    std::size_t number_;
    std::vector<Piece> pieces_;
};

} // namespace

std::vector<IsoLine> iso_lines(const HeightMap& map, std::span<const double> levels)
{
    const std::vector<RowRange> ranges = row_ranges(map);
    return parallel_collect<IsoLine>(levels.size(), 1, [&](std::size_t begin, std::size_t end, std::vector<IsoLine>& out) {
        for (std::size_t i = begin; i < end; ++i) {
            std::vector<IsoLine> lines = LevelLines(map, ranges, levels[i], i).lines();
            std::move(lines.begin(), lines.end(), std::back_inserter(out));
        }
    });
}

IsoFactors iso_factors(const HeightMap& map, double step)
{
    if (!(step > 0 && std::isfinite(step)))
        throw Error::Input(fmt::format("iso lines every {} m: the step has to be above 0", step));
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (const float h : map.heights)
        if (h == h)
            low = std::min(low, h), high = std::max(high, h);
    if (!(low <= high))
        return {};
    const double first = std::ceil(double(low) / step), last = std::floor(double(high) / step);
    if (!(last - first < double(most_levels)))
        throw Error::Input(fmt::format("iso lines every {} m are {:.0f} levels on this map; at most {} can be", step, last - first + 1, most_levels));
    return {(long long)first, (long long)last + 1};
}

} // namespace limn
