#include "limn/terrain/build_pyramid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/terrain/gathered_heights.h"
#include "limn/terrain/nesting_stream.h"
#include "limn/terrain/pyramid_file.h"
#include "limn/terrain/pyramid_format.h"
#include "limn/terrain/terrain_tile.h"

namespace limn {
namespace {

/// Parts of the work, by how long they take.
constexpr double share_of_reading = 0.4;

/// Some rows of all columns, which move down the map.
class RowBand {
public:
    explicit RowBand(int columns) : columns_(std::size_t(columns)) {}
    int first() const { return first_; }
    int end() const { return first_ + int(heights_.size() / columns_); }
    HeightWindow window() const { return part(first_, end()); }
    HeightWindow part(int first, int end) const
    {
        return {heights_.data() + std::size_t(first - first_) * columns_, columns_, {0, first}, {int(columns_), end}};
    }
    void drop_before(int row)
    {
        const int dropped = std::clamp(row - first_, 0, end() - first_);
        heights_.erase(heights_.begin(), heights_.begin() + std::ptrdiff_t(std::size_t(dropped) * columns_));
        first_ += dropped;
    }
    /// @return the first of `rows` rows more, to be filled
    float* grow(int rows)
    {
        const std::size_t at = heights_.size();
        heights_.resize(at + std::size_t(rows) * columns_);
        return heights_.data() + at;
    }
    void append(const std::vector<float>& rows) { heights_.insert(heights_.end(), rows.begin(), rows.end()); }

private:
    std::size_t columns_;
    int first_ = 0;
    std::vector<float> heights_;
};

/// A tile of level 0 out of rows that hold all of it, and of one more around it.
TerrainTile cut_tile(const PyramidLayout& layout, const TileId& id, const HeightWindow& rows)
{
    TerrainTile tile = empty_tile(layout, id);
    const int around = tile.points + 2;
    for (int y = 0; y < around; ++y) {
        const int row = tile.first.y - 1 + y;
        const int left = std::max(0, tile.first.x - 1), right = std::min(rows.end.x, tile.first.x - 1 + around);
        if (row >= rows.first.y && row < rows.end.y && left < right)
            std::copy_n(rows.at(left, row), right - left, tile.heights.begin() + std::ptrdiff_t(y) * around + (left - tile.first.x + 1));
    }
    return tile;
}

bool has_data(const TerrainTile& tile)
{
    return std::any_of(tile.heights.begin(), tile.heights.end(), [](float height) { return !std::isnan(height); });
}

class Builder {
public:
    Builder(const HeightRows& rows, const std::filesystem::path& path, const std::function<void(double)>& progress)
        : source_(rows), lattice_(make_lattice(rows.frame.columns, rows.frame.rows)), layout_(lattice_), progress_(progress),
          gathered_(lattice_, 1 << NestingStream::first_coarse), directory_(empty_directory(rows.frame)),
          file_(path, directory_bytes(directory_))
    {
    }
    BuiltPyramid run(const std::string& name)
    {
        write_finest();
        if (gathered_.samples() == 0)
            throw Error::Read(fmt::format("{}: none of its {} x {} samples has data", name, lattice_.columns, lattice_.rows));
        write_coarser();
        return finish();
    }

private:
    PyramidDirectory empty_directory(const HeightMap& frame) const
    {
        PyramidDirectory directory;
        directory.frame = frame;
        directory.frame.heights.clear();
        directory.lattice_level = lattice_.level, directory.tile_level = layout_.tile_level;
        directory.tiles.assign(layout_.tile_count(), {0, 0, 0, GrowingBounds().rounded()});
        if (!lattice_.is_covered_exactly())
            directory.last_column.resize(std::size_t(lattice_.rows)), directory.last_row.resize(std::size_t(lattice_.columns));
        return directory;
    }
    TileEntry& entry(const TileId& id) { return directory_.tiles[layout_.index(id)]; }
    void tell(double part) const
    {
        if (progress_)
            progress_(part);
    }

    /// Packs a row of tiles in parallel, then appends them in order.
    template <class Make> void write_tile_row(int level, int row, Make&& make)
    {
        std::vector<std::string> packed(std::size_t(layout_.tiles(level).x));
        parallel_each(packed.size(), 1, [&](std::size_t i) {
            const TileId id = {level, {int(i), row}};
            const TerrainTile tile = make(id);
            if (has_data(tile) || entry(id).bounds.error > 0) // some of what is between a level's points may have data
                packed[i] = pack_tile(layout_, id, tile);
        });
        for (std::size_t i = 0; i < packed.size(); ++i) {
            TileEntry& where = entry({level, {int(i), row}});
            where.offset = file_.append(packed[i]);
            where.size = std::uint32_t(packed[i].size()), where.checksum = checksum_of(packed[i]);
        }
    }

