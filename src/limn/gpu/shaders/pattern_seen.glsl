// One point of a surface that is made of a pattern: light (premultiplied) and opacity, from what pattern_surface.frag saw at a pixel. The file that includes this
// has pattern_at() and marked() of its kind of pattern. What does not change in a picture is a macro, so that the device computes nothing in vain; tables are
// textures, which software renderers read for several pixels at once:
// TABLE_WIDTH (texels), OWN_PATTERNS, PATTERN_KERNEL, PATTERN_SAMPLED (0 where cusps are shown).
#include "limn/formulas/pattern_picture.glsl"
#include "limn/gpu/shaders/pattern_side.glsl"

layout(binding = 2) uniform sampler2D samples; // of the pattern in a pixel: x and y by turns, row by row
layout(binding = 3) uniform sampler2D sides; // of pattern_surface.frag
uniform int sample_count;
uniform vec3 eye;           // its place; of parallel views, one on the line of sight through the picture's middle
uniform vec3 forward;       // unit
uniform vec3 right;         // per pixel, at depth 1 (at any depth in parallel views)
uniform vec3 down;
uniform int orthographic;
uniform vec2 corner;        // the tile's lower left corner, px from the picture's upper left one, y down, with the offset of the sample
uniform vec2 middle;        // of the picture, px
uniform float kernel_width;
uniform int flat_faces;     // 1: faces are shaded by their own normals

vec3 position; // of the pixel's place
layout(location = 0) out vec4 colour;

vec4 through(const PatternNumbers numbers, const vec3 n, const vec3 face, const vec3 to_eye, const vec2 pixel)
{
    mat3 turn = mat3(numbers.turn_x.xyz, numbers.turn_y.xyz, numbers.turn_z.xyz);
    PatternEye seen_by = eye_of(numbers, middle);
    vec3 at = framed(turn, numbers.turn_x.w, numbers.shift.xyz, position);
    vec3 own_normal = turn * n;
    vec3 own_face = turn * face;
#if PATTERN_SAMPLED
    vec4 sum = vec4(0.0f);
    for (int k = 0; k < sample_count; ++k) {
        ivec2 place = ivec2((2 * k) % TABLE_WIDTH, (2 * k) / TABLE_WIDTH);
        vec2 off = vec2(texelFetch(samples, place, 0).x, texelFetch(samples, place + ivec2(1, 0), 0).x);
        vec3 on = plane_place(seen_by, at, own_face, pixel, pixel + off);
        PatternPoint p = PatternPoint(on, own_normal, way_to_eye(seen_by, on), vec3(0.0f), vec3(0.0f));
        sum += pattern_at(numbers, p, KERNEL_NONE, 0.0f, light_of(numbers, on));
    }
    return sum / float(sample_count);
#else
    return pattern_at(numbers, seen_point(seen_by, at, own_normal, own_face, turn * to_eye), PATTERN_KERNEL, kernel_width, light_of(numbers, at));
#endif
}

void main()
{
    SeenSide side = side_of(texelFetch(sides, ivec2(gl_FragCoord.xy), 0));
    PatternEye seen_by = PatternEye(eye, forward, right, down, middle, orthographic);
    vec2 pixel = corner + vec2(gl_FragCoord.x, -gl_FragCoord.y);
    position = place_at_depth(seen_by, pixel, side.depth);
    vec3 to_eye = way_to_eye(seen_by, position);
    vec3 outside = outside_of(side.face, to_eye);
    vec3 face = seen_normal(outside, to_eye);
    vec3 n = flat_faces != 0 || dot(side.normal, side.normal) == 0.0f ? face : side.normal;
    if (dot(n, face) < 0.0f)
        n = -n;
#if OWN_PATTERNS
    PatternNumbers numbers = patterns[uint(side.face.w + 0.5f)];
#else
    PatternNumbers numbers = pattern;
#endif
    colour = marked(numbers, through(numbers, n, face, to_eye, pixel), n, outside, to_eye);
}
