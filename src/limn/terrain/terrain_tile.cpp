#include "limn/terrain/terrain_tile.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <memory>

#include <fmt/format.h>
#include <zstd.h>

#include "limn/terrain/split_point.h"

namespace limn {
namespace {

constexpr int compression_level = 1;

using Words = std::vector<std::uint32_t>;

std::uint32_t bits_of(float value) { return std::bit_cast<std::uint32_t>(value); }

/// Differences from what the neighbours to the west, north and north-west make one expect.
void predict(Words& words, std::size_t width)
{
    for (std::size_t i = words.size(); i-- > 0;) {
        const bool west = i % width > 0, north = i >= width;
        words[i] -= (west ? words[i - 1] : 0) + (north ? words[i - width] : 0) - (west && north ? words[i - width - 1] : 0);
    }
}

void undo_prediction(Words& words, std::size_t width)
{
    for (std::size_t i = 1; i < std::min(width, words.size()); ++i)
        words[i] += words[i - 1];
    for (std::size_t row = width; row < words.size(); row += width) {
        std::uint32_t sum = 0; // of differences from the row above
        for (std::size_t i = row; i < row + width; ++i) {
            sum += words[i];
            words[i] = sum + words[i - width];
        }
    }
}

/// First the lowest bytes of all, then the next ones.
void append_bytes(const Words& words, std::string& out)
{
    for (int shift = 0; shift < 32; shift += 8) {
        const std::size_t at = out.size();
        out.resize(at + words.size());
        for (std::size_t i = 0; i < words.size(); ++i)
            out[at + i] = char(words[i] >> shift & 0xff);
    }
}

Words take_bytes(std::string_view bytes, std::size_t count)
{
    Words words(count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t byte = 0; byte < 4; ++byte)
            words[i] |= std::uint32_t(static_cast<unsigned char>(bytes[byte * count + i])) << (8 * byte);
    return words;
}

bool has_stored_bounds(const TileId& id) { return id.level > 0; }

std::size_t bytes_of(const PyramidLayout& layout, const TileId& id)
{
    const std::size_t points = std::size_t(layout.tile_points()), around = points + 2;
    return 4 * (around * around + (has_stored_bounds(id) ? 3 * points * points : 0));
}

/// Calls `f(place, number of the point in the tile, its height)` for all points.
template <class F> void each_point(const TerrainTile& tile, F&& f)
{
    const std::size_t points = std::size_t(tile.points);
    for (std::size_t y = 0; y < points; ++y)
        for (std::size_t x = 0; x < points; ++x)
            f(ivec2(int(x), int(y)), y * points + x, tile.heights[(y + 1) * (points + 2) + x + 1]);
}

/// Bounds of the points of level 0.
void find_bounds(const PyramidLayout& layout, TerrainTile& tile)
{
    const Lattice& lattice = layout.lattice;
    const ivec2 last = tile.first + layout.tile_cells();
    const HeightWindow window = {tile.heights.data(), std::size_t(tile.points + 2), tile.first - 1, last + 2};
    const auto below = [&](const ivec2& p) { return tile.bounds_of(p); };
    const auto set = [&](const SplitPoint& point) {
        tile.bounds[tile.bounds_index(point.middle() - tile.first)] = bounds_of_point(lattice, window, point, below);
    };
    for (int y = tile.first.y; y <= last.y; y += 2)
        for (int x = tile.first.x; x < last.x; x += 2)
            set(split_point_on_row(lattice, x, y, 2));
    for (int y = tile.first.y; y < last.y; y += 2)
        for (int x = tile.first.x; x <= last.x; x += 2)
            set(split_point_on_column(lattice, x, y, 2));
    for (int y = tile.first.y; y < last.y; y += 2)
        for (int x = tile.first.x; x < last.x; x += 2)
            set(split_point_in_square(lattice, x / 2, y / 2, 2));
}

void unpack_bounds(std::string_view bytes, TerrainTile& tile)
{
    const std::size_t count = std::size_t(tile.points) * std::size_t(tile.points);
    const Words errors = take_bytes(bytes, count), low = take_bytes(bytes.substr(4 * count), count),
                high = take_bytes(bytes.substr(8 * count), count);
    each_point(tile, [&](const ivec2& at, std::size_t i, float height) {
        if (tile.owns(at))
            tile.bounds[tile.bounds_index(at)] = {std::bit_cast<float>(errors[i]), std::bit_cast<float>(bits_of(height) - low[i]),
                                                  std::bit_cast<float>(bits_of(height) + high[i])};
    });
}

/// A tile with its place, and with heights of no data.
TerrainTile tile_without_bounds(const PyramidLayout& layout, const TileId& id)
{
    TerrainTile tile;
    tile.first = layout.first_sample(id), tile.stride = 1 << id.level, tile.points = layout.tile_points();
    tile.is_coarsest = id.level == layout.top();
    const std::size_t around = std::size_t(tile.points) + 2;
    tile.heights.assign(around * around, std::numeric_limits<float>::quiet_NaN());
    return tile;
}

/// Fills in heights, and gives all bytes that were packed: none where there is no data.
std::string unpack(const PyramidLayout& layout, const TileId& id, std::string_view packed, TerrainTile& tile, std::string& bytes)
{
    if (packed.empty())
        return {};
    bytes.resize(bytes_of(layout, id));
    const std::size_t got = ZSTD_decompress(bytes.data(), bytes.size(), packed.data(), packed.size());
    if (ZSTD_isError(got))
        return ZSTD_getErrorName(got);
    if (got != bytes.size())
        return fmt::format("holds {} bytes, not {}", got, bytes.size());
    Words heights = take_bytes(bytes, tile.heights.size());
    undo_prediction(heights, std::size_t(tile.points + 2));
    std::transform(heights.begin(), heights.end(), tile.heights.begin(), [](std::uint32_t bits) { return std::bit_cast<float>(bits); });
    return {};
}

} // namespace

TerrainTile empty_tile(const PyramidLayout& layout, const TileId& id)
{
    TerrainTile tile = tile_without_bounds(layout, id);
    tile.bounds.assign(tile.own_points(), GrowingBounds().rounded());
    return tile;
}

std::string pack_tile(const PyramidLayout& layout, const TileId& id, const TerrainTile& tile)
{
    std::string bytes;
    bytes.reserve(bytes_of(layout, id));
    Words heights(tile.heights.size());
    for (std::size_t i = 0; i < heights.size(); ++i)
        heights[i] = bits_of(tile.heights[i]);
    predict(heights, std::size_t(tile.points + 2));
    append_bytes(heights, bytes);
    if (has_stored_bounds(id)) {
        Words errors(std::size_t(tile.points) * std::size_t(tile.points)), low = errors, high = errors;
        each_point(tile, [&](const ivec2& at, std::size_t i, float height) {
            const PointBounds bounds = tile.owns(at) ? tile.bounds[tile.bounds_index(at)] : PointBounds();
            errors[i] = bits_of(bounds.error), low[i] = bits_of(height) - bits_of(bounds.low),
            high[i] = bits_of(bounds.high) - bits_of(height);
        });
        for (const Words& words : {errors, low, high})
            append_bytes(words, bytes);
    }
    std::string packed(ZSTD_compressBound(bytes.size()), '\0');
    packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), compression_level));
    return packed;
}

std::string unpack_heights(const PyramidLayout& layout, const TileId& id, std::string_view packed, TerrainTile& tile)
{
    std::string bytes;
    tile = tile_without_bounds(layout, id);
    return unpack(layout, id, packed, tile, bytes);
}

std::string unpack_tile(const PyramidLayout& layout, const TileId& id, std::string_view packed, TerrainTile& tile)
{
    std::string bytes;
    tile = empty_tile(layout, id);
    if (const std::string fault = unpack(layout, id, packed, tile, bytes); !fault.empty() || packed.empty())
        return fault;
    if (has_stored_bounds(id))
        unpack_bounds(std::string_view(bytes).substr(4 * tile.heights.size()), tile);
    else if (layout.tile_level > 0)
        find_bounds(layout, tile);
    return {};
}

} // namespace limn
