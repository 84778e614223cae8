// Marks the pixels on outlines and folds: those that take several samples.
#include "limn/formulas/pattern_picture.glsl"
#include "limn/gpu/shaders/pattern_side.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(binding = 3) uniform sampler2D sides; // of pattern_surface.frag
layout(std430, binding = 7) writeonly buffer Mask { uint mask[]; };
uniform ivec2 size;
uniform vec3 eye;
uniform vec3 forward;
uniform vec3 right;       // per pixel, at depth 1 (at any depth in parallel views)
uniform vec3 down;
uniform int orthographic;
uniform vec2 corner;      // as in pattern_seen.glsl
uniform vec2 middle;
uniform float pixel_size; // at depth 1; at any depth in parallel views

SeenPlace place_at(const ivec2 p)
{
    vec4 seen = texelFetch(sides, p, 0);
    if (seen.w == 0.0f)
        return SeenPlace(vec3(0.0f), vec3(0.0f), 0.0f);
    SeenSide side = side_of(seen);
    PatternEye seen_by = PatternEye(eye, forward, right, down, middle, orthographic);
    vec3 position = place_at_depth(seen_by, corner + vec2(float(p.x) + 0.5f, -float(p.y) - 0.5f), side.depth);
    vec3 to_eye = way_to_eye(seen_by, position);
    return SeenPlace(position, seen_normal(outside_of(side.face, to_eye), to_eye), orthographic != 0 ? pixel_size : pixel_size * side.depth);
}

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at.x >= size.x || at.y >= size.y)
        return;
    SeenPlace own = place_at(at);
    bool edge = false;
    for (int y = max(at.y - 1, 0); y <= min(at.y + 1, size.y - 1); ++y)
        for (int x = max(at.x - 1, 0); x <= min(at.x + 1, size.x - 1); ++x)
            edge = edge || is_outline(own, place_at(ivec2(x, y)));
    mask[at.y * size.x + at.x] = edge ? 1u : 0u;
}
