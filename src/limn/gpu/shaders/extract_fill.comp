// One thread an element: writes the segments that the bits of extract_count.comp tell of, each to its place.
#include "limn/gpu/shaders/extraction_elements.glsl"
#include "limn/gpu/shaders/segments.glsl"

layout(local_size_x = 256) in;
layout(std430, binding = 7) writeonly buffer Segments { Segment segments[]; };
uniform uint level1; // where the levels of sums begin that scan_blocks.comp made
uniform uint level2;
uniform uint total;  // where the sum of all is
uniform uint capacity;

Segment contour_in_face(const uint number)
{
    Face face = face_at(number);
    float facing[3] = float[3](values[face.vertices[0]].x, values[face.vertices[1]].x, values[face.vertices[2]].x);
    CrossedEdges edges = crossed_edges(facing[0] < 0.0f, facing[1] < 0.0f, facing[2] < 0.0f);
    vec3 a = zero_on_edge(face.vertices, face.points, facing, edges.enter);
    vec3 b = zero_on_edge(face.vertices, face.points, facing, edges.leave);
    return Segment(vec4(a, 1.0f), vec4(b, 1.0f), number, 3u * number + uint(edges.enter), 3u * number + uint(edges.leave), NONE);
}

Segment suggestive_segment(const uint number, const uint kind)
{
    SuggestivePiece piece;
    suggestive_in_face(face_at(number), kind, piece);
    return Segment(vec4(piece.a, piece.ink_a), vec4(piece.b, piece.ink_b), number, piece.edge_a < 0 ? NONE : 3u * number + uint(piece.edge_a),
                   piece.edge_b < 0 ? NONE : 3u * number + uint(piece.edge_b), NONE);
}

vec3 point_of(const EdgeZero zero) { return at_zero(zero, positions[zero.from].xyz, positions[zero.to].xyz); }

Segment crease_segment(const uint element)
{
    CreaseSides s = crease_at(element / 3u);
    CreasePart part = part_of(s, int(element % 3u));
    vec3 points[4] = vec3[4](positions[s.own.x].xyz, point_of(zero_of(s.own, s.own_facing)), point_of(zero_of(s.other, s.other_facing)),
                             positions[s.own.y].xyz);
    uint ids[4] = uint[4](s.crease.start, s.crease.own, s.crease.twin, s.crease.end);
    uint own = s.crease.own / 3u;
    uint twin = s.crease.twin / 3u;
    return Segment(vec4(points[part.from], 1.0f), vec4(points[part.to], 1.0f), part.own_back ? twin : own, ids[part.from], ids[part.to],
                   part.own_back ? own : twin);
}

/// How many of a kind come before an element of a block.
uint rank(const uint block, const uint kind, const uint lane)
{
    uint before = sums[block][kind] + sums[level1 + block / 256u][kind] + sums[level2 + block / 65536u][kind];
    uint first = (block * KINDS + kind) * WORDS;
    for (uint word = 0u; word < lane / 32u; ++word)
        before += uint(bitCount(found[first + word]));
    return before + uint(bitCount(found[first + lane / 32u] & ((1u << (lane % 32u)) - 1u)));
}

void main()
{
    uint block = group_number();
    uint lane = gl_LocalInvocationIndex;
    if (block >= block_count)
        return;
    uint start = 0u;
    for (uint kind = 0u; kind < KINDS; ++kind) {
        if ((found[(block * KINDS + kind) * WORDS + lane / 32u] >> (lane % 32u) & 1u) != 0u) {
            uint at = start + rank(block, kind, lane);
            if (at < capacity) {
                if (block >= face_blocks)
                    segments[at] = crease_segment((block - face_blocks) * BLOCK + lane);
                else
                    segments[at] = kind == 0u ? contour_in_face(block * BLOCK + lane) : suggestive_segment(block * BLOCK + lane, kind);
            }
        }
        start += sums[total][kind];
    }
}
