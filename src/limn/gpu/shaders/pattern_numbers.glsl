// The numbers of patterns as PatternRenderer packs them, and what all patterns read of them.
#include "limn/formulas/pattern_eye.glsl"
#include "limn/formulas/brdf.glsl"
#include "limn/formulas/periodic_blur.glsl"

struct PatternNumbers {
    vec4 turn_x; // columns of the rotation from the scene's frame; w: scale
    vec4 turn_y;
    vec4 turn_z;
    vec4 shift;
    vec4 eye;    // w: 1 in parallel views
    vec4 forward;
    vec4 right;
    vec4 down;
    vec4 to_light; // w: radius
    vec4 light;    // w: 1 for a lamp
    vec4 up;
    vec4 above;
    vec4 below;
    vec4 lamp;
    vec4 intensity;
    vec4 falloff;
    vec4 own[6];   // of the kind of pattern
};
#if OWN_PATTERNS // each object has one of its own
layout(std430, binding = 3) readonly buffer Patterns { PatternNumbers patterns[]; };
#else // software renderers read uniforms once, and buffers for each pixel
layout(std140, binding = 0) uniform Pattern { PatternNumbers pattern; };
#endif

PatternEye eye_of(const PatternNumbers p, const vec2 middle)
{
    return PatternEye(p.eye.xyz, p.forward.xyz, p.right.xyz, p.down.xyz, middle, int(p.eye.w));
}

Illumination light_of(const PatternNumbers p, const vec3 position)
{
    Illumination lit = Illumination(p.to_light.xyz, p.light.xyz, p.to_light.w, p.up.xyz, p.above.xyz, p.below.xyz);
    return p.light.w > 0.5f ? lit_by_point(lit, p.lamp.xyz, p.intensity.xyz, p.falloff.xyz, position) : lit;
}

Finish finish_of(const int model, const vec4 a, const vec4 b)
{
    return Finish(model, a.xyz, a.w, b.x, b.y, b.z, b.w);
}
