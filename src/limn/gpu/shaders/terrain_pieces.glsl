// What a triangle is drawn as: the part of it that is inside the map, as a fan of triangles between samples with data (terrain_mesh.h does the same).
#include "limn/gpu/shaders/terrain_lists.glsl"
#include "limn/gpu/shaders/terrain_seen.glsl"

// Places in `arguments`.
const uint PIECES_COUNT = 9u;
const uint PIECES_SCAN = 10u;
const uint PIECES_FILL = 11u;

struct Polygon {
    ivec2 corners[5];
    int count;
};

/// Without what is beyond the last column (axis 0) or row (axis 1). Edges are horizontal, vertical or diagonal, so they cross it at samples.
Polygon clip_beyond(const Polygon whole, const int axis, const int last)
{
    Polygon part;
    part.count = 0;
    for (int i = 0; i < whole.count; ++i) {
        ivec2 p = whole.corners[i];
        ivec2 q = whole.corners[i + 1 < whole.count ? i + 1 : 0];
        if (p[axis] <= last)
            part.corners[part.count++] = p;
        if ((p[axis] < last && q[axis] > last) || (p[axis] > last && q[axis] < last)) {
            int across_edge = q[1 - axis] - p[1 - axis];
            ivec2 crossing;
            crossing[axis] = last;
            crossing[1 - axis] = p[1 - axis] + sign(across_edge) * (abs(last - p[axis]));
            part.corners[part.count++] = crossing;
        }
    }
    return part;
}

/// The polygon begins with its first sample, row by row: whichever way its corners are named, it is the same fan.
Polygon polygon_of(const Triangle t)
{
    Polygon whole;
    whole.corners[0] = t.apex;
    whole.corners[1] = t.a;
    whole.corners[2] = t.b;
    whole.count = 3;
    ivec2 high = max(t.apex, max(t.a, t.b));
    if (all(lessThan(high, samples)))
        return whole;
    Polygon part = clip_beyond(clip_beyond(whole, 0, samples.x - 1), 1, samples.y - 1);
    int first = 0;
    for (int i = 1; i < part.count; ++i) {
        ivec2 p = part.corners[i];
        ivec2 least = part.corners[first];
        if (p.y < least.y || (p.y == least.y && p.x < least.x))
            first = i;
    }
    Polygon turned;
    turned.count = part.count;
    for (int i = 0; i < part.count; ++i)
        turned.corners[i] = part.corners[(first + i) % part.count];
    return turned;
}

bool is_piece(const ivec2 p, const ivec2 q, const ivec2 r)
{
    ivec2 u = q - p;
    ivec2 v = r - p;
    return u.x * v.y != u.y * v.x && has_data(height_at(p)) && has_data(height_at(q)) && has_data(height_at(r));
}

uint pieces_of(const Triangle t)
{
    if (cull != 0u && !triangle_seen(t))
        return 0u;
    Polygon part = polygon_of(t);
    uint number = 0u;
    for (int i = 2; i < part.count; ++i)
        number += is_piece(part.corners[0], part.corners[i - 1], part.corners[i]) ? 1u : 0u;
    return number;
}
