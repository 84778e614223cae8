// Zero sets of quantities that are linear along the edges of a face (contour-lines specification 2.2): where they cross an edge, and
// which edges of a face. One text for C++ and GLSL. 0 counts as positive everywhere.
#pragma once

// The place on an edge where a quantity is zero.
struct EdgeZero {
    uint from; // the two vertices in ascending order
    uint to;
    float t;   // parameter from `from` to `to`, in [0,1]
};

// The two vertices are ordered before anything is computed, so both faces of the edge get the same bits.
// The signs of fi and fj must differ.
FORMULA EdgeZero edge_zero(const uint i, const uint j, const float fi, const float fj)
{
    bool ascending = i < j;
    float first = ascending ? fi : fj;
    float second = ascending ? fj : fi;
    EdgeZero zero = EdgeZero(ascending ? i : j, ascending ? j : i, first / (first - second));
    return zero;
}

// A quantity there from its values at `from` and `to`.
FORMULA float at_zero(const EdgeZero zero, const float at_from, const float at_to) { return at_from + zero.t * (at_to - at_from); }
FORMULA vec3 at_zero(const EdgeZero zero, const vec3 at_from, const vec3 at_to) { return at_from + zero.t * (at_to - at_from); }

// The odd corner of a face: the one whose sign differs from the other two, from three sign bits that are not all equal.
FORMULA int odd_corner(const bool s0, const bool s1, const bool s2) { return s1 == s2 ? 0 : (s0 == s2 ? 1 : 2); }

// Edge k of a face runs from its corner k to the next.
struct CrossedEdges {
    int enter;
    int leave;
};

// The edges that a line enters and leaves a face by, which keeps the positive side to its right seen from outside. A line leaves a face by
// the edge that it enters the next face by.
FORMULA CrossedEdges crossed_edges(const bool negative0, const bool negative1, const bool negative2)
{
    int odd = odd_corner(negative0, negative1, negative2);
    int arriving = (odd + 2) % 3;
    bool odd_negative = odd == 0 ? negative0 : (odd == 1 ? negative1 : negative2);
    CrossedEdges edges = CrossedEdges(odd_negative ? odd : arriving, odd_negative ? arriving : odd);
    return edges;
}

// The point of edge k of a face where a quantity is zero. `vertices` order the ends of edges as the model's vertex numbers do.
FORMULA vec3 zero_on_edge(const uint vertices[3], const vec3 positions[3], const float values[3], const int k)
{
    int next = (k + 1) % 3;
    EdgeZero zero = edge_zero(vertices[k], vertices[next], values[k], values[next]);
    return zero.from == vertices[k] ? at_zero(zero, positions[k], positions[next]) : at_zero(zero, positions[next], positions[k]);
}

// Where a quantity that is linear along a segment is positive, as parameters (begin, end); empty where not begin < end. 0 is not positive.
FORMULA vec2 positive_part(const float first, const float second)
{
    if (first > 0.0f && second > 0.0f)
        return vec2(0.0f, 1.0f);
    if (!(first > 0.0f) && !(second > 0.0f))
        return vec2(0.0f, 0.0f);
    float zero = first / (first - second);
    return first > 0.0f ? vec2(0.0f, zero) : vec2(zero, 1.0f);
}
