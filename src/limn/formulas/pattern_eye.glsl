// A camera in the frame of a pattern: lines of sight, and how far a surface moves from pixel to pixel (the procedural structures specification,
// 2.9 and 2.10).
#pragma once
#include "limn/formulas/pattern_point.glsl"
#include "limn/formulas/supersampling.glsl"

struct PatternEye {
    vec3 place;    // of the eye
    vec3 forward;  // unit
    vec3 right;    // of a pixel: at depth 1, or at any depth in parallel views
    vec3 down;
    vec2 middle;   // of the picture, pixels
    int parallel;  // 1: lines of sight are
};

// A point in another frame: turned, scaled, and then moved.
FORMULA vec3 framed(const mat3 turn, const float scale, const vec3 shift, const vec3 p)
{
    return (turn * p) * scale + shift;
}

// Direction of the line of sight through a place of the picture, of any length; its depth is 1.
FORMULA vec3 pattern_sight(const PatternEye eye, const vec2 pixel)
{
    if (eye.parallel != 0)
        return eye.forward;
    vec2 off = pixel - eye.middle;
    return eye.forward + eye.right * off.x + eye.down * off.y;
}

// The place at a depth that a place of the picture shows.
FORMULA vec3 place_at_depth(const PatternEye eye, const vec2 pixel, const float depth)
{
    if (eye.parallel == 0)
        return eye.place + pattern_sight(eye, pixel) * depth;
    vec2 off = pixel - eye.middle;
    return eye.place + eye.right * off.x + eye.down * off.y + eye.forward * depth;
}

// Unit.
FORMULA vec3 way_to_eye(const PatternEye eye, const vec3 position)
{
    return eye.parallel != 0 ? -eye.forward : normalize(eye.place - position);
}

// What a pattern has to know of a place of a surface. `face_normal` is that of the plane around it.
FORMULA PatternPoint seen_point(const PatternEye eye, const vec3 position, const vec3 normal, const vec3 face_normal, const vec3 to_eye)
{
    float depth = eye.parallel != 0 ? 1.0f : dot(position - eye.place, eye.forward);
    vec3 line = eye.parallel != 0 ? eye.forward : position - eye.place;
    PatternPoint p = {position, normal, to_eye, step_on_plane(eye.right * depth, line, face_normal), step_on_plane(eye.down * depth, line, face_normal)};
    return p;
}

// The place of that plane which another place of the picture shows; the same one where there is none.
FORMULA vec3 plane_place(const PatternEye eye, const vec3 position, const vec3 face_normal, const vec2 pixel, const vec2 other)
{
    if (eye.parallel == 0)
        return eye.place + meet_plane(normalize(pattern_sight(eye, other)), position - eye.place, face_normal);
    vec2 off = other - pixel;
    return position + step_on_plane(eye.right * off.x + eye.down * off.y, eye.forward, face_normal);
}
