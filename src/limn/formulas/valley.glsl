// Valleys of a picture's intensity: the radial filter of DeCarlo et al. 2003 (contour-lines specification, 2.16).
// Included inside a struct (C++) or a shader (GLSL) that offers float pixel(const ivec2 p): the intensity, 0 dark, 1 lit, at any p; what
// lies outside of the picture repeats its border. No include guard: every such struct needs its own copy.

// True where at most the fraction `most_darker` of the pixels within `radius` is strictly darker, and one is brighter by more than `contrast`.
// The window is a disc.
FORMULA bool is_valley(const ivec2 at, const int radius, const float most_darker, const float contrast)
{
    float centre = pixel(at);
    float brightest = centre;
    int darker = 0;
    int all = 0;
    for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) {
            if (x * x + y * y > radius * radius)
                continue;
            float other = pixel(at + ivec2(x, y));
            brightest = max(brightest, other);
            darker += other < centre ? 1 : 0;
            all += 1;
        }
    }
    return float(darker) <= most_darker * float(all) && brightest - centre > contrast;
}

// The same as the thesis prints it: a square window, 1/r and the share of darker pixels divided as whole numbers, so that fewer than
// r * r darker pixels are asked for; contrast r/100.
FORMULA bool is_valley_as_printed(const ivec2 at, const int radius)
{
    float centre = pixel(at);
    float brightest = centre;
    int darker = 0;
    for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) {
            float other = pixel(at + ivec2(x, y));
            brightest = max(brightest, other);
            darker += other < centre ? 1 : 0;
        }
    }
    return darker < radius * radius && brightest - centre > 0.01f * float(radius);
}
