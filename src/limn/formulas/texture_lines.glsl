// Lines by look-up in a texture (contour-lines specification 2.13, M6). Every level of the texture holds a dark bar of the same number of texels
// across s = 1/2, where t > 1/2; since a level is chosen such that a texel spans about a pixel, the line is about as wide from near and far.
// nv = n . v/|v|; kr: radial curvature; strength: sin^2(theta) times its derivative along w; in units of the model. One text for C++ and GLSL.
#pragma once

// How fast s runs with feature_size * kr: pictures of usual size then use the middle levels, with finer and coarser ones to either side.
const float TEXTURE_SCALE = 4.0f;

// Suggestive contours: across the bar with kr, into it where the test value passes the limit.
FORMULA vec2 suggestive_place(const float kr, const float strength, const float feature_size, const float limit)
{
    return vec2(0.5f + TEXTURE_SCALE * (feature_size * kr), 0.5f + (feature_size * feature_size * strength - limit));
}

// Contours: across the bar with n.v, always inside of it along t. Near a contour n.v is the root of 2 kr times the distance and changes by kr/(n.v)
// a pixel, so that a bar of 4 texels, whose far half is never seen, makes a line of one pixel.
FORMULA vec2 contour_place(const float nv) { return vec2(0.5f + 0.25f * nv, 0.75f); }

// The level whose texels are as large as a pixel in the direction in which they pass fastest, as OpenGL chooses it. dx, dy: what the place
// changes by from a pixel to the next; size: texels along the edge of level 0.
FORMULA float texture_level(const vec2 dx, const vec2 dy, const float size)
{
    return log2(max(size * sqrt(max(dot(dx, dx), dot(dy, dy))), 1.0f));
}
