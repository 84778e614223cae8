// Cloth of crossing threads around a sphere, with square holes (the procedural structures specification, 2.7). Threads of one kind run around
// the axis y ("level"), those of the other from pole to pole ("upright").
#pragma once
#include "limn/formulas/brdf.glsl"
#include "limn/formulas/pattern_point.glsl"
#include "limn/formulas/periodic_blur.glsl"
#include "limn/formulas/pulse.glsl"

struct ThreadPattern {
    float hole;     // width of a hole and of a thread, as parts of the way around
    float thread;
    vec3 colour;    // linear
    float specular;
    float exponent;
    float cone;     // -1: highlights about the mirror cone; 1: as the seed prints it
    float gate;     // 1: nothing is lit from behind; 0: as the seed
    int woven;      // 1: threads pass over each other in turn; 0: level ones are always above
};

// Around the axis and from pole to pole, both in [0,1), from the sphere's unit normal.
FORMULA vec2 sphere_place(const vec3 n)
{
    float u = n.x == 0.0f && n.z == 0.0f ? 0.0f : atan(n.x, n.z) / 6.28318530718f;
    return vec2(fract(u), atan(sqrt(n.x * n.x + n.z * n.z), n.y) / 3.14159265359f); // acos loses digits at the poles, and on devices everywhere
}

// How much that changes for a step of the normal.
FORMULA vec2 sphere_change(const vec3 n, const vec3 move)
{
    float across = max(n.x * n.x + n.z * n.z, 1e-8f);
    return vec2((n.z * move.x - n.x * move.z) / (6.28318530718f * across), -move.y / (3.14159265359f * sqrt(across)));
}

// Direction of the level threads; at the poles, which have none, x.
FORMULA vec3 level_tangent(const vec3 n)
{
    float size = n.x * n.x + n.z * n.z;
    return size < 1e-10f ? vec3(1.0f, 0.0f, 0.0f) : vec3(n.z, 0.0f, -n.x) * inversesqrt(size);
}

FORMULA vec3 upright_tangent(const vec3 n)
{
    return normalize(cross(n, level_tangent(n)));
}

// Half a thread as a part of a cell.
FORMULA float thread_part(const ThreadPattern c)
{
    return 0.5f * c.thread / (c.thread + c.hole);
}

// What covers a place: 0 a hole, 1 a level thread, 2 an upright one. `at` counts cells.
FORMULA int thread_mask(const ThreadPattern c, const vec2 at)
{
    float m = thread_part(c);
    bool upright = pulse(m, fract(at.x)) < 0.5f;
    bool level = pulse(m, fract(at.y)) < 0.5f;
    if (level && upright && c.woven != 0) { // the crossing belongs to the nearest corner of cells
        float turn = floor(at.x + 0.5f) + floor(at.y + 0.5f);
        return fract(0.5f * turn) < 0.25f ? 1 : 2;
    }
    return level ? 1 : (upright ? 2 : 0);
}

// Radiance of thread with a tangent, on the side of a normal.
FORMULA vec3 thread_lit(const ThreadPattern c, const vec3 t, const vec3 n, const vec3 to_eye, const Illumination lit)
{
    float open = mix(1.0f, smoothstep(-0.2f, 0.2f, dot(n, lit.to_light)), c.gate);
    vec3 shine = c.colour * (hair_diffuse(t, lit.to_light) / BRDF_PI) +
                 vec3(1.0f, 1.0f, 1.0f) * (c.specular * hair_specular(t, lit.to_light, to_eye, c.exponent, c.cone));
    return lit.light * shine * open + c.colour * ambient_around(lit, n);
}

// Radiance, premultiplied, and opacity of a place without any filter. n is the sphere's, towards the eye or away.
FORMULA vec4 thread_at(const ThreadPattern c, const vec3 n, const vec3 seen, const vec3 to_eye, const Illumination lit)
{
    int kind = thread_mask(c, sphere_place(n) / (c.hole + c.thread));
    if (kind == 0)
        return vec4(0.0f, 0.0f, 0.0f, 0.0f);
    return vec4(thread_lit(c, kind == 1 ? level_tangent(n) : upright_tangent(n), seen, to_eye, lit), 1.0f);
}

