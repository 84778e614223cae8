// The fields that lines are found in (limn::LineFields), rows from the top.
layout(local_size_x = 16, local_size_y = 16) in;
layout(binding = 0) uniform sampler2D shape;
layout(binding = 1) uniform sampler2D lit;
layout(binding = 2) uniform usampler2D seen;
layout(std430, binding = 0) writeonly buffer Intensity { float intensity[]; };
layout(std430, binding = 1) writeonly buffer WindowDepth { float depths[]; };
layout(std430, binding = 2) writeonly buffer Nearness { float near_values[]; };
layout(std430, binding = 3) writeonly buffer Normals { vec4 normals[]; };
layout(std430, binding = 4) writeonly buffer Ids { uint ids[]; };
layout(std430, binding = 6) readonly buffer Range { uint least; uint most; };
uniform ivec2 size;
uniform int orthographic;
uniform float middle; // depth of the scene's centre; orthographic views only

float depth_of(const uint key) { return uintBitsToFloat((key & 0x80000000u) != 0u ? key & 0x7fffffffu : ~key); }

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at.x >= size.x || at.y >= size.y)
        return;
    int i = (size.y - 1 - at.y) * size.x + at.x;
    uint id = texelFetch(seen, at, 0).x;
    vec4 s = texelFetch(shape, at, 0);
    float near_plane = 0.95f * depth_of(least);
    float far_plane = 1.05f * depth_of(most);
    float range = far_plane - near_plane;
    ids[i] = id;
    normals[i] = id != 0u ? vec4(s.xyz, 0.0f) : vec4(0.0f);
    intensity[i] = id != 0u ? texelFetch(lit, at, 0).x : 1.0f;
    float window = orthographic != 0 ? (s.w - near_plane) / range : far_plane / range * (1.0f - near_plane / s.w);
    depths[i] = id != 0u ? window : 1.0f;
    float nearness = orthographic != 0 ? 2.0f - (s.w - middle) : 1.0f / s.w;
    near_values[i] = id != 0u ? nearness : 0.0f;
}
