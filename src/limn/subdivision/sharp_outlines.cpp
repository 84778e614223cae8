#include "limn/subdivision/sharp_outlines.h"

#include <algorithm>

#include "limn/base/parallel.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1024;

} // namespace

SharpOutlines::SharpOutlines(const SeedSurface& surface, const SeedCrossings& found, int pieces, std::uint32_t first_vertex)
    : s_(surface), found_(found), rows_(std::uint32_t(2) << surface.levels), pieces_(std::min(std::uint32_t(pieces), rows_)), begin_(first_vertex),
      end_(first_vertex), first_(surface.sharp.size(), none)
{
    for (std::size_t k = 0; k < s_.sharp.size(); ++k)
        if (may_be_outline(s_.sharp[k])) {
            first_[k] = end_;
            end_ += pieces_ - 1;
        }
}

bool SharpOutlines::may_be_outline(std::uint32_t e) const
{
    if (s_.topology.is_border(e))
        return true;
    int facing = 0;
    each_side(e, [&](std::uint32_t side) { facing += found_.facing[s_.ends[side][0]] + found_.facing[s_.ends[side][1]]; });
    return facing != 0 && facing != 4;
}

std::uint32_t SharpOutlines::count(std::uint32_t e) const
{
    std::uint32_t points = pieces_ - 1;
    each_side(e, [&](std::uint32_t side) { points += found_.of(side) != none; });
    return points;
}

void SharpOutlines::gather(std::uint32_t e, std::uint32_t first_crossing, std::vector<Mark>& marks) const
{
    marks.clear();
    const std::uint32_t first = first_[s_.sharp_number[e]];
    for (std::uint32_t i = 1; i < pieces_; ++i)
        marks.push_back({double(row(i)) / rows_, first + i - 1, row(i)});
    each_side(e, [&](std::uint32_t side) {
        if (const std::uint32_t number = found_.of(side); number != none)
            marks.push_back({found_.crossings[number].along, first_crossing + number, none});
    });
    std::sort(marks.begin(), marks.end());
}

EdgePoint SharpOutlines::point(std::uint32_t e, std::uint32_t row, bool right, std::span<const dvec3> fine) const
{
    const bool second = row > rows_ / 2; // half, which runs the other way
    return s_.halves.point(2 * e + second, second ? rows_ - row : row, right != second ? EdgeTable::right : EdgeTable::left, fine);
}

void SharpOutlines::set_positions(std::span<const dvec3> fine, std::vector<dvec3>& positions) const
{
    parallel_each(first_.size(), grain, [&](std::size_t k) {
        for (std::uint32_t i = 1; first_[k] != none && i < pieces_; ++i)
            positions[first_[k] + i - 1] = point(s_.sharp[k], row(i), false, fine).position;
    });
}

} // namespace limn
