// Which parts of a terrain may be seen, as SeenTerrain says (par_view.h).
#include "limn/gpu/shaders/terrain_eye.glsl"

layout(std430, binding = 5) readonly buffer Heights { float heights[]; };
layout(std430, binding = 6) readonly buffer Ranges { vec2 ranges[]; }; // lowest and highest sample around a lattice point

/// Outside the map that of the nearest sample.
float height_at(const ivec2 p) { ivec2 q = min(p, samples - 1); return heights[uint(q.y) * uint(samples.x) + uint(q.x)]; }

bool edge_seen(const ivec2 a, const ivec2 b)
{
    ivec2 along = abs(a - b);
    vec2 range = ranges[point_index(middle_of(a, b))];
    return box_seen(a + b, 0.5f * float(max(along.x, along.y)), range.x, range.y);
}

bool triangle_seen(const Triangle t)
{
    if (edge_can_split(t.a, t.b)) {
        ivec2 along = abs(t.a - t.b);
        vec2 range = ranges[point_index(middle_of(t.a, t.b))];
        return box_seen(t.a + t.b, along.x == along.y ? float(along.x) : 0.5f * float(max(along.x, along.y)), range.x, range.y);
    }
    ivec2 corners[3] = ivec2[3](t.apex, t.a, t.b);
    float low = 3.4e38f;
    float high = -3.4e38f;
    for (int k = 0; k < 3; ++k) {
        float height = height_at(corners[k]);
        if (all(lessThan(corners[k], samples)) && has_data(height)) {
            low = min(low, height);
            high = max(high, height);
        }
    }
    return box_seen(t.a + t.b, 1.0f, low, high);
}
