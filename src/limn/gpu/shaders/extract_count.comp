// One thread an element: which kinds of line does it hold? Bits in the order of the elements, so that nothing depends on a race.
#include "limn/gpu/shaders/extraction_elements.glsl"

layout(local_size_x = 256) in;
shared uint bits[KINDS * WORDS];

/// Bit k: a line of kind k.
uint kinds_in_face(const uint number)
{
    Face face = face_at(number);
    vec4 v0 = values[face.vertices[0]];
    vec4 v1 = values[face.vertices[1]];
    vec4 v2 = values[face.vertices[2]];
    uint kinds = 0u;
    if (is_wanted(0u) && ((v0.x < 0.0f) != (v1.x < 0.0f) || (v1.x < 0.0f) != (v2.x < 0.0f)))
        kinds |= 1u;
    if ((wanted & 6u) == 0u || ((v0.y < 0.0f) == (v1.y < 0.0f) && (v1.y < 0.0f) == (v2.y < 0.0f)))
        return kinds;
    uint possible = wanted & (faces_eye(face) ? 6u : 6u & ~front_only);
    for (uint kind = 1u; kind < KINDS; ++kind) {
        SuggestivePiece piece;
        if ((possible & (1u << kind)) != 0u && suggestive_in_face(face, kind, piece))
            kinds |= 1u << kind;
    }
    return kinds;
}

uint kinds_of(const uint block, const uint lane)
{
    if (block < face_blocks) {
        uint face = block * BLOCK + lane;
        return face < face_count ? kinds_in_face(face) : 0u;
    }
    uint part = (block - face_blocks) * BLOCK + lane;
    return is_wanted(0u) && part < 3u * crease_count && part_of(crease_at(part / 3u), int(part % 3u)).drawn ? 1u : 0u;
}

void main()
{
    uint block = group_number();
    uint lane = gl_LocalInvocationIndex;
    if (block >= block_count)
        return; // the whole group
    if (lane < KINDS * WORDS)
        bits[lane] = 0u;
    barrier();
    uint kinds = kinds_of(block, lane);
    for (uint kind = 0u; kind < KINDS; ++kind)
        if ((kinds & (1u << kind)) != 0u)
            atomicOr(bits[kind * WORDS + lane / 32u], 1u << (lane % 32u));
    barrier();
    if (lane < KINDS * WORDS)
        found[block * KINDS * WORDS + lane] = bits[lane];
    if (lane == 0u) {
        uvec4 number = uvec4(0u);
        for (uint kind = 0u; kind < KINDS; ++kind)
            for (uint word = 0u; word < WORDS; ++word)
                number[kind] += uint(bitCount(bits[kind * WORDS + word]));
        sums[block] = number;
    }
}
