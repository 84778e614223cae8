#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "limn/gpu/program.h"
#include "limn/gpu/resources.h"
#include "limn/gpu/tile_light.h"

namespace limn::gpu {

/// The normals of a terrain's tiles on the device, as tile_normals.glsl reads them: a layer of a texture for each, and where it is. Layers of tiles that are not
/// needed any more are used again. Needs a Context.
class TileTextures {
public:
    explicit TileTextures(const PyramidLayout& layout);
    /// Takes what is fresh, and makes the light's tiles those that can be read. Each that is not fresh has to be here since an earlier call.
    /// @throws Error::Device where the device has no room, or not for so many tiles
    void take(const TileLight& light);
    /// Binds them for a program: the texture at `unit`, the places as storage at `binding`.
    void bind(const Program& program, unsigned unit, unsigned binding) const;

private:
    void make_room(std::size_t layers);

    PyramidLayout layout_;
    Texture texture_;
    std::size_t layers_ = 0;
    std::unordered_map<std::size_t, int> layer_of_; ///< by the numbers of tiles
    Buffer places_;                                 ///< of each tile its layer and 1; 0: not there
};

} // namespace limn::gpu
