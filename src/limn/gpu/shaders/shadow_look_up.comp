// Looks up whether an object is between pairs of places.
#include "limn/formulas/shadow_lookup.glsl"
#include "limn/gpu/shaders/segment_lists.glsl"
layout(local_size_x = 64) in;

struct Query {
    vec4 from;  // in unit space
    vec4 to;    // a place and 1, or a direction and 0
    vec4 among; // which of the nearest maps, in x and y
};
layout(std430, binding = 2) readonly buffer Queries { Query queries[]; };
layout(std430, binding = 3) writeonly buffer Verdicts { int verdicts[]; };

uniform int spread;
uniform int order;
uniform int size;
uniform ivec2 cells;

int verdict(const Query query)
{
    ShadowLine line = shadow_line(query.from.xyz, query.to);
    if (line.kind == LINE_FREE)
        return SHADOW_LIT;
    ivec2 cell = cell_for(spread, cells, line.direction, query.among.xy);
    MapProbe probe = map_probe(frame_of_cell(spread, cells, cell), size, line);
    uint texel = texel_at(probe.place, size);
    if (texel == NO_TEXEL)
        return SHADOW_LIT;
    return shadow_verdict(probe, stored_depth(texel, rank_of_cell(order, cells, cell)));
}

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i < uint(queries.length()))
        verdicts[i] = verdict(queries[i]);
}
