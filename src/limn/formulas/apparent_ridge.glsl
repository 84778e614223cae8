// View-dependent curvature and its derivative at one point of a surface. One text for C++ and GLSL.
// Reference: Judd, Durand, Adelson, "Apparent ridges for line drawing", SIGGRAPH 2007: Q = S P^-1 (section 3), its largest
// singular value q1 with direction t1, and the apparent ridge D_t1 q1 = 0. The paper differences q1 over the mesh;
// here the derivative is exact in terms of the curvature's derivative tensor C.
// Conventions: contour-lines specification, section 0. Tangent vectors are pairs in (e1, e2).
#pragma once

struct ApparentRidge {
    float q;     // largest view-dependent curvature, >= 0; 1/length; grows without bound towards the contour
    float along; // the unit tangent direction whose projection is t1, up to sign: along e1
    float across; // and along e2
    float slope; // derivative of q along that direction, per unit of length on the surface; changes sign with it
};

// cosine = n . v/|v| > 0; w = (e1, e2) . v/|v|; derivative = (P, Q, S, T);
// per_distance = 1/|v| for a perspective view, 0 for an orthographic one.
FORMULA ApparentRidge apparent_ridge(const float cosine, const vec2 w, const float k1, const float k2, const vec4 derivative,
                                     const float per_distance)
{
    // P^-1 = I + (1/cosine - 1) w w^T / |w|^2, and |w|^2 = 1 - cosine^2: without a division by |w|.
    float m = cosine * (1.0f + cosine);
    float a11 = 1.0f + w.x * w.x / m;
    float a12 = w.x * w.y / m;
    float a22 = 1.0f + w.y * w.y / m;
    float q11 = k1 * a11;
    float q12 = k1 * a12;
    float q21 = k2 * a12;
    float q22 = k2 * a22;

    // Largest eigenvalue of Q^T Q and its eigenvector t, the right singular vector.
    float s11 = q11 * q11 + q21 * q21;
    float s12 = q11 * q12 + q21 * q22;
    float s22 = q12 * q12 + q22 * q22;
    float half_difference = 0.5f * (s11 - s22);
    float root = sqrt(half_difference * half_difference + s12 * s12);
    float largest = 0.5f * (s11 + s22) + root;
    vec2 t = half_difference >= 0.0f ? vec2(half_difference + root, s12) : vec2(s12, root - half_difference);
    float t_length = sqrt(t.x * t.x + t.y * t.y);
    ApparentRidge r = ApparentRidge(sqrt(largest), 1.0f, 0.0f, 0.0f);
    if (!(t_length > 0.0f && largest > 0.0f))
        return r;
    t = t / t_length;

    // x = P^-1 t on the surface; the derivatives of S, of the cosine, of w and of P^-1 along it.
    vec2 x = vec2(a11 * t.x + a12 * t.y, a12 * t.x + a22 * t.y);
    float wx = w.x * x.x + w.y * x.y;
    float wt = w.x * t.x + w.y * t.y;
    float d_cosine = k1 * x.x * w.x + k2 * x.y * w.y + cosine * wx * per_distance;
    vec2 d_w = vec2(-per_distance * (x.x - w.x * wx) - cosine * k1 * x.x, -per_distance * (x.y - w.y * wx) - cosine * k2 * x.y);
    float d_wt = d_w.x * t.x + d_w.y * t.y;
    float d_m = (1.0f + 2.0f * cosine) * d_cosine;
    vec2 d_xt = (d_w * wt + w * d_wt) / m - w * (wt * d_m / (m * m));
    float c11 = derivative.x * x.x + derivative.y * x.y;
    float c12 = derivative.y * x.x + derivative.z * x.y;
    float c22 = derivative.z * x.x + derivative.w * x.y;

    // dq = (Q t / q) . (dQ t), Q = S P^-1.
    vec2 turned = vec2(k1 * x.x, k2 * x.y);
    vec2 d_turned = vec2(c11 * x.x + c12 * x.y + k1 * d_xt.x, c12 * x.x + c22 * x.y + k2 * d_xt.y);
    float x_length = sqrt(x.x * x.x + x.y * x.y);
    r.along = x.x / x_length;
    r.across = x.y / x_length;
    r.slope = (turned.x * d_turned.x + turned.y * d_turned.y) / (r.q * x_length);
    return r;
}
