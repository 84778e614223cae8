// Normals as colours, and back from a normal map. One text for C++ and GLSL.
#pragma once

// A normal as an encoded colour: x, y and z of -1 to 1 are red, green and blue of 0 to 1.
FORMULA vec3 normal_colour(const vec3 n)
{
    return 0.5f * n + vec3(0.5f);
}

// Texture coordinates as a place between the middles of a square map's texels: rows count down, the middle of the upper left texel is (0,0).
FORMULA vec2 map_place(const vec2 uv, const float size)
{
    return vec2(uv.x * size - 0.5f, (1.0f - uv.y) * size - 0.5f);
}

// The unit normal between four texels' colours: bilinear, by the parts of the way to the right and down.
FORMULA vec3 map_normal(const vec3 upper_left, const vec3 upper_right, const vec3 lower_left, const vec3 lower_right, const vec2 way)
{
    vec3 colour = mix(mix(upper_left, upper_right, way.x), mix(lower_left, lower_right, way.x), way.y);
    vec3 n = 2.0f * colour - vec3(1.0f);
    float size = length(n);
    return size > 0.0f ? n / size : vec3(0.0f, 0.0f, 1.0f);
}
