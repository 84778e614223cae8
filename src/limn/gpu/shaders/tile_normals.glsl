// Normals of a terrain's ground from its tiles, of those that are there. Levels count from 0, the finest; tiles have tile_cells + 1 points along each side, which
// are 2^level samples apart.
layout(binding = 0) uniform sampler2DArray normals_of_tiles;
layout(std430, binding = 1) readonly buffer Places { uint places_of_tiles[]; }; // a tile's layer and 1; 0: it is not there
uniform ivec2 roots;     // tiles of the coarsest level
uniform int top;         // the coarsest level
uniform int tile_cells;

// The first two parts of the normal on one level, at a cell of samples and a place in it. False where that tile is not there.
bool normal_of_level(const int level, const ivec2 cell, const vec2 place, out vec2 slope)
{
    int above = top - level;
    ivec2 count = roots << above;
    ivec2 tile = clamp((cell >> level) / tile_cells, ivec2(0), count - 1);
    int before = roots.x * roots.y * ((1 << (2 * above)) - 1) / 3; // tiles of coarser levels
    uint layer = places_of_tiles[before + tile.y * count.x + tile.x];
    if (layer == 0u)
        return false;
    vec2 point = (vec2(cell - (tile * tile_cells << level)) + place) / float(1 << level);
    vec2 texel = (point + 0.5f) / float(tile_cells + 1);
    slope = textureLod(normals_of_tiles, vec3(texel, float(layer - 1u)), 0.0f).xy;
    return true;
}

// The unit normal at a place: cells of samples and a rest. It is of the level whose points are about `footprint` samples apart, or of the next coarser one that
// has its tile here; the coarsest has all.
vec3 tile_normal(const ivec2 cell, const vec2 place, const float footprint)
{
    vec2 slope = vec2(0.0f);
    for (int level = clamp(int(log2(max(footprint, 1.0f)) + 0.5f), 0, top); level <= top; ++level)
        if (normal_of_level(level, cell, place, slope))
            break;
    return vec3(slope, sqrt(max(0.0f, 1.0f - dot(slope, slope))));
}
