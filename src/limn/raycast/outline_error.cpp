#include "limn/raycast/outline_error.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/raycast/nearest_sample.h"
#include "limn/raycast/triangle_rows.h"

namespace limn {
namespace {

constexpr std::uint64_t every_bit = ~std::uint64_t(0);

/// Sets samples first to last.
void cover(std::uint64_t* row, int first, int last)
{
    const std::uint64_t from = every_bit << (first % 64), to = every_bit >> (63 - last % 64);
    const int begin = first / 64, end = last / 64;
    if (begin == end) {
        row[begin] |= from & to;
        return;
    }
    row[begin] |= from;
    std::fill(row + begin + 1, row + end, every_bit);
    row[end] |= to;
}

/// Sets the samples that a line runs through, one for each column or row, whichever it crosses more of.
void cover_line(OutlineMask& mask, dvec2 a, dvec2 b)
{
    const dvec2 d = glm::abs(b - a);
    const int along = d.x >= d.y ? 0 : 1, across = 1 - along;
    if (a[along] > b[along])
        std::swap(a, b);
    if (!(b[along] >= 0 && a[along] <= mask.size[along]))
        return;
    const double slope = d[along] > 0 ? (b[across] - a[across]) / (b[along] - a[along]) : 0;
    const int first = int(std::max(0.0, std::ceil(a[along] - 0.5))), last = int(std::min(double(mask.size[along] - 1), std::floor(b[along] - 0.5)));
    for (int i = first; i <= last; ++i) {
        const double place = std::floor(a[across] + slope * (i + 0.5 - a[along]));
        if (!(place >= 0 && place < mask.size[across]))
            continue;
        const int x = along == 0 ? i : int(place), y = along == 0 ? int(place) : i;
        mask.bits[std::size_t(y) * mask.words_per_row() + std::size_t(x) / 64] |= std::uint64_t(1) << (x % 64);
    }
}

bool is_front(const std::array<dvec2, 3>& p) // y runs down
{
    const dvec2 a = p[1] - p[0], b = p[2] - p[0];
    return a.x * b.y - a.y * b.x < 0;
}

/// The covered samples whose four neighbours within the picture are covered, too.
OutlineMask inner(const OutlineMask& mask)
{
    OutlineMask out = mask;
    const std::size_t words = mask.words_per_row();
    const int last_bit = (mask.size.x - 1) % 64;
    for (int y = 0; y < mask.size.y; ++y) {
        const std::uint64_t* row = &mask.bits[std::size_t(y) * words];
        const std::uint64_t *above = y > 0 ? row - words : row, *below = y + 1 < mask.size.y ? row + words : row;
        for (std::size_t i = 0; i < words; ++i) {
            const bool first = i == 0, last = i + 1 == words;
            const std::uint64_t from_left = row[i] << 1 | (first ? row[i] & 1 : row[i - 1] >> 63);
            const std::uint64_t from_right = last ? row[i] >> 1 | (row[i] & std::uint64_t(1) << last_bit) : row[i] >> 1 | row[i + 1] << 63;
            out.bits[std::size_t(y) * words + i] &= above[i] & below[i] & from_left & from_right;
        }
    }
    return out;
}

template <class F> void for_each_covered(const std::vector<std::uint64_t>& bits, std::size_t words, F&& f)
{
    for (std::size_t i = 0; i < bits.size(); ++i)
        for (std::uint64_t word = bits[i]; word != 0; word &= word - 1)
            f(ivec2(int(i % words) * 64 + std::countr_zero(word), int(i / words)));
}

std::vector<ivec2> outline_of(const OutlineMask& mask)
{
    OutlineMask border = inner(mask);
    for (std::size_t i = 0; i < border.bits.size(); ++i)
        border.bits[i] ^= mask.bits[i];
    std::vector<ivec2> samples;
    for_each_covered(border.bits, mask.words_per_row(), [&](const ivec2& p) { samples.push_back(p); });
    return samples;
}

double greatest_distance(const std::vector<ivec2>& from, const std::vector<ivec2>& to, const ivec2& size)
{
    const NearestSample nearest(to, size);
    double greatest = 0;
    for (const ivec2& p : from)
        greatest = std::max(greatest, nearest.distance(p));
    return greatest;
}

void check_sizes(const OutlineMask& found, const OutlineMask& wanted)
{
    if (found.size != wanted.size || found.per_pixel != wanted.per_pixel)
        throw Error::Input(fmt::format("a mask of {} x {} samples, {} along a pixel, is not compared with one of {} x {}, {} along a pixel", found.size.x, found.size.y,
                                       found.per_pixel, wanted.size.x, wanted.size.y, wanted.per_pixel));
}

} // namespace

std::size_t OutlineMask::covered() const
{
    std::size_t count = 0;
    for (const std::uint64_t word : bits)
        count += std::size_t(std::popcount(word));
    return count;
}

OutlineMask outline_mask(const Mesh& mesh, const Camera& camera, int per_pixel, MaskFaces faces)
{
    OutlineMask mask{camera.size * per_pixel, per_pixel, {}};
    const std::size_t words = mask.words_per_row();
    mask.bits.assign(words * std::size_t(mask.size.y), 0);
    std::vector<dvec2> places(mesh.positions.size());
    std::vector<std::uint8_t> seen(mesh.positions.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Projected p = camera.project(mesh.positions[i]);
        places[i] = double(per_pixel) * p.pixel;
        seen[i] = camera.orthographic || p.depth > 0;
    }
    for (const uvec3& t : mesh.triangles) {
        if (!seen[t.x] || !seen[t.y] || !seen[t.z])
            continue;
        const std::array<dvec2, 3> corners = {places[t.x], places[t.y], places[t.z]};
        if (faces == MaskFaces::front && !is_front(corners))
            continue;
        for_each_row(corners, mask.size, [&](int y, int first, int last) { cover(&mask.bits[std::size_t(y) * words], first, last); });
        if (faces == MaskFaces::all)
            for (std::size_t k = 0; k < 3; ++k)
                cover_line(mask, corners[k], corners[(k + 1) % 3]);
    }
    return mask;
}

OutlineMask eroded(const OutlineMask& mask, int steps)
{
    OutlineMask out = mask;
    for (int i = 0; i < steps; ++i)
        out = inner(out);
    return out;
}

OutlineError compare_outlines(const OutlineMask& found, const OutlineMask& wanted)
{
    check_sizes(found, wanted);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < found.bits.size(); ++i)
        differing += std::size_t(std::popcount(found.bits[i] ^ wanted.bits[i]));
    const std::vector<ivec2> of_found = outline_of(found), of_wanted = outline_of(wanted);
    const double n = found.per_pixel;
    OutlineError error;
    error.difference = double(differing) / (n * n);
    error.length = double(of_wanted.size()) / n;
    error.beyond = greatest_distance(of_found, of_wanted, found.size) / n;
    error.short_of = greatest_distance(of_wanted, of_found, found.size) / n;
    return error;
}

double area_distance(const OutlineMask& found, const OutlineMask& wanted)
{
    check_sizes(found, wanted);
    double greatest = 0;
    for (const auto& [from, to] : {std::pair(&found, &wanted), std::pair(&wanted, &found)}) {
        std::vector<std::uint64_t> only = from->bits;
        for (std::size_t i = 0; i < only.size(); ++i)
            only[i] &= ~to->bits[i];
        std::vector<ivec2> samples;
        for_each_covered(only, from->words_per_row(), [&](const ivec2& p) { samples.push_back(p); });
        greatest = std::max(greatest, greatest_distance(samples, outline_of(*to), from->size));
    }
    return greatest / found.per_pixel;
}

double uncovered(const OutlineMask& found, const OutlineMask& wanted)
{
    check_sizes(found, wanted);
    std::size_t count = 0;
    for (std::size_t i = 0; i < found.bits.size(); ++i)
        count += std::size_t(std::popcount(wanted.bits[i] & ~found.bits[i]));
    return double(count) / (double(found.per_pixel) * double(found.per_pixel));
}

} // namespace limn
