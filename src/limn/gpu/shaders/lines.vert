// Six vertices for each segment of a buffer: two triangles in the picture around it, wide enough for round ends.
#include "limn/gpu/shaders/segments.glsl"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Faces { uint corners[]; };
layout(std430, binding = 7) readonly buffer Segments { Segment segments[]; };
uniform mat4 to_clip;
uniform vec3 eye; // position, or the direction towards it
uniform int orthographic;
uniform vec2 size; // of the picture, px
uniform float width; // px

flat out vec3 begin; // px, and the depth in the window of the place that hides it if it is nearer
flat out vec3 end;
flat out vec2 ink;

/// How far the corners of a face lie apart in depth: what is within that of a line on it belongs to the same piece of surface.
float thickness(const uint face)
{
    vec3 towards = orthographic != 0 ? eye : normalize(eye - positions[corners[3u * face]].xyz);
    float d0 = dot(towards, positions[corners[3u * face]].xyz);
    float d1 = dot(towards, positions[corners[3u * face + 1u]].xyz);
    float d2 = dot(towards, positions[corners[3u * face + 2u]].xyz);
    return max(max(d0, d1), d2) - min(min(d0, d1), d2);
}

/// Window coordinates; z a little nearer than the place.
vec3 window(const vec3 place, const float nearer)
{
    vec3 towards = orthographic != 0 ? eye : normalize(eye - place);
    vec4 clip = to_clip * vec4(place, 1.0f);
    vec4 near_clip = to_clip * vec4(place + nearer * towards, 1.0f);
    float z = near_clip.w > 0.0f ? near_clip.z / near_clip.w : -1.0f;
    return vec3((0.5f * clip.xy / clip.w + 0.5f) * size, 0.5f * z + 0.5f);
}

void main()
{
    Segment s = segments[gl_VertexID / 6];
    vec4 clip_a = to_clip * vec4(s.a.xyz, 1.0f);
    vec4 clip_b = to_clip * vec4(s.b.xyz, 1.0f);
    // What lies behind the near plane is cut off.
    float from_a = clip_a.z + clip_a.w;
    float from_b = clip_b.z + clip_b.w;
    if (from_a <= 0.0f && from_b <= 0.0f) {
        gl_Position = vec4(0.0f, 0.0f, 2.0f, 1.0f); // outside
        begin = vec3(0.0f);
        end = vec3(0.0f);
        ink = vec2(0.0f);
        return;
    }
    float cut = from_a / (from_a - from_b);
    vec4 a = from_a <= 0.0f ? mix(s.a, s.b, cut) : s.a;
    vec4 b = from_b <= 0.0f ? mix(s.a, s.b, cut) : s.b;
    float nearer = thickness(s.face) + 1e-4f;
    begin = window(a.xyz, nearer);
    end = window(b.xyz, nearer);
    ink = vec2(a.w, b.w);

    vec2 along = end.xy - begin.xy;
    along = dot(along, along) > 0.0f ? normalize(along) : vec2(1.0f, 0.0f);
    vec2 across = vec2(-along.y, along.x);
    const int corner_of[6] = int[6](0, 1, 2, 2, 1, 3);
    int corner = corner_of[gl_VertexID % 6];
    float reach = 0.5f * width + 1.0f;
    vec2 place = ((corner & 1) == 0 ? begin.xy - reach * along : end.xy + reach * along) + ((corner & 2) == 0 ? -reach : reach) * across;
    gl_Position = vec4(2.0f * place / size - 1.0f, 0.0f, 1.0f);
}
