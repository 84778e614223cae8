// PAR's test of an edge, as middle_height_test() and screen_height_test() (par.h). Comes after terrain_eye.glsl and height_at().
#include "limn/formulas/terrain_error.glsl"

uniform uint on_screen;   // 1: `tolerance` is in pixels, 0: metres
uniform float tolerance;

bool is_too_far_off(const ivec2 a, const ivec2 b)
{
    ivec2 p = middle_of(a, b);
    float at_a = height_at(a);
    float at_b = height_at(b);
    float at_p = height_at(p);
    int known = int(has_data(at_a)) + int(has_data(at_b)) + int(has_data(at_p));
    if (known < 3)
        return known > 0;
    float off = height_off_chord(at_a, at_p, at_b);
    if (on_screen == 0u)
        return abs(off) > tolerance;
    ErrorCamera camera = ErrorCamera(view.right, view.above, view.forward, view.scale, view.near_depth, view.is_parallel);
    vec3 place = from_eye(2 * p, 0.5f * ((at_a - eye_height) + (at_b - eye_height)));
    return max(height_error_exact(camera, place, off), height_error_any_way(camera, place, off)) > tolerance;
}
