// The parallel Euclidean distance transform (Yamada 1984; silhouette-loop specification, 2.12): each pixel holds the vector to the nearest
// marked pixel that it has heard of, and hears what its neighbours hold.
// Included inside a struct (C++) or a shader (GLSL) that offers uint vector_at(const ivec2 p): what pixel p holds, no_vector() outside of the
// picture. No include guard: every such struct needs its own copy.

// A vector as one number: components + 32768, x in the upper half.
FORMULA uint no_vector() { return 0xFFFFFFFFu; }
FORMULA uint packed_vector(const ivec2 v) { return (uint(v.x + 32768) << 16u) | uint(v.y + 32768); }
FORMULA ivec2 unpacked_vector(const uint v) { return ivec2(int(v >> 16u) - 32768, int(v & 65535u) - 32768); }

// The neighbours in the order that decides between equally near pixels: right, upper right and so on counter-clockwise; rows count down.
FORMULA ivec2 neighbour_step(const int i)
{
    int x = i == 2 || i == 6 ? 0 : (i > 2 && i < 6 ? -1 : 1);
    int y = i == 0 || i == 4 ? 0 : (i < 4 ? -1 : 1);
    return ivec2(x, y);
}

// One pass for one pixel: the nearest of what it holds and what its neighbours hold, seen from here. `stride` 1: all eight; 2: the four
// that share a side.
FORMULA uint nearest_vector(const ivec2 at, const int stride)
{
    uint best = vector_at(at);
    ivec2 own = unpacked_vector(best);
    int least = best == no_vector() ? 2147483647 : own.x * own.x + own.y * own.y;
    for (int i = 0; i < 8; i += stride) {
        ivec2 towards = neighbour_step(i);
        uint held = vector_at(at + towards);
        if (held == no_vector())
            continue;
        ivec2 v = unpacked_vector(held) + towards;
        int distance2 = v.x * v.x + v.y * v.y;
        if (distance2 < least) {
            least = distance2;
            best = packed_vector(v);
        }
    }
    return best;
}
