#include "limn/gpu/map_painter.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <epoxy/gl.h>

#include "limn/base/parallel.h"
#include "limn/gpu/context.h"
#include "limn/gpu/program.h"
#include "limn/gpu/resources.h"

namespace limn::gpu {
namespace {

constexpr int largest_picture = 4096; ///< texels along an edge of what is drawn at once, unless one map is larger

/// As in map_depth.vert.
struct Frame {
    vec4 right, up, towards;
};

std::vector<float> positions_of(const ShadowCaster& caster)
{
    std::vector<float> positions;
    positions.reserve(3 * caster.x.size());
    for (std::size_t i = 0; i < caster.x.size(); ++i)
        positions.insert(positions.end(), {caster.x[i], caster.y[i], caster.z[i]});
    storage_bytes(caster.x.size(), 3 * sizeof(float), "vertices");
    return positions;
}

/// How many tiles a picture has along its edges.
ivec2 tiles_for(std::size_t maps, int size)
{
    const int most = std::max(1, largest_picture / size);
    const int across = std::min(most, int(std::ceil(std::sqrt(double(maps)))));
    return {across, std::min(most, (int(maps) + across - 1) / across)};
}

class DevicePainter : public MapPainter {
public:
    DevicePainter(const ShadowCaster& caster, int size, OpenBack back)
        : size_(size), closer_(size, back), first_(load_program({"map_depth.vert", "depth.frag"})), behind_(load_program({"map_depth.vert", "map_behind.frag"})),
          positions_(positions_of(caster)), corners_(caster.triangles), array_(make_vertex_array()), indices_(int(3 * caster.triangles.size()))
    {
        glVertexArrayElementBuffer(array_.id(), corners_.id());
    }

    std::span<const DepthLayers> paint(std::span<const MapFrame> frames) override
    {
        maps_.resize(std::max(maps_.size(), frames.size()));
        for (std::size_t first = 0; first < frames.size();) {
            const ivec2 tiles = tiles_for(frames.size() - first, size_);
            const std::size_t count = std::min(frames.size() - first, std::size_t(tiles.x) * std::size_t(tiles.y));
            paint_tiles(frames.subspan(first, count), tiles, maps_.data() + first);
            first += count;
        }
        return {maps_.data(), frames.size()};
    }

private:
    struct Target {
        explicit Target(const ivec2& size) : near(size, {}), far(size, {}) {}
        Framebuffer near, far;
    };

    void paint_tiles(std::span<const MapFrame> frames, const ivec2& tiles, DepthLayers* maps)
    {
        const ivec2 size = tiles * size_;
        if (!target_ || target_->near.size() != size)
            target_.emplace(size);
        std::vector<Frame> packed;
        for (const MapFrame& f : frames)
            packed.push_back({vec4(f.right, 0), vec4(f.up, 0), vec4(f.towards, 0)});
        const Buffer on_device(packed);
        positions_.bind_storage(0);
        on_device.bind_storage(1);
        draw(first_, target_->near, tiles, int(frames.size()));
        bind_texture(target_->near.depth(), 0);
        behind_.set("same_surface", same_surface);
        draw(behind_, target_->far, tiles, int(frames.size()));
        const std::vector<float> near = target_->near.read_depth(), far = target_->far.read_depth();
        check_errors("drawing maps of depth");
        parallel_each(frames.size(), 1, [&](std::size_t k) {
            const ivec2 corner = ivec2(int(k) % tiles.x, int(k) / tiles.x) * size_;
            copy_tile(near, size.x, corner, maps[k].near);
            copy_tile(far, size.x, corner, maps[k].far);
            maps[k].size = size_;
            closer_.close(maps[k]);
        });
    }

    /// Depths are as the object's own, from 0 to 1, and none of it is cut off by rounding.
    void draw(const Program& program, const Framebuffer& picture, const ivec2& tiles, int maps) const
    {
        picture.clear_depth();
        picture.bind();
        program.set("tiles", tiles);
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        glEnable(GL_DEPTH_TEST);
        glEnable(GL_DEPTH_CLAMP);
        glDisable(GL_CULL_FACE);
        program.use();
        glBindVertexArray(array_.id());
        glDrawElementsInstanced(GL_TRIANGLES, indices_, GL_UNSIGNED_INT, nullptr, maps);
        glDisable(GL_DEPTH_CLAMP);
        glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    }

    void copy_tile(const std::vector<float>& picture, int width, const ivec2& corner, std::vector<float>& map) const
    {
        map.resize(std::size_t(size_) * std::size_t(size_));
        for (int y = 0; y < size_; ++y) {
            const float* row = &picture[std::size_t(corner.y + y) * std::size_t(width) + std::size_t(corner.x)];
            std::transform(row, row + size_, &map[std::size_t(y) * std::size_t(size_)], [](float depth) { return depth < 1 ? depth : no_surface; });
        }
    }

    int size_;
    BackCloser closer_;
    Program first_, behind_;
    Buffer positions_, corners_;
    VertexArray array_;
    int indices_;
    std::optional<Target> target_;
    std::vector<DepthLayers> maps_;
};

} // namespace

std::unique_ptr<MapPainter> map_painter(const ShadowCaster& caster, int size, OpenBack back) { return std::make_unique<DevicePainter>(caster, size, back); }

} // namespace limn::gpu
