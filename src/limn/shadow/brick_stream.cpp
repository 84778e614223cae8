#include "limn/shadow/brick_stream.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"

namespace limn {
namespace {

/// The elements of a brick; false where all of them are background or beyond the maps.
bool gather(std::span<const DepthLayers* const> maps, int size, float margin, const ivec2& corner, std::vector<DepthRange>& elements)
{
    const int width = std::min(brick_texels, size - corner.x), height = std::min(brick_texels, size - corner.y);
    elements.assign(brick_elements, DepthRange::anything());
    bool any = false;
    for (std::size_t map = 0; map < maps.size(); ++map) {
        if (!maps[map])
            continue;
        for (int y = 0; y < height; ++y) {
            const std::size_t from = std::size_t(corner.y + y) * std::size_t(size) + std::size_t(corner.x);
            const float *near = maps[map]->near.data() + from, *far = maps[map]->far.data() + from;
            DepthRange* to = elements.data() + map * brick_texels * brick_texels + std::size_t(y * brick_texels);
            for (int x = 0; x < width; ++x) {
                any |= near[x] != no_surface;
                to[x] = near[x] == no_surface ? DepthRange::background() : depth_range(near[x], far[x], margin);
            }
        }
    }
    return any;
}

} // namespace

BrickLayout::BrickLayout(int size, const ivec2& cells)
{
    const auto parts = [](int whole, int part) { return std::uint32_t((whole + part - 1) / part); };
    columns = parts(size, brick_texels);
    groups = (columns * columns + bricks_together - 1) / bricks_together;
    blocks_s = parts(cells.x, brick_s), blocks_t = parts(cells.y, brick_t);
}

BrickStream::BrickStream(int size, const ivec2& cells, float margin)
    : size_(size), margin_(margin), layout_(size, cells), bricks_(std::size_t(layout_.columns) * layout_.columns)
{
}

void BrickStream::add(std::span<const DepthLayers* const> maps)
{
    struct Worker {
        BrickEncoder encoder;
        std::vector<DepthRange> elements;
    };
    tbb::enumerable_thread_specific<Worker> workers;
    parallel_blocks(bricks_.size(), layout_.columns, [&](std::size_t begin, std::size_t end) {
        Worker& worker = workers.local();
        for (std::size_t i = begin; i < end; ++i) {
            const ivec2 corner = brick_texels * ivec2(int(i % layout_.columns), int(i / layout_.columns));
            bricks_[i] = gather(maps, size_, margin_, corner, worker.elements) ? worker.encoder.encode(worker.elements) : EncodedBrick{};
        }
    });
    for (std::size_t first = 0; first < bricks_.size(); first += bricks_together)
        append(std::span(bricks_).subspan(first, std::min<std::size_t>(bricks_together, bricks_.size() - first)));
}

void BrickStream::append(std::span<const EncodedBrick> bricks)
{
    BrickGroup group = {0, 0, 0};
    std::string constants;
    std::vector<const std::string*> general;
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < bricks.size(); ++i) {
        const std::uint32_t bit = std::uint32_t(1) << i;
        group.filled |= bricks[i].kind != EncodedBrick::Kind::background ? bit : 0;
        if (bricks[i].kind == EncodedBrick::Kind::constant)
            constants += char(bricks[i].value);
        if (bricks[i].kind == EncodedBrick::Kind::general) {
            group.general |= bit;
            general.push_back(&bricks[i].bytes);
            bytes += bricks[i].bytes.size();
        }
    }
    data_.resize((data_.size() + 3) / 4 * 4);
    if (data_.size() / 4 >= coarse_offsets)
        throw Error::Input("these maps need more than the 8 GiB that a file holds; bake fewer maps, or smaller ones");
    group.place = std::uint32_t(data_.size() / 4);
    const std::size_t table = general.size() * sizeof(std::uint16_t) + constants.size();
    const bool coarse = table + bytes > std::numeric_limits<std::uint16_t>::max();
    const std::size_t unit = coarse ? 4 : 1;
    if (coarse)
        group.place |= coarse_offsets;
    groups_.push_back(group);
    std::string data;
    std::size_t end = (table + unit - 1) / unit * unit;
    for (const std::string* brick : general) {
        const auto offset = std::uint16_t(end / unit);
        data.append(reinterpret_cast<const char*>(&offset), sizeof offset);
        end += (brick->size() + unit - 1) / unit * unit;
    }
    data += constants;
    for (const std::string* brick : general) {
        data.resize((data.size() + unit - 1) / unit * unit);
        data += *brick;
    }
    data_ += data;
}

std::string BrickStream::finish()
{
    std::string bytes(reinterpret_cast<const char*>(groups_.data()), groups_.size() * sizeof(BrickGroup));
    bytes += data_;
    bytes.append(bits_slack, '\0');
    groups_ = {}, data_ = {};
    return bytes;
}

} // namespace limn
