// Lines decided pixel by pixel from interpolated quantities of the surface: the vertex and fragment shader method of the contour-lines
// specification (2.12, M7), in pixels. One text for C++ and GLSL.
// nv = n . v/|v|; kr, dwkr: radial curvature and its derivative, in units of the model; per_unit: pixels that a unit of the model spans there.
#pragma once

// Distance from the contour in the picture: of the osculating circle of radius 1/kr, (n.v)^2 / (2 kr). Visible contours have kr > 0; where it
// is not (guard of trap T9: concave places would turn black) there is no contour near.
FORMULA float contour_distance(const float nv, const float kr, const float per_unit)
{
    return kr > 1e-6f ? per_unit * (nv * nv) / (2.0f * kr) : 1e30f;
}

// Distance from the kr = 0 line in the picture: |kr| / dwkr on the surface, foreshortened by n.v. Far where the derivative has not the
// sign of a suggestive contour.
FORMULA float suggestive_distance(const float nv, const float kr, const float dwkr, const float per_unit)
{
    return dwkr > 1e-6f ? per_unit * nv * abs(kr) / dwkr : 1e30f;
}

// How much of a pixel a line covers: 1 within `reach` pixels, falling to 0 over the pixel's width.
FORMULA float line_cover(const float distance, const float reach)
{
    return clamp(reach + 0.5f - distance, 0.0f, 1.0f);
}

// The ink of one pixel. Contours are as wide as asked on the one side that shows the surface; suggestive contours have half on either side,
// lie on front sides alone, and end where sin^2(theta) dwkr falls to least_strength.
FORMULA float shader_ink(const float nv, const float kr, const float dwkr, const float per_unit, const float contour_width,
                         const float suggestive_width, const float least_strength)
{
    float ink = line_cover(contour_distance(nv, kr, per_unit), contour_width);
    if (nv > 0.0f && (1.0f - nv * nv) * dwkr > least_strength)
        ink = max(ink, line_cover(suggestive_distance(nv, kr, dwkr, per_unit), 0.5f * suggestive_width));
    return ink;
}
