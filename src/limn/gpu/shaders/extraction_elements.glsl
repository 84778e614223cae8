// The elements that may hold lines: faces, and after them the parts of creases (three for each), dealt with in blocks of 256. Block b is done
// by work-group b.
#include "limn/formulas/crease_outline.glsl"
#include "limn/gpu/shaders/extraction.glsl"

const uint WORDS = 8u; // of 32 bits each, one bit for each element of a block
const uint KINDS = 3u; // contours, suggestive contours, suggestive highlights
const uint NONE = 0xffffffffu;

struct Crease {
    uint own;   // half-edge
    uint twin;  // the half-edge of the other side
    uint start; // ids of the vertices at its ends
    uint end;
};
layout(std430, binding = 1) readonly buffer Faces { uint corners[]; }; // three for each face
layout(std430, binding = 4) readonly buffer Creases { Crease creases[]; };
layout(std430, binding = 5) buffer Found { uint found[]; };            // per block and kind a bit for each element
layout(std430, binding = 6) buffer Sums { uvec4 sums[]; };             // per block the number of each kind, then as scan_blocks.comp says

uniform uint face_count;
uniform uint crease_count;
uniform uint face_blocks; // the blocks that hold faces
uniform uint block_count;
uniform uint front_only;            // bit k: kind k is left out on faces that are turned away

bool is_wanted(const uint kind) { return (wanted & (1u << kind)) != 0u; }

struct Face {
    uint vertices[3];
    vec3 points[3];
};

Face face_at(const uint number)
{
    Face face;
    for (int k = 0; k < 3; ++k) {
        face.vertices[k] = corners[3u * number + uint(k)];
        face.points[k] = positions[face.vertices[k]].xyz;
    }
    return face;
}

bool faces_eye(const Face face)
{
    return dot(cross(face.points[1] - face.points[0], face.points[2] - face.points[0]), to_eye(face.points[0])) > 0.0f;
}

/// @param kind  1 or 2
SuggestiveCorner corner_of(const uint vertex, const uint kind)
{
    vec4 v = values[vertex];
    vec2 speed = vec2(0.0f);
    if (limits[kind - 1u].speed_limit > 0.0f)
        speed = speeds[vertex];
    return SuggestiveCorner(vertex, v.y, kind == 1u ? v.z : v.w, speed.x, speed.y);
}

/// The piece of a suggestive line in a face whose corners differ in the sign of kr.
bool suggestive_in_face(const Face face, const uint kind, out SuggestivePiece piece)
{
    SuggestiveCorner all[3] = SuggestiveCorner[3](corner_of(face.vertices[0], kind), corner_of(face.vertices[1], kind), corner_of(face.vertices[2], kind));
    if (!(all[0].strength > 0.0f || all[1].strength > 0.0f || all[2].strength > 0.0f))
        return false;
    return suggestive_piece(all, face.points, limits[kind - 1u], piece);
}

uint corner_before(const uint half_edge) { return corners[half_edge]; }
uint corner_after(const uint half_edge) { return corners[half_edge % 3u == 2u ? half_edge - 2u : half_edge + 1u]; }

/// A crease with n.v of its two sides along it.
struct CreaseSides {
    Crease crease;
    uvec2 own;   // vertices of its own side, from start to end
    uvec2 other;
    vec2 own_facing;
    vec2 other_facing;
};

CreaseSides crease_at(const uint number)
{
    CreaseSides s;
    s.crease = creases[number];
    s.own = uvec2(corner_before(s.crease.own), corner_after(s.crease.own));
    s.other = uvec2(corner_after(s.crease.twin), corner_before(s.crease.twin));
    s.own_facing = vec2(values[s.own.x].x, values[s.own.y].x);
    s.other_facing = vec2(values[s.other.x].x, values[s.other.y].x);
    return s;
}

EdgeZero zero_of(const uvec2 side, const vec2 facing) { return edge_zero(side.x, side.y, facing.x, facing.y); }
float from_start(const EdgeZero zero, const uvec2 side) { return zero.from == side.x ? zero.t : 1.0f - zero.t; }

CreasePart part_of(const CreaseSides s, const int part)
{
    return crease_part(part, s.own_facing.x, s.own_facing.y, s.other_facing.x, s.other_facing.y, from_start(zero_of(s.own, s.own_facing), s.own),
                       from_start(zero_of(s.other, s.other_facing), s.other));
}
