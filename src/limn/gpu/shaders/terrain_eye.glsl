// A camera over a terrain in single precision: the eye is so many whole cells and a rest away from the lattice's south-western point, so that places
// near it lose no digits.
#include "limn/formulas/terrain_bound.glsl"

uniform ivec2 samples;     // columns and rows of the map
uniform ivec2 points;      // of the lattice
uniform vec2 spacing;
uniform ivec2 eye_cell;
uniform vec3 eye_rest;
uniform float eye_height;
uniform BoundCamera view;
uniform vec2 across;       // half of the picture at depth 1
uniform float margin;      // metres, more than what rounding moves
uniform uint cull;

/// Whether a height is a number: by its bits, since compilers take liberties with comparisons.
bool has_data(const float height) { return (floatBitsToUint(height) & 0x7fffffffu) <= 0x7f800000u; }
uint point_index(const ivec2 p) { return uint(p.y) * uint(points.x) + uint(p.x); }

/// A place relative to the eye.
/// @param twice  twice the lattice point
/// @param z  metres above `eye_height`
vec3 from_eye(const ivec2 twice, const float z)
{
    ivec2 cells = ivec2(twice.x, 2 * (samples.y - 1) - twice.y) - 2 * eye_cell;
    return vec3(0.5f * vec2(cells) * spacing, z) - eye_rest;
}

/// Whether something may be seen in a box around half of `twice`, `cells` to each side, between two heights.
bool box_seen(const ivec2 twice, const float cells, const float low, const float high)
{
    if (!(low <= high))
        return false;
    float z = 0.5f * ((low - eye_height) + (high - eye_height));
    return box_may_be_seen(view, across, from_eye(twice, z), vec3(cells * spacing, 0.5f * (high - low)), 2.0f * margin);
}
