#include "limn/gpu/tile_textures.h"

#include <algorithm>
#include <utility>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/gpu/context.h"

namespace limn::gpu {
namespace {

Texture make_layers(int points, std::size_t layers)
{
    GLint most = 0;
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most);
    if (layers > std::size_t(most))
        throw Error::Device(fmt::format("the GPU has no room for {} tiles of normals; {} can be", layers, most));
    unsigned id = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &id);
    Texture texture(id);
    glTextureStorage3D(id, 1, GL_RG16_SNORM, points, points, GLsizei(layers));
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    check_errors("making textures for tiles of normals");
    return texture;
}

} // namespace

TileTextures::TileTextures(const PyramidLayout& layout) : layout_(layout), places_(layout.tile_count() * sizeof(std::uint32_t)) {}

void TileTextures::make_room(std::size_t layers)
{
    if (layers <= layers_)
        return;
    Texture larger = make_layers(layout_.tile_points(), layers);
    if (layers_ > 0)
        glCopyImageSubData(texture_.id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, larger.id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0,
                           layout_.tile_points(), layout_.tile_points(), GLsizei(layers_));
    texture_ = std::move(larger);
    layers_ = layers;
}

void TileTextures::take(const TileLight& light)
{
    make_room(std::max(light.room, light.tiles.size()));
    std::unordered_map<std::size_t, int> kept;
    std::vector<bool> used(layers_);
    for (const TileId& id : light.tiles)
        if (const auto found = layer_of_.find(layout_.index(id)); found != layer_of_.end()) {
            used[std::size_t(found->second)] = true;
            kept.insert(*found);
        }
    auto next = used.begin();
    const int points = layout_.tile_points();
    for (const NormalTile& tile : light.fresh) {
        const auto [place, is_new] = kept.try_emplace(layout_.index(tile.id));
        if (is_new) {
            next = std::find(next, used.end(), false);
            place->second = int(next - used.begin());
            *next = true;
        }
        glTextureSubImage3D(texture_.id(), 0, 0, 0, place->second, points, points, 1, GL_RG, GL_SHORT, tile.normals.data());
    }
    layer_of_ = std::move(kept);
    std::vector<std::uint32_t> places(layout_.tile_count());
    for (const auto& [number, layer] : layer_of_)
        places[number] = std::uint32_t(layer) + 1;
    places_.write(0, places.size() * sizeof(std::uint32_t), places.data());
}

void TileTextures::bind(const Program& program, unsigned unit, unsigned binding) const
{
    program.set("roots", layout_.lattice.roots);
    program.set("top", layout_.top());
    program.set("tile_cells", layout_.tile_cells());
    bind_texture(texture_, unit);
    places_.bind_storage(binding);
}

} // namespace limn::gpu