    /// Level 0 while the rows are read: those of the next tiles at the same time as tiles are packed.
    void write_finest()
    {
        const int cells = layout_.tile_cells(), rows = layout_.tiles(0).y;
        RowBand band(lattice_.columns);
        std::vector<float> next;
        int read = 0;
        const auto read_to = [&](int end) {
            const int count = std::max(0, std::min(end, lattice_.rows) - read);
            next.resize(std::size_t(count) * std::size_t(lattice_.columns));
            if (count > 0)
                source_.read(read, count, next.data());
            read += count;
        };
        read_to(cells + 2);
        for (int row = 0; row < rows; ++row) {
            band.append(next);
            gathered_.add(band.part(read - int(next.size() / std::size_t(lattice_.columns)), read));
            const auto make = [&](const TileId& id) { return cut_tile(layout_, id, band.window()); };
            tbb::parallel_invoke([&] { write_tile_row(0, row, make); }, [&] { read_to((row + 2) * cells + 2); });
            band.drop_before((row + 1) * cells - 1);
            tell(share_of_reading * (row + 1) / rows);
        }
        if (!lattice_.is_covered_exactly())
            directory_.last_column = gathered_.last_column(), directory_.last_row = gathered_.last_row();
    }

    /// All errors, and the tiles above level 0.
    void write_coarser()
    {
        CoarseErrors coarse(lattice_, NestingStream::first_coarse, [this](const ivec2& p) { return gathered_.height(p); });
        NestingStream stream(lattice_, coarse);
        const int cells = layout_.tile_cells(), rows = layout_.tiles(0).y;
        RowBand band(lattice_.columns);
        for (int level = 0; level <= layout_.top(); ++level)
            heights_.emplace_back(std::size_t((lattice_.columns - 1) >> level) + 1);
        tile_rows_done_.assign(std::size_t(layout_.levels()), 0);
        for (int row = 0; row < rows; ++row) {
            band.drop_before(stream.first_row_needed());
            const int known = band.end(), end = row + 1 == rows ? lattice_.rows : std::min(lattice_.rows, (row + 1) * cells);
            if (end > known) {
                read_finest(row, band.grow(end - known), known, end);
                const HeightWindow added = band.part(known, end);
                coarse.add(added);
                keep_heights(added);
            }
            stream.advance(band.window());
            fold_finest(stream);
            for (int level = 1; level <= layout_.top(); ++level)
                while (is_complete(stream, level, tile_rows_done_[std::size_t(level)]))
                    write_coarse_row(stream, level, tile_rows_done_[std::size_t(level)]++);
            release(stream);
            tell(share_of_reading + (1 - share_of_reading) * (row + 1) / rows);
        }
    }
    /// Rows [first, end) out of the tiles of a row of tiles.
    void read_finest(int row, float* heights, int first, int end) const
    {
        const int cells = layout_.tile_cells();
        parallel_each(std::size_t(layout_.tiles(0).x), 1, [&](std::size_t i) {
            const TileId id = {0, {int(i), row}};
            const TileEntry& where = directory_.tiles[layout_.index(id)];
            TerrainTile tile;
            const std::string fault = unpack_heights(layout_, id, file_.read(where.offset, where.size), tile);
            if (!fault.empty())
                throw Error::Read("what was written cannot be read again: " + fault);
            const int left = tile.first.x, right = std::min(lattice_.columns, left + cells + (i + 1 == std::size_t(layout_.tiles(0).x)));
            for (int y = first; y < end; ++y)
                for (int x = left; x < right; ++x)
                    heights[std::size_t(y - first) * std::size_t(lattice_.columns) + std::size_t(x)] = tile.height({x, y});
        });
    }
    /// Of the points of each level.
    void keep_heights(const HeightWindow& rows)
    {
        for (int level = 1; level <= layout_.top(); ++level)
            for (int y = rows.first.y; y < rows.end.y; ++y) {
                SlidingRows<float>& kept = heights_[std::size_t(level)];
                if (y != kept.end() << level)
                    continue;
                std::vector<float> row(kept.width());
                for (std::size_t x = 0; x < row.size(); ++x)
                    row[x] = rows.height({int(x) << level, y});
                kept.append(std::move(row));
            }
    }
    /// Bounds of points of level 0 into their tiles', those of two tiles where a point is on their border.
    void fold_finest(const NestingStream& stream)
    {
        if (stream.powers() == 0)
            return;
        const int cells = layout_.tile_cells(), end = stream.last_row(0) + 1;
        parallel_each(std::size_t(layout_.tiles(0).x), 1, [&](std::size_t i) {
            for (int y = folded_; y < end; ++y)
                for (int row = (y - 1) / cells; row <= y / cells; ++row) // in both where y is on a border
                    if (row < layout_.tiles(0).y)
                        fold_row(stream.rows(0).row(y), y, {0, {int(i), row}});
        });
        folded_ = end;
    }
    void fold_row(const std::vector<PointBounds>& row, int y, const TileId& id)
    {
        GrowingBounds bounds;
        bounds.nest(entry(id).bounds);
        const int first = id.at.x * layout_.tile_cells();
        for (int x = first + (y % 2 == 0); x <= first + layout_.tile_cells(); x += 2 - y % 2)
            bounds.nest(row[std::size_t(x)]);
        entry(id).bounds = bounds.rounded();
    }

