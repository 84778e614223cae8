// How an edge bends over a surface whose normals at its ends are known: the middle of a cubic curve, and the normal there. One text for C++,
// where REAL is double, and GLSL, where it is float. Reference: Heide 2009, "4pt-hermite" (the terrain specification, 2.7 to 2.9).
// Both triangles of an edge have to name its ends in the same order: places do not depend on it, normals do in their last bits.
#pragma once

// What the edge's ends, as vectors along it, become in their tangent planes: as long as the edge, or both 0 where one has no direction.
struct EdgeTangents {
    REAL3 begin;
    REAL3 end;
};

FORMULA EdgeTangents edge_tangents(const REAL3 p1, const REAL3 p2, const REAL3 n1, const REAL3 n2)
{
    REAL3 edge = p2 - p1;
    REAL3 a = edge - n1 * dot(edge, n1);
    REAL3 b = edge - n2 * dot(edge, n2);
    REAL edge_length = length(edge);
    REAL a_length = length(a);
    REAL b_length = length(b);
    EdgeTangents t = EdgeTangents(REAL3(0.0f, 0.0f, 0.0f), REAL3(0.0f, 0.0f, 0.0f));
    if (min(a_length, b_length) > REAL(1e-6f) * edge_length) {
        t.begin = a * (edge_length / a_length);
        t.end = b * (edge_length / b_length);
    }
    return t;
}

// The middle of the curve. weight: of the tangents, 0 (a straight edge) to 1; 1/2 is the four-point scheme with w = 1/16.
FORMULA REAL3 edge_middle(const REAL3 p1, const REAL3 p2, const EdgeTangents t, const REAL weight)
{
    return (p1 + p2) * REAL(0.5f) + (t.begin - t.end) * (weight * REAL(0.125f));
}

// From the edge's own line to the curve a quarter along it, and three quarters: an edge between parallel normals bends there, and not in its middle.
FORMULA REAL3 edge_quarter(const EdgeTangents t, const REAL weight) { return (t.begin * REAL(9.0f) - t.end * REAL(3.0f)) * (weight * REAL(0.015625f)); }

FORMULA REAL3 edge_three_quarters(const EdgeTangents t, const REAL weight)
{
    return (t.begin * REAL(3.0f) - t.end * REAL(9.0f)) * (weight * REAL(0.015625f));
}

// How far along the edge a place is: 0 at p1, 1 at p2.
FORMULA REAL along_edge(const REAL3 p1, const REAL3 p2, const REAL3 place)
{
    REAL3 edge = p2 - p1;
    REAL square = dot(edge, edge);
    if (!(square > REAL(0.0f)))
        return REAL(0.5f);
    return dot(place - p1, edge) / square;
}

// The part of a vector across the edge.
FORMULA REAL3 across_edge(const REAL3 p1, const REAL3 p2, const REAL3 v)
{
    REAL3 edge = p2 - p1;
    REAL square = dot(edge, edge);
    if (!(square > REAL(0.0f)))
        return v;
    return v - edge * (dot(v, edge) / square);
}

// Whether the curve is S-shaped: the normals at the ends lean towards the same side.
FORMULA bool is_serpentine(const REAL3 p1, const REAL3 p2, const REAL3 n1, const REAL3 n2) { return dot(n1, p2 - p1) * dot(n2, p1 - p2) < REAL(0.0f); }

// The unit normal at a place along the edge. mirrored: as an S-shaped curve has it, which leans to the other side in its middle.
FORMULA REAL3 edge_normal(const REAL3 p1, const REAL3 p2, const REAL3 n1, const REAL3 n2, const REAL along, const bool mirrored)
{
    REAL3 n = n1 * (REAL(1.0f) - along) + n2 * along;
    REAL3 edge = p2 - p1;
    REAL square = dot(edge, edge);
    if (mirrored && square > REAL(0.0f))
        n = n - edge * (REAL(2.0f) * dot(n, edge) / square);
    REAL size = length(n);
    if (!(size > REAL(1e-12f)))
        return n1;
    return n / size;
}
