// Suggestive contours and highlights in one face, with trimming (contour-lines specification 2.6, 2.8 and 2.11). One text for C++ and
// GLSL.
#pragma once
#include "limn/formulas/edge_zero.glsl"
#include "limn/formulas/radial_curvature.glsl"

struct SuggestiveLimits {
    float feature_size; // in the model's frame
    float limit;        // of sin^2(theta) feature_size^2 D kr
    float fade;         // the ink is full from this many limits above the limit; 0: no fading
    float speed_limit;  // largest speed; 0: no limit
    float side;         // 1 for suggestive contours, -1 for highlights: the sign of the derivative that is wanted
};

// One corner of a face as the trimming reads it.
struct SuggestiveCorner {
    uint vertex;    // global: orders the ends of an edge
    float kr;       // radial curvature; negative exactly where RadialTerms::f is
    float strength; // g of section 2.8; positive where a line may run
    float turn;     // speed = |turn| / gradient; both 0 where no speed limit is set
    float gradient;
};

// A place on the line kr = 0.
struct SuggestiveEnd {
    vec3 position;
    float strength;
    float turn;
    float gradient;
};

// The piece of line in a face.
struct SuggestivePiece {
    vec3 a;
    vec3 b;
    float ink_a;
    float ink_b;
    int edge_a; // the edge that the end lies on (from corner k to the next); -1 where the line was cut
    int edge_b;
};

FORMULA SuggestiveCorner suggestive_corner(const RadialTerms r, const uint vertex, const float k1, const float k2, const vec4 derivative,
                                           const SuggestiveLimits limits, const bool orthographic)
{
    float kr = radial_curvature(r, k1, k2);
    if (r.f < 0.0f && !(kr < 0.0f))
        kr = r.f; // the quotient underflowed
    float along = radial_curvature_derivative(r, k1, k2, derivative);
    float strength = suggestive_strength(r, limits.side * along, limits.feature_size, limits.limit);
    float turn = 0.0f;
    float gradient = 0.0f;
    if (limits.speed_limit > 0.0f) {
        float per_distance = orthographic ? 0.0f : 1.0f / sqrt(r.w2);
        float across = radial_curvature_derivative_across(r, k1, k2, derivative, per_distance);
        suggestive_speed_parts(r, k1, k2, along, across, turn, gradient);
    }
    SuggestiveCorner corner = SuggestiveCorner(vertex, kr, strength, turn, gradient);
    return corner;
}

// Where kr = 0 meets the edge between two corners.
FORMULA SuggestiveEnd suggestive_end(const SuggestiveCorner i, const SuggestiveCorner j, const vec3 pi, const vec3 pj)
{
    EdgeZero zero = edge_zero(i.vertex, j.vertex, i.kr, j.kr);
    bool swapped = zero.from != i.vertex;
    SuggestiveEnd end = SuggestiveEnd(swapped ? at_zero(zero, pj, pi) : at_zero(zero, pi, pj),
                                      swapped ? at_zero(zero, j.strength, i.strength) : at_zero(zero, i.strength, j.strength),
                                      swapped ? at_zero(zero, j.turn, i.turn) : at_zero(zero, i.turn, j.turn),
                                      swapped ? at_zero(zero, j.gradient, i.gradient) : at_zero(zero, i.gradient, j.gradient));
    return end;
}

// The place at parameter s between two ends: an end itself, bit for bit, where nothing is cut off.
FORMULA SuggestiveEnd suggestive_between(const SuggestiveEnd a, const SuggestiveEnd b, const float s)
{
    if (s <= 0.0f)
        return a;
    if (s >= 1.0f)
        return b;
    SuggestiveEnd place = SuggestiveEnd(a.position + s * (b.position - a.position), a.strength + s * (b.strength - a.strength),
                                        a.turn + s * (b.turn - a.turn), a.gradient + s * (b.gradient - a.gradient));
    return place;
}

// The part of [0,1] between two ends where the line is drawn: strong and slow enough, turning to either side. Empty where not x < y.
FORMULA vec2 suggestive_part(const SuggestiveEnd a, const SuggestiveEnd b, const float speed_limit)
{
    vec2 part = positive_part(a.strength, b.strength);
    if (speed_limit > 0.0f) {
        vec2 left = positive_part(speed_limit * a.gradient + a.turn, speed_limit * b.gradient + b.turn);
        vec2 right = positive_part(speed_limit * a.gradient - a.turn, speed_limit * b.gradient - b.turn);
        part = vec2(max(max(part.x, left.x), right.x), min(min(part.y, left.y), right.y));
    }
    return part;
}

// Ink of a place on the line: fades towards the limit, and from half the speed limit on.
FORMULA float suggestive_ink(const SuggestiveEnd end, const SuggestiveLimits limits)
{
    float ink = faded_ink(end.strength, limits.fade * limits.limit);
    if (!(limits.speed_limit > 0.0f) || !(limits.fade > 0.0f))
        return ink;
    float most = limits.speed_limit * end.gradient;
    return ink * (most > 0.0f ? clamp(2.0f - 2.0f * abs(end.turn) / most, 0.0f, 1.0f) : 0.0f);
}

// The piece in a face whose corners differ in the sign of kr. Directed like contours: the side with kr >= 0 lies to its right, so that
// it leaves by the edge through which the next face is entered. False where nothing is drawn; `piece` says nothing then.
FORMULA bool suggestive_piece(const SuggestiveCorner corners[3], const vec3 positions[3], const SuggestiveLimits limits,
                              OUT(SuggestivePiece) piece)
{
    CrossedEdges edges = crossed_edges(corners[0].kr < 0.0f, corners[1].kr < 0.0f, corners[2].kr < 0.0f);
    int after_enter = (edges.enter + 1) % 3;
    int after_leave = (edges.leave + 1) % 3;
    SuggestiveEnd a = suggestive_end(corners[edges.enter], corners[after_enter], positions[edges.enter], positions[after_enter]);
    SuggestiveEnd b = suggestive_end(corners[edges.leave], corners[after_leave], positions[edges.leave], positions[after_leave]);
    vec2 part = suggestive_part(a, b, limits.speed_limit);
    if (!(part.x < part.y))
        return false;
    SuggestiveEnd first = suggestive_between(a, b, part.x);
    SuggestiveEnd last = suggestive_between(a, b, part.y);
    piece.a = first.position;
    piece.b = last.position;
    piece.ink_a = suggestive_ink(first, limits);
    piece.ink_b = suggestive_ink(last, limits);
    piece.edge_a = part.x <= 0.0f ? edges.enter : -1;
    piece.edge_b = part.y >= 1.0f ? edges.leave : -1;
    return true;
}