// Shares of the kernel that even and odd threads cover along a coordinate that counts cells; where they are not to be told apart, all are even.
FORMULA vec2 thread_shares(const float at, const float m, const bool apart, const Blur blur)
{
    if (!apart)
        return vec2(blurred_pulse(at, -m, 2.0f * m, blur), 0.0f);
    Blur pairs = blur_of(blur.kernel, 0.5f * blur.a, 0.5f * blur.b);
    SawEnds s = blurred_saw_ends(0.5f * at, 0.5f * m, true, pairs);
    return clamp(vec2(m + s.after.here.x - s.before.here.x, m + s.after.half_on.x - s.before.half_on.x), vec2(0.0f, 0.0f), vec2(1.0f, 1.0f));
}

// The same through a kernel: each kind of thread is shaded once, with its share of the kernel. p's position is the sphere's normal, p's steps
// are those of the normal.
FORMULA vec4 thread_through(const ThreadPattern c, const PatternPoint p, const int kernel, const float width, const Illumination lit)
{
    vec3 n = p.position;
    if (kernel == KERNEL_NONE)
        return thread_at(c, n, p.normal, p.to_eye, lit);
    float cell = c.hole + c.thread;
    float m = thread_part(c);
    vec2 at = sphere_place(n) / cell;
    vec2 right = sphere_change(n, p.right) / cell;
    vec2 down = sphere_change(n, p.down) / cell;
    Blur along_u = blur_along(kernel, width, vec2(right.x, down.x));
    Blur along_v = blur_along(kernel, width, vec2(right.y, down.y));
    vec2 upright_threads = thread_shares(at.x, m, c.woven != 0, along_u);
    vec2 level_threads = thread_shares(at.y, m, c.woven != 0, along_v);
    float upright = upright_threads.x + upright_threads.y;
    float level = level_threads.x + level_threads.y;
    float crossing = upright * level;
    float over = 1.0f; // share of the crossings where the level thread is above
    if (c.woven != 0) {
        float u = upright_threads.x - upright_threads.y;
        float v = level_threads.x - level_threads.y;
        over = crossing > 1e-6f ? clamp(0.5f + 0.5f * u * v / crossing, 0.0f, 1.0f) : 0.5f;
    }
    ThreadPattern seen = c; // what the sphere turns within the kernel widens highlights
    float turn = (kernel == KERNEL_GAUSS ? width * width : width * width / 12.0f) * 0.5f * (dot(p.right, p.right) + dot(p.down, p.down));
    seen.exponent = c.exponent / (1.0f + c.exponent * min(turn, 1.0f));
    float level_share = level - crossing * (1.0f - over);
    float upright_share = upright - crossing * over;
    vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    if (level_share > 1e-4f)
        sum = level_share * thread_lit(seen, level_tangent(n), p.normal, p.to_eye, lit);
    if (upright_share > 1e-4f)
        sum = sum + upright_share * thread_lit(seen, upright_tangent(n), p.normal, p.to_eye, lit);
    return vec4(sum, level_share + upright_share);
}

// Cloth laid on any surface from a middle out: p as the surface has it.
FORMULA vec4 thread_around(const ThreadPattern c, const vec3 centre, const PatternPoint p, const int kernel, const float width, const Illumination lit)
{
    PatternPoint on = p;
    vec3 out_of = p.position - centre;
    float away = length(out_of);
    on.position = out_of / away;
    on.right = p.right / away;
    on.down = p.down / away;
    on.normal = dot(on.position, p.to_eye) < 0.0f ? -on.position : on.position; // of the side that is seen
    return thread_through(c, on, kernel, width, lit);
}
