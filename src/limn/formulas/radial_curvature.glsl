// Radial curvature and what follows from it at one point of a surface. One text for C++ and GLSL.
// Conventions: contour-lines specification, section 0 (v points to the eye; S = dn, convex is positive).
// Reference: DeCarlo et al. 2003 and 2004; the torsion form of the derivative is exact everywhere, not only where
// the radial curvature is zero.
#pragma once

// The view vector in the principal frame, without any division or root.
// f has the sign of the radial curvature: f = w2 * kr. Seen head-on (w = 0) it is k1 + k2, the sign of the mean curvature.
struct RadialTerms {
    float nv; // n . v
    float a;  // e1 . v
    float b;  // e2 . v
    float w2; // |w|^2, w = projection of v on the tangent plane
    float vv; // |v|^2
    float f;
};

FORMULA RadialTerms radial_terms(const vec3 v, const vec3 n, const vec3 e1, const vec3 e2, const float k1, const float k2)
{
    RadialTerms r;
    r.nv = dot(n, v);
    r.a = dot(e1, v);
    r.b = dot(e2, v);
    r.w2 = r.a * r.a + r.b * r.b;
    r.vv = r.w2 + r.nv * r.nv;
    r.f = k1 * (r.a * r.a) + k2 * (r.b * r.b);
    if (!(r.w2 > 1e-10f * r.vv))
        r.f = k1 + k2;
    return r;
}

// True where w is too short to have a direction.
FORMULA bool is_head_on(const RadialTerms r) { return !(r.w2 > 1e-10f * r.vv); }

// kr = II(w,w)/|w|^2; the mean curvature where the point is seen head-on. Unit 1/length.
FORMULA float radial_curvature(const RadialTerms r, const float k1, const float k2)
{
    return is_head_on(r) ? 0.5f * (k1 + k2) : r.f / r.w2;
}

// Derivative of kr along the unit vector of w: C(w,w,w) - 2 tr^2 cot(theta). Unit 1/length^2; 0 head-on.
// derivative = (P, Q, S, T).
FORMULA float radial_curvature_derivative(const RadialTerms r, const float k1, const float k2, const vec4 derivative)
{
    if (is_head_on(r))
        return 0.0f;
    float w = sqrt(r.w2);
    float u = r.a / w;
    float t = r.b / w;
    float cubic = u * u * (u * derivative.x + 3.0f * t * derivative.y) + t * t * (3.0f * u * derivative.z + t * derivative.w);
    float torsion = (k2 - k1) * u * t;
    return cubic - 2.0f * torsion * torsion * (r.nv / w);
}

// Derivative of kr along n x w. per_distance is 1/|w| for a perspective view and 0 for an orthographic one,
// where v does not change from point to point. Unit 1/length^2.
FORMULA float radial_curvature_derivative_across(const RadialTerms r, const float k1, const float k2, const vec4 derivative,
                                                 const float per_distance)
{
    if (is_head_on(r))
        return 0.0f;
    float w = sqrt(r.w2);
    float u = r.a / w;
    float t = r.b / w;
    float cubic = derivative.x * (u * u * (-t)) + derivative.y * (u * u * u - 2.0f * u * t * t)
                + derivative.z * (2.0f * u * u * t - t * t * t) + derivative.w * (t * t * u);
    float torsion = (k2 - k1) * u * t;
    float kr = r.f / r.w2;
    return cubic - 2.0f * torsion * per_distance - 2.0f * (r.nv / w) * torsion * (k1 + k2 - kr);
}

// The limit of section 2.8: g = sin^2(theta) * size^2 * D - limit. A suggestive contour is kept where kr = 0 and g > 0;
// a suggestive highlight where kr = 0 and g of the negated derivative > 0. Head-on: -limit.
FORMULA float suggestive_strength(const RadialTerms r, const float derivative_along_w, const float feature_size, const float limit)
{
    if (is_head_on(r))
        return -limit;
    return feature_size * feature_size * (r.w2 / r.vv) * derivative_along_w - limit;
}

// Fading: 0 at the limit, 1 from `ramp` limits above it. ramp_times_limit > 0, or 0 for no fading.
FORMULA float faded_ink(const float strength, const float ramp_times_limit)
{
    return ramp_times_limit > 0.0f ? clamp(strength / ramp_times_limit, 0.0f, 1.0f) : 1.0f;
}

// Largest speed of a point of the kr = 0 loop on the surface, per unit of camera motion: |turn| / gradient
// = 2 |tr| / (|w| |grad kr|). Unit: 1 for a perspective view (length per length). The two parts are finite everywhere and
// turn keeps its sign, so that they can be interpolated; both are 0 head-on.
FORMULA void suggestive_speed_parts(const RadialTerms r, const float k1, const float k2, const float along, const float across,
                                    OUT(float) turn, OUT(float) gradient)
{
    turn = 0.0f;
    gradient = 0.0f;
    if (is_head_on(r))
        return;
    turn = 2.0f * ((k2 - k1) * r.a * r.b / r.w2);
    gradient = sqrt(r.w2) * sqrt(along * along + across * across);
}

FORMULA float suggestive_speed(const RadialTerms r, const float k1, const float k2, const float along, const float across)
{
    float turn;
    float gradient;
    suggestive_speed_parts(r, k1, k2, along, across, turn, gradient);
    return gradient > 0.0f ? abs(turn) / gradient : 0.0f;
}

// Speed of a point of the contour generator per unit of camera motion along the normal: 1 / (|w| sqrt(kr^2 + tr^2)).
FORMULA float contour_speed(const RadialTerms r, const float k1, const float k2)
{
    if (is_head_on(r))
        return 0.0f;
    float torsion = (k2 - k1) * r.a * r.b / r.w2;
    float kr = r.f / r.w2;
    float bend = sqrt(kr * kr + torsion * torsion);
    return bend > 0.0f ? 1.0f / (sqrt(r.w2) * bend) : 0.0f;
}
