#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "limn/gpu/program.h"
#include "limn/gpu/resources.h"
#include "limn/terrain/pyramid_layout.h"

namespace limn::gpu {

/// A tile's normals, as tile_normals() packs them, with its place.
struct NormalTile {
    TileId id;
    std::shared_ptr<const std::vector<std::uint32_t>> normals;
};

/// The normals of a terrain's tiles on the device, as tile_normals.glsl reads them: a layer of a texture for each, and where it is. Layers of tiles that are not
/// needed any more are used again. Needs a Context.
class TileTextures {
public:
    explicit TileTextures(const PyramidLayout& layout);
    /// Makes these the tiles that can be read; those that were there already are not sent again.
    /// @throws Error::Device where the device has no room, or not for so many tiles
    void take(const std::vector<NormalTile>& tiles);
    /// Binds them for a program: the texture at `unit`, the places as storage at `binding`.
    void bind(const Program& program, unsigned unit, unsigned binding) const;

private:
    void make_room(std::size_t layers);

    PyramidLayout layout_;
    Texture texture_;
    std::size_t layers_ = 0;
    struct Resident {
        int layer;
        std::shared_ptr<const std::vector<std::uint32_t>> normals; ///< which they were
    };
    std::unordered_map<std::size_t, Resident> residents_; ///< by the numbers of tiles
    Buffer places_;                                       ///< of each tile its layer and 1; 0: not there
};

} // namespace limn::gpu
