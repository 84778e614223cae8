// Triangles between lattice points, as BisectionTriangle (lattice.h). A point is packed as x | y << 16.

uint pack_point(const ivec2 p) { return uint(p.x) | uint(p.y) << 16; }
ivec2 unpack_point(const uint p) { return ivec2(p & 0xffffu, p >> 16); }

struct Triangle {
    ivec2 apex;
    ivec2 a;
    ivec2 b;
};
Triangle triangle_of(const uvec4 e) { return Triangle(unpack_point(e.x), unpack_point(e.y), unpack_point(e.z)); }
uvec4 entry_for(const Triangle t, const uint bits) { return uvec4(pack_point(t.apex), pack_point(t.a), pack_point(t.b), bits); }
bool edge_can_split(const ivec2 a, const ivec2 b) { return max(abs(a.x - b.x), abs(a.y - b.y)) >= 2; }
ivec2 middle_of(const ivec2 a, const ivec2 b) { return (a + b) / 2; }
Triangle left_of(const Triangle t) { return Triangle(middle_of(t.a, t.b), t.apex, t.a); }
Triangle right_of(const Triangle t) { return Triangle(middle_of(t.a, t.b), t.b, t.apex); }
