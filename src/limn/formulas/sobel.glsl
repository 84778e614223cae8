// Discontinuities of a field on a grid of pixels (contour-lines specification, 2.15). One text for C++ and GLSL.
// z holds the 3 x 3 neighbourhood of a pixel, row by row from the top; z[4] is the pixel itself.
#pragma once

// The response of the Sobel operator (Sobel & Feldman 1968), per pixel: 8 times the gradient of a linear field.
FORMULA vec2 sobel(const float z[9])
{
    float across = z[0] + 2.0f * z[3] + z[6] - z[2] - 2.0f * z[5] - z[8];
    float along = z[6] + 2.0f * z[7] + z[8] - z[0] - 2.0f * z[1] - z[2];
    return vec2(across, along);
}

FORMULA float sobel_strength(const float z[9])
{
    vec2 g = sobel(z);
    return sqrt(g.x * g.x + g.y * g.y);
}

// How far the pixel stands out towards the eye from the plane through two opposite neighbours, as a part of its own value; the
// largest of the four directions. `z` is linear over the picture of any plane: the inverse depth of a perspective view, or the negated
// depth of an orthographic one divided by the size of the scene. So a slope, however steep, is no line, and a step is one on its nearer side.
FORMULA float stands_out(const float z[9])
{
    float most = max(max(2.0f * z[4] - z[0] - z[8], 2.0f * z[4] - z[1] - z[7]), max(2.0f * z[4] - z[2] - z[6], 2.0f * z[4] - z[3] - z[5]));
    return max(most, 0.0f);
}
