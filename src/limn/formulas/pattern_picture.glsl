// What makes a picture of the light that patterns reflect.
#pragma once

// Light as a picture shows it: bright places near white without a hard edge. Linear still.
FORMULA vec3 shown_light(const vec3 linear)
{
    vec3 soft = vec3(1.0f, 1.0f, 1.0f) - exp((vec3(0.8f, 0.8f, 0.8f) - max(linear, vec3(0.8f, 0.8f, 0.8f))) * 5.0f) * 0.2f;
    return vec3(linear.x < 0.8f ? linear.x : soft.x, linear.y < 0.8f ? linear.y : soft.y, linear.z < 0.8f ? linear.z : soft.z);
}

// How far the steps of a print stand out of the model: a layer's height times the cosine between surface and print direction (Dolenc and Makela
// 1994).
FORMULA float cusp_height(const float layer_height, const float normal_along)
{
    return layer_height * abs(normal_along);
}

// Light on a picture of their heights: a headlight, so that the shape is seen.
FORMULA float cusp_light(const vec3 n, const vec3 to_eye)
{
    return 0.55f + 0.45f * max(dot(n, to_eye), 0.0f);
}

// What a pixel shows, to tell edges of the picture: not of the pattern, which is filtered.
struct SeenPlace {
    vec3 position;
    vec3 normal;
    float pixel; // size of one there; 0 where nothing is seen
};

// Whether there is an outline or a fold between two pixels.
FORMULA bool is_outline(const SeenPlace a, const SeenPlace b)
{
    if (a.pixel == 0.0f || b.pixel == 0.0f)
        return a.pixel != b.pixel;
    vec3 way = b.position - a.position;
    float off = min(abs(dot(way, a.normal)), abs(dot(way, b.normal)));
    return dot(a.normal, b.normal) < 0.85f || off > 3.0f * max(a.pixel, b.pixel);
}

// Where the light that reaches a ground is known on a grid.
struct GroundGrid {
    vec3 middle;
    vec3 right;  // unit
    vec3 ahead;  // unit, at right angles to it
    float reach; // half a side
    int side;    // places along one
};
