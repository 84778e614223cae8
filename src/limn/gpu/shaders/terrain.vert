// A corner of a piece of a terrain: vertices 3 i to 3 i + 2 are those of piece i.
#include "limn/gpu/shaders/terrain_eye.glsl"

layout(std430, binding = 0) readonly buffer Pieces { uvec4 drawn[]; };
layout(std430, binding = 1) readonly buffer Heights { float heights[]; };
uniform vec2 depths; // nearest and furthest that are drawn
flat out vec3 normal;
out float depth;

vec3 corner(const uint point)
{
    ivec2 p = ivec2(point & 0xffffu, point >> 16);
    return from_eye(2 * p, heights[uint(p.y) * uint(samples.x) + uint(p.x)] - eye_height);
}

void main()
{
    uvec4 piece = drawn[gl_VertexID / 3];
    vec3 corners[3] = vec3[3](corner(piece.x), corner(piece.y), corner(piece.z));
    normal = normalize(cross(corners[1] - corners[0], corners[2] - corners[0]));
    vec3 place = corners[gl_VertexID % 3];
    depth = dot(view.forward, place);
    vec2 plane = vec2(dot(view.right, place), dot(view.above, place)) / across;
    float range = depths.y - depths.x;
    if (view.is_parallel > 0.5f)
        gl_Position = vec4(plane, (2.0f * depth - (depths.x + depths.y)) / range, 1.0f);
    else
        gl_Position = vec4(plane, ((depths.x + depths.y) * depth - 2.0f * depths.x * depths.y) / range, depth);
}
