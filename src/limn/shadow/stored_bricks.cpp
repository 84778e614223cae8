#include "limn/shadow/stored_bricks.h"

#include <algorithm>
#include <array>
#include <bit>

#include <fmt/format.h>

#include "limn/base/error.h"

// Nearly all of a look-up is counting bits, for which x86-64's base set has no instruction: the best of two versions is chosen at run time. (Clang
// wants to know of versions before the first call, which is in the class.)
#if defined(__x86_64__) && defined(__ELF__) && !defined(__clang__)
#define LIMN_COUNTS_BITS __attribute__((target_clones("popcnt", "default")))
#else
#define LIMN_COUNTS_BITS
#endif

namespace limn {
namespace {

inline std::uint32_t way_to(std::uint32_t order, const ivec2& texel, const ivec2& cell)
{
    const auto& ways = brick_ways[order];
    return std::uint32_t(ways[0][std::size_t(texel.x)] | ways[1][std::size_t(texel.y)] | ways[2][std::size_t(cell.x)] | ways[3][std::size_t(cell.y)]);
}

/// Where the parts of a brick begin, in bits.
struct BrickParts {
    explicit BrickParts(const BrickHeader& header)
        : values(header.bits()), outline(values + header.value_bits()), outline_leaves(outline + 2 * header.outline_nodes),
          depths(outline_leaves + (header.outline_nodes > 0 ? header.outline_nodes + 1 : 0)), depth_leaves(depths + 2 * header.depth_nodes)
    {
    }
    std::size_t values, outline, outline_leaves, depths, depth_leaves;
};

inline bool is_surface(const unsigned char* bytes, const BrickHeader& header, const BrickParts& parts, const ivec2& texel, const ivec2& cell)
{
    if (header.outline_nodes == 0)
        return true;
    const BrickLeaf leaf = brick_leaf(bytes, parts.outline, header.outline_nodes, way_to(header.outline_order, texel, cell));
    const std::size_t at = parts.outline_leaves + (leaf.last ? leaf.above + leaf.node : leaf.number);
    const bool bit = bytes[at / 8] >> at % 8 & 1;
    return leaf.last && leaf.second ? !bit : bit;
}

inline std::uint32_t value_number(const unsigned char* bytes, const BrickHeader& header, const BrickParts& parts, const ivec2& texel, const ivec2& cell)
{
    if (header.depth_nodes == 0)
        return 0;
    const BrickLeaf leaf = brick_leaf(bytes, parts.depths, header.depth_nodes, way_to(header.depth_order, texel, cell));
    const std::uint32_t count = header.value_count(), width = std::uint32_t(std::bit_width(count - 1));
    if (width == 1) {
        const std::size_t at = parts.depth_leaves + (leaf.last ? leaf.above + leaf.node : leaf.number);
        const bool bit = bytes[at / 8] >> at % 8 & 1;
        return leaf.last && leaf.second ? !bit : bit;
    }
    const std::uint32_t number = leaf.last ? leaf.above + 2 * leaf.node + (leaf.second ? 1 : 0) : leaf.number;
    const auto value = std::uint32_t(bits_at(bytes, parts.depth_leaves + std::size_t(number) * width)) & ((1u << width) - 1);
    return std::min(value, count - 1); // a damaged file must not lead outside
}

inline float value_at(const unsigned char* bytes, const BrickHeader& header, const BrickParts& parts, std::uint32_t number)
{
    std::size_t at = parts.values;
    std::uint32_t width = 8;
    for (std::size_t kind = 0; kind < 2 && number >= header.values[kind]; ++kind) {
        at += header.values[kind] * width;
        number -= header.values[kind];
        width = kind == 0 ? 12 : 20;
    }
    const auto value = std::uint32_t(bits_at(bytes, at + std::size_t(number) * width)) & ((1u << width) - 1);
    return float(value << (depth_bits - int(width))) * depth_step;
}

inline float brick_depth(const unsigned char* bytes, const ivec2& texel, const ivec2& cell)
{
    const BrickHeader header = brick_header(bits_at(bytes, 0));
    const BrickParts parts(header);
    if (!is_surface(bytes, header, parts, texel, cell))
        return no_surface;
    return value_at(bytes, header, parts, value_number(bytes, header, parts, texel, cell));
}

/// Whether the bits of a tree are those of one with so many inner nodes above the last level, as far as a look-up relies on that.
bool is_tree(const unsigned char* bytes, std::size_t start, std::uint32_t nodes, std::uint32_t& leaves)
{
    std::uint32_t ones = 0;
    for (std::size_t bit = start; bit < start + 2 * nodes; ++bit)
        ones += bytes[bit / 8] >> bit % 8 & 1;
    leaves = ones + 2;
    return ones + 1 >= nodes;
}

/// Whether all that a look-up can read of a brick is within some bytes.
bool is_brick(const unsigned char* bytes, std::size_t size)
{
    const BrickHeader header = brick_header(bits_at(bytes, 0));
    const BrickParts parts(header);
    const std::uint32_t count = header.value_count();
    if (count < 1 || count > brick_elements || (header.depth_nodes > 0 && count < 2) || (parts.depth_leaves + 7) / 8 > size)
        return false;
    std::uint32_t leaves = 0;
    if (header.outline_nodes > 0 && !is_tree(bytes, parts.outline, header.outline_nodes, leaves))
        return false;
    if (header.depth_nodes == 0)
        return true;
    if (!is_tree(bytes, parts.depths, header.depth_nodes, leaves))
        return false;
    const std::size_t width = std::size_t(std::bit_width(count - 1));
    return (parts.depth_leaves + width * (width == 1 ? header.depth_nodes + 1 : leaves) + 7) / 8 <= size;
}

inline std::uint32_t offset_at(const unsigned char* table, int number)
{
    std::uint16_t offset;
    std::memcpy(&offset, table + std::size_t(number) * sizeof offset, sizeof offset);
    return offset;
}

} // namespace

StoredBricks::StoredBricks(std::string_view bytes, int size, const ivec2& cells, const std::string& name)
    : size_(std::uint32_t(size)), cells_(std::uint32_t(cells.x)), layout_(size, cells)
{
    const std::size_t table = layout_.group_count() * sizeof(BrickGroup);
    if (bytes.size() < table + bits_slack)
        throw Error::Read(fmt::format("{}: its bricks are damaged: {} bytes, and the table of {} groups alone {}", name, bytes.size(), layout_.group_count(), table));
    groups_ = reinterpret_cast<const BrickGroup*>(bytes.data());
    data_ = reinterpret_cast<const unsigned char*>(bytes.data()) + table;
    data_bytes_ = bytes.size() - table - bits_slack;
    check(name);
}

/// Every brick lies in the file, so that no look-up leads outside.
void StoredBricks::check(const std::string& name) const
{
    for (std::size_t g = 0; g < layout_.group_count(); ++g) {
        const BrickGroup& group = groups_[g];
        const std::size_t place = std::size_t(group.place & ~coarse_offsets) * 4, unit = group.place & coarse_offsets ? 4 : 1;
        const auto generals = std::size_t(std::popcount(group.general)), constants = std::size_t(std::popcount(group.filled & ~group.general));
        bool fits = (group.general & ~group.filled) == 0 && place + 2 * generals + constants <= data_bytes_;
        for (std::size_t i = 0; fits && i < generals; ++i) {
            const std::size_t at = place + offset_at(data_ + place, int(i)) * unit;
            fits = at < data_bytes_ && is_brick(data_ + at, data_bytes_ - at);
        }
        if (!fits)
            throw Error::Read(fmt::format("{}: its bricks are damaged: those of group {}", name, g));
    }
}

StoredBricks::Element StoredBricks::element(const ivec2& texel, const ivec2& cell) const
{
    const std::uint32_t brick = std::uint32_t(texel.y) / brick_texels * layout_.columns + std::uint32_t(texel.x) / brick_texels;
    const std::size_t block = std::size_t(std::uint32_t(cell.y) / brick_t) * layout_.blocks_s + std::uint32_t(cell.x) / brick_s;
    return {block * layout_.groups + brick / bricks_together, brick % bricks_together, {texel.x % brick_texels, texel.y % brick_texels},
            {cell.x % brick_s, cell.y % brick_t}};
}

StoredBricks::Found StoredBricks::find(const Element& element) const
{
    const BrickGroup& group = groups_[element.group];
    const std::uint32_t bit = std::uint32_t(1) << element.brick;
    if (!(group.filled & bit))
        return {nullptr, no_surface};
    const unsigned char* data = group_data(group);
    const std::uint32_t before = bit - 1;
    if (!(group.general & bit)) {
        const int number = std::popcount(group.filled & ~group.general & before);
        return {nullptr, float(data[std::size_t(2 * std::popcount(group.general) + number)]) * (1.0f / 256)};
    }
    return {data + std::size_t(offset_at(data, std::popcount(group.general & before))) * (group.place & coarse_offsets ? 4 : 1)};
}

LIMN_COUNTS_BITS float StoredBricks::depth(const ivec2& texel, const ivec2& cell) const
{
    const Element at = element(texel, cell);
    const Found brick = find(at);
    return brick.bytes ? brick_depth(brick.bytes, at.texel, at.cell) : brick.depth;
}

LIMN_COUNTS_BITS bool StoredBricks::hit(const ivec2& texel, const ivec2& cell) const
{
    const Element at = element(texel, cell);
    const Found brick = find(at);
    if (!brick.bytes)
        return brick.depth != no_surface;
    const BrickHeader header = brick_header(bits_at(brick.bytes, 0));
    return is_surface(brick.bytes, header, BrickParts(header), at.texel, at.cell);
}

LIMN_COUNTS_BITS void StoredBricks::depths(std::span<const MapPlace> places, float* depths) const
{
    constexpr std::size_t together = 16; // as many as can be on their way from memory
    std::array<Element, together> elements;
    std::array<Found, together> bricks;
    for (std::size_t first = 0; first < places.size(); first += together) {
        const std::size_t count = std::min(together, places.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            elements[i] = element(place(places[first + i].texel), cell_at(places[first + i].rank));
            __builtin_prefetch(&groups_[elements[i].group]);
        }
        for (std::size_t i = 0; i < count; ++i)
            __builtin_prefetch(group_data(groups_[elements[i].group]));
        for (std::size_t i = 0; i < count; ++i) {
            bricks[i] = find(elements[i]);
            __builtin_prefetch(bricks[i].bytes);
            __builtin_prefetch(bricks[i].bytes + 64);
        }
        for (std::size_t i = 0; i < count; ++i)
            depths[first + i] = bricks[i].bytes ? brick_depth(bricks[i].bytes, elements[i].texel, elements[i].cell) : bricks[i].depth;
    }
}

StoredBricks::Counts StoredBricks::counts() const
{
    Counts counts = {std::size_t(layout_.columns) * layout_.columns * layout_.blocks_s * layout_.blocks_t, 0, 0};
    for (std::size_t g = 0; g < layout_.group_count(); ++g) {
        counts.general += std::size_t(std::popcount(groups_[g].general));
        counts.constant += std::size_t(std::popcount(groups_[g].filled & ~groups_[g].general));
    }
    counts.background -= counts.general + counts.constant;
    return counts;
}

} // namespace limn