    bool is_complete(const NestingStream& stream, int level, int row) const
    {
        if (row >= layout_.tiles(level).y)
            return false;
        const int last = (row + 1) * layout_.tile_samples(level);
        for (int power = level; power < (level == layout_.top() ? stream.powers() : level + 1); ++power)
            if (!stream.is_done(power) && stream.last_row(power) < last >> power)
                return false;
        return true;
    }
    void write_coarse_row(const NestingStream& stream, int level, int row)
    {
        write_tile_row(level, row, [&](const TileId& id) {
            TerrainTile tile = empty_tile(layout_, id);
            take_heights(id, tile);
            take_bounds(stream, id, tile);
            return tile;
        });
    }
    void take_heights(const TileId& id, TerrainTile& tile) const
    {
        const SlidingRows<float>& kept = heights_[std::size_t(id.level)];
        const ivec2 first = id.at * layout_.tile_cells() - 1;
        const int around = tile.points + 2;
        for (int y = 0; y < around; ++y)
            for (int x = 0; x < around; ++x) {
                const ivec2 p = first + ivec2(x, y);
                if (p.x >= 0 && p.y >= 0 && p.y < kept.end() && std::size_t(p.x) < kept.width())
                    tile.heights[std::size_t(y * around + x)] = kept.row(p.y)[std::size_t(p.x)];
            }
    }
    void take_bounds(const NestingStream& stream, const TileId& id, TerrainTile& tile)
    {
        const ivec2 first = id.at * layout_.tile_cells();
        GrowingBounds all;
        std::fill(tile.bounds.begin(), tile.bounds.end(), PointBounds());
        for (int y = 0; y < tile.points; ++y)
            for (int x = 0; x < tile.points; ++x) {
                const ivec2 p = first + ivec2(x, y);
                const int above = std::countr_zero(unsigned(p.x | p.y)), power = id.level + above; // of the origin: more than any
                if (power >= stream.powers() || (above > 0 && id.level < layout_.top()))
                    continue;
                const PointBounds& bounds = stream.rows(power).row(p.y >> above)[std::size_t(p.x >> above)];
                tile.bounds[tile.bounds_index({x, y})] = bounds;
                all.nest(bounds);
            }
        entry(id).bounds = all.rounded();
    }
    void release(NestingStream& stream)
    {
        if (stream.powers() > 0 && layout_.top() > 0)
            stream.release(0, folded_ - 1);
        for (int power = 1; power < stream.powers(); ++power) {
            const int level = std::min(power, layout_.top()), next = tile_rows_done_[std::size_t(level)] * layout_.tile_samples(level);
            stream.release(power, next >> power);
        }
        for (int level = 1; level <= layout_.top(); ++level)
            heights_[std::size_t(level)].drop_before(tile_rows_done_[std::size_t(level)] * layout_.tile_cells() - 1);
    }
    BuiltPyramid finish()
    {
        directory_.low = gathered_.low(), directory_.high = gathered_.high();
        directory_.samples = gathered_.samples(), directory_.file_bytes = file_.size();
        file_.finish(encode_directory(directory_));
        const auto full =
            std::count_if(directory_.tiles.begin(), directory_.tiles.end(), [](const TileEntry& tile) { return tile.size > 0; });
        return {directory_.tiles.size(), std::size_t(full), directory_.samples, directory_.file_bytes, directory_.low, directory_.high};
    }

    const HeightRows& source_;
    Lattice lattice_;
    PyramidLayout layout_;
    const std::function<void(double)>& progress_;
    GatheredHeights gathered_;
    PyramidDirectory directory_;
    PyramidFile file_;
    std::vector<SlidingRows<float>> heights_; ///< of each level above 0
    std::vector<int> tile_rows_done_;         ///< of each level
    int folded_ = 0;                          ///< rows of level 0
};

} // namespace

BuiltPyramid build_pyramid(const HeightRows& rows, const std::filesystem::path& path, const std::function<void(double)>& progress)
{
    return Builder(rows, path, progress).run(path.string());
}

} // namespace limn
