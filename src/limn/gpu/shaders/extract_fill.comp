// One thread a segment: finds the element whose bit stands for it (extract_count.comp), and writes it.
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

/// The last place in sums[first ... first + count) with no more than `before` of a kind before it.
uint last_not_after(const uint first, const uint count, const uint kind, const uint before)
{
    uint low = 0u;
    uint high = count;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (sums[first + middle][kind] <= before)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/// The element that holds line number `n` of a kind: down the levels of sums to its block, then to its bit.
uint element_of(const uint kind, const uint n)
{
    uint left = n;
    uint above = last_not_after(level2, total - level2, kind, left);
    left -= sums[level2 + above][kind];
    uint begin = 256u * above;
    above = begin + last_not_after(level1 + begin, min(256u, level2 - level1 - begin), kind, left);
    left -= sums[level1 + above][kind];
    begin = 256u * above;
    uint block = begin + last_not_after(begin, min(256u, block_count - begin), kind, left);
    left -= sums[block][kind];
    uint word = (block * KINDS + kind) * WORDS;
    uint lane = 0u;
    for (uint here = uint(bitCount(found[word])); left >= here; here = uint(bitCount(found[word]))) {
        left -= here;
        lane += 32u;
        ++word;
    }
    uint bits = found[word];
    for (; left > 0u; --left)
        bits &= bits - 1u; // without its lowest
    return block * BLOCK + lane + uint(findLSB(bits));
}

void main()
{
    uint at = group_number() * BLOCK + gl_LocalInvocationIndex;
    uvec4 number = sums[total];
    if (at >= min(number.x + number.y + number.z, capacity))
        return;
    uint kind = at < number.x ? 0u : (at < number.x + number.y ? 1u : 2u);
    uint element = element_of(kind, at - (kind == 0u ? 0u : (kind == 1u ? number.x : number.x + number.y)));
    if (element >= face_blocks * BLOCK)
        segments[at] = crease_segment(element - face_blocks * BLOCK);
    else if (kind == 0u)
        segments[at] = contour_in_face(element);
    else
        segments[at] = suggestive_segment(element, kind);
}
