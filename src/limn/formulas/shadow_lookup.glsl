// Whether a rigid object stands between two places, by its maps of depth from all directions (the coherent shadow map specification, 2.8 and 6.4).
// Places are in the object's unit space, where the smallest sphere around it is the unit sphere about the origin. The places of light have a fourth
// number: 1, or 0 where the first three are a direction towards a light at infinity.
#pragma once
#include "limn/formulas/direction_grid.glsl"
#include "limn/formulas/map_rank.glsl"

const int SHADOW_LIT = 0;
const int SHADOW_DARK = 1;
const int SHADOW_UNKNOWN = 2; // one depth cannot tell: a ray has to

const uint NO_TEXEL = 0xFFFFFFFFu;

const int LINE_FREE = 0;    // the object cannot be between the places
const int LINE_FROM = 1;    // `from` is in the sphere: its depth counts
const int LINE_THROUGH = 2; // both ends are outside: the object is between them where the whole line meets it. `from` is the place nearest to the middle.

// What of a line between two places matters to the maps.
struct ShadowLine {
    int kind;
    vec3 from;
    vec3 direction; // unit, towards the other end
    float reach;    // how far the other end is, where it is in the sphere too; below 0 otherwise
};

// Where a line is looked up in one map.
struct MapProbe {
    vec2 place;  // in texels
    float depth; // what is nearer to the map's eye casts a shadow
    float other; // depth of the other end; what is nearer than this may be behind it
};

// An end in the sphere is taken for the one whose depth counts: with the other outside, that always tells.
FORMULA ShadowLine shadow_line(const vec3 p, const vec4 q)
{
    vec3 light = vec3(q);
    vec3 way = light - q.w * p;
    float far = length(way);
    bool p_inside = dot(p, p) < 1.0f;
    bool q_inside = q.w > 0.0f && dot(light, light) < 1.0f;
    ShadowLine line = {LINE_FREE, p, vec3(0.0f, 0.0f, 0.0f), -1.0f};
    if (!(far > 0.0f))
        return line;
    line.direction = way / far;
    if (p_inside || q_inside) {
        line.kind = LINE_FROM;
        if (!p_inside) {
            line.from = light;
            line.direction = -line.direction;
        } else if (q_inside) {
            line.reach = far;
        }
        return line;
    }
    float ahead = -dot(p, line.direction); // of the middle
    if (ahead <= 0.0f || (q.w > 0.0f && ahead >= far))
        return line;
    line.from = p + ahead * line.direction;
    if (dot(line.from, line.from) < 1.0f)
        line.kind = LINE_THROUGH;
    return line;
}

// The cell of a grid whose map is looked up for a direction. `among` of (1/2, 1/2) takes the nearest; an even random place in the unit square one
// of the four nearest, each as often as bilinear interpolation weighs it. Octahedral grids have no neighbours across their borders.
FORMULA ivec2 cell_for(const int spread, const ivec2 cells, const vec3 direction, const vec2 among)
{
    ivec2 cell = ivec2(floor(place_of_direction(spread, direction) * vec2(cells) - vec2(0.5f, 0.5f) + among));
    ivec2 kept = clamp(cell, ivec2(0, 0), cells - ivec2(1, 1));
    if (spread == OCTAHEDRAL_GRID)
        return kept;
    int around = cell.y < 0 ? cell.y + cells.y : cell.y >= cells.y ? cell.y - cells.y : cell.y;
    return ivec2(kept.x, around);
}

FORMULA MapFrame frame_of_cell(const int spread, const ivec2 cells, const ivec2 cell)
{
    return frame_of_place(spread, (vec2(cell) + vec2(0.5f, 0.5f)) / vec2(cells));
}

FORMULA MapProbe map_probe(const MapFrame frame, const int size, const ShadowLine line)
{
    vec2 across = vec2(dot(line.from, frame.right), dot(line.from, frame.up));
    MapProbe probe = {(across * 0.5f + vec2(0.5f, 0.5f)) * float(size), 2.0f, -1.0f}; // deeper than all surfaces
    if (line.kind == LINE_FROM) {
        probe.depth = 0.5f - 0.5f * dot(line.from, frame.towards);
        if (line.reach >= 0.0f)
            probe.other = probe.depth - 0.5f * line.reach * dot(line.direction, frame.towards);
    }
    return probe;
}

// The texel at a place of a map, row by row; NO_TEXEL outside the map, where nothing is.
FORMULA uint texel_at(const vec2 place, const int size)
{
    float side = float(size);
    if (!(place.x >= 0.0f && place.y >= 0.0f && place.x < side && place.y < side))
        return NO_TEXEL;
    return uint(place.y) * uint(size) + uint(place.x);
}

// By the depth that a texel holds; that of the background is beyond all others.
FORMULA int shadow_verdict(const MapProbe probe, const float stored)
{
    if (!(stored < probe.depth))
        return SHADOW_LIT;
    return probe.other <= stored ? SHADOW_DARK : SHADOW_UNKNOWN;
}
