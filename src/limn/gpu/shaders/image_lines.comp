// One thread a pixel: is it a line? Methods are those of limn::ImageMethod, in its order.
#include "limn/formulas/sobel.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(std430, binding = 0) readonly buffer Intensity { float intensity[]; };
layout(std430, binding = 1) readonly buffer WindowDepth { float depths[]; };
layout(std430, binding = 2) readonly buffer Nearness { float near_values[]; };
layout(std430, binding = 3) readonly buffer Normals { vec4 normals[]; };
layout(std430, binding = 4) readonly buffer Ids { uint ids[]; };
layout(std430, binding = 5) writeonly buffer Lines { uint lines[]; };
uniform ivec2 size;
uniform int method;
uniform float limit;        // of the method: dark, sobel, step or contrast
uniform float least_cosine;
uniform float relative;
uniform int radius;
uniform float reach;         // above 0: the radius where nearness is 1, px, instead
uniform float darker;

int index(const ivec2 p)
{
    ivec2 q = clamp(p, ivec2(0), size - 1);
    return q.y * size.x + q.x;
}
float pixel(const ivec2 p) { return intensity[index(p)]; }
float window_depth(const ivec2 p) { return depths[index(p)]; }
float nearness(const ivec2 p) { return near_values[index(p)]; }
vec3 normal_at(const ivec2 p) { return normals[index(p)].xyz; }
uint id_at(const ivec2 p) { return ids[index(p)]; }

#include "limn/formulas/image_lines.glsl"
#include "limn/formulas/valley.glsl"

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at.x >= size.x || at.y >= size.y)
        return;
    bool line = false;
    int window = reach > 0.0f ? radius_at(at, reach, relative) : radius;
    if (method == 0)
        line = is_dark(at, limit);
    else if (method == 1)
        line = is_depth_edge_raw(at, limit);
    else if (method == 2)
        line = is_depth_edge(at, limit, least_cosine, relative);
    else if (method == 3)
        line = is_valley_as_printed(at, window);
    else if (method == 4)
        line = is_valley(at, window, darker, limit);
    lines[index(at)] = line ? 1u : 0u;
}
