// Which pixels of a picture are lines (contour-lines specification, 2.14 and 2.15). Included, after sobel.glsl and without an include
// guard, inside a struct (C++) or a shader (GLSL) that offers, at any pixel (what lies outside repeats the border):
//   float pixel(const ivec2 p)         intensity of the white shape under a headlight, 0 dark; 1 where nothing is seen
//   float window_depth(const ivec2 p)  depth as a rasteriser stores it, in [0,1]; 1 where nothing is seen
//   float nearness(const ivec2 p)      linear over the picture of a plane (stands_out); 0 where nothing is seen
//   vec3 normal_at(const ivec2 p)      unit; 0 where nothing is seen
//   uint id_at(const ivec2 p)          of the object; 0 where nothing is seen

// M8: dark under the headlight.
FORMULA bool is_dark(const ivec2 at, const float limit) { return pixel(at) < limit; }

// M10: the radius of the window where it follows the distance, pixels; `reach` is that where the nearness is 1.
FORMULA int radius_at(const ivec2 at, const float reach, const float relative)
{
    return clamp(int(reach * mix(1.0f, nearness(at), relative) + 0.5f), 1, 64);
}

// M9 as the thesis has it.
FORMULA bool is_depth_edge_raw(const ivec2 at, const float limit)
{
    float z[9];
    for (int k = 0; k < 9; ++k)
        z[k] = window_depth(at + ivec2(k % 3 - 1, k / 3 - 1));
    return sobel_strength(z) > limit;
}

// M9 today: steps in depth whatever the slope, folds of the normal, and borders between objects; on the nearer side, so that the line is
// one pixel wide. `step` is a part of the depth (of the scene's size in orthographic views, where relative = 0).
FORMULA bool is_depth_edge(const ivec2 at, const float step, const float least_cosine, const float relative)
{
    uint id = id_at(at);
    if (id == 0u)
        return false;
    float z[9];
    for (int k = 0; k < 9; ++k)
        z[k] = nearness(at + ivec2(k % 3 - 1, k / 3 - 1));
    if (stands_out(z) > step * mix(1.0f, z[4], relative))
        return true;
    vec3 n = normal_at(at);
    for (int k = 1; k < 9; k += 2) {
        ivec2 p = at + ivec2(k % 3 - 1, k / 3 - 1);
        if (z[k] > z[4] || (z[k] == z[4] && k > 4)) // the nearer one draws the line, the first of two equals
            continue;
        if (id_at(p) != id || dot(n, normal_at(p)) < least_cosine)
            return true;
    }
    return false;
}
