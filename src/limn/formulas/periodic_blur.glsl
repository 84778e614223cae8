// Periodic functions seen through the kernel of a pixel, in closed form. Everything is put together from two functions of period 1 and mean
// 0: a saw, x - 1/2, and the parabola x^2 - x + 1/6 whose slope is twice the saw (Bernoulli's polynomials). Since they stay bounded, wide
// kernels cancel no digits; narrow ones meet one tooth.
#pragma once

const int KERNEL_NONE = 0;  // what is at the pixel's centre
const int KERNEL_BOX = 1;   // a square of so many pixels
const int KERNEL_GAUSS = 2; // round, of so many pixels' standard deviation

const float NARROW_GAUSS = 0.125f; // standard deviation up to which a kernel meets one tooth, and beyond which no wave is left; periods
const float WIDEST_GAUSS = 0.9f;
const float LEAST_WAVE = 1e-6f; // what is left of a wave that no longer counts

// A kernel along a coordinate that counts periods.
struct Blur {
    int kernel;
    float a;    // box: changes across the square, the larger first; Gauss: standard deviation; periods
    float b;
    float fade; // Gauss: what is left of a wave of one period, where the kernel is so wide that waves are added up; else 0
};

// What a Gauss kernel leaves of a wave of one period.
FORMULA float gauss_fade(const float sigma)
{
    return exp(-19.7392088022f * sigma * sigma);
}

// From the changes across a square, the larger first, or a standard deviation and 0; in periods.
FORMULA Blur blur_of(const int kernel, const float a, const float b)
{
    Blur blur = {a < 1e-5f ? KERNEL_NONE : kernel, a, b, 0.0f};
    if (kernel == KERNEL_GAUSS && a > NARROW_GAUSS && a <= WIDEST_GAUSS)
        blur.fade = gauss_fade(a);
    return blur;
}

// How a kernel of a width in pixels smears a coordinate that changes so much for each pixel to the right and down.
FORMULA Blur blur_along(const int kernel, const float width, const vec2 per_pixel)
{
    vec2 s = min(abs(per_pixel) * width, vec2(1e4f, 1e4f));
    if (kernel == KERNEL_GAUSS)
        return blur_of(kernel, sqrt(dot(s, s)), 0.0f);
    return blur_of(kernel, max(s.x, s.y), min(s.x, s.y));
}

// Variance of the kernel, periods squared.
FORMULA float blur_variance(const Blur blur)
{
    if (blur.kernel == KERNEL_NONE)
        return 0.0f;
    return blur.kernel == KERNEL_GAUSS ? blur.a * blur.a : (blur.a * blur.a + blur.b * blur.b) / 12.0f;
}

FORMULA vec2 sharp_saw(const float x)
{
    float f = x - floor(x);
    return vec2(f - 0.5f, (f - 1.0f) * f + 1.0f / 6.0f);
}

// A Gauss kernel and the one tooth that it meets: Abramowitz and Stegun 26.2.19 for the normal distribution, and its derivative for the density.
FORMULA vec2 narrow_gauss_saw(const float x, const float sigma)
{
    float off = x - floor(x + 0.5f);
    float z = abs(off) / sigma;
    if (z > 4.5f)
        return vec2(off + (off < 0.0f ? 0.5f : -0.5f), off * off + sigma * sigma + 1.0f / 6.0f - abs(off));
    float root = 1.0f / (1.0f + z * (0.0498673470f + z * (0.0211410061f + z * (0.0032776263f + z * (0.0000380036f + z * (0.0000488906f + z * 0.0000053830f))))));
    float rise = 0.0498673470f + z * (0.0422820122f + z * (0.0098328789f + z * (0.0001520144f + z * (0.0002444530f + z * 0.0000322980f))));
    float root_2 = root * root;
    float root_8 = root_2 * root_2 * root_2 * root_2;
    float tail = 0.5f * root_8 * root_8;
    float density = 16.0f * tail * rise * root;
    float below = off < 0.0f ? tail : 1.0f - tail;
    float distance_mean = abs(off) * (1.0f - 2.0f * tail) + 2.0f * sigma * density;
    return vec2(off + 0.5f - below, off * off + sigma * sigma + 1.0f / 6.0f - distance_mean);
}

// Sine and cosine of x turns.
FORMULA vec2 turn_of(const float x)
{
    float f = x - floor(x + 0.5f);
    float t = f * f;
    // Of half as much: polynomials through Chebyshev's points, 5e-8 off.
    float s = f * (3.14159264f + t * (-5.16771008f + t * (2.55007739f + t * (-0.598290411f + t * 0.0776559124f))));
    float c = 0.999999953f + t * (-4.9347928f + t * (4.05841079f + t * (-1.33187297f + t * 0.219682424f)));
    return vec2(2.0f * s * c, 1.0f - 2.0f * s * s);
}

// The same of the sum of both.
FORMULA vec2 turn_sum(const vec2 a, const vec2 b)
{
    return vec2(a.x * b.y + a.y * b.x, a.y * b.y - a.x * b.x);
}

// And of the difference.
FORMULA vec2 turn_difference(const vec2 a, const vec2 b)
{
    return vec2(a.x * b.y - a.y * b.x, a.y * b.y + a.x * b.x);
}

// Saw and parabola at a place, and half a period on.
struct SawPair {
    vec2 here;
    vec2 half_on;
};

// One wave of their Fourier series, by the turn of k x.
FORMULA vec2 saw_wave(const vec2 turn, const float k, const float fade)
{
    float size = fade / (3.14159265359f * k);
    return vec2(-turn.x * size, turn.y * size / (3.14159265359f * k));
}

// The Fourier series, of which a wide kernel leaves few terms: by the turn of x, and by what is left of the first wave. Half a period on, odd
// waves have the other sign.
FORMULA SawPair wide_gauss_saws(const vec2 turn, const float fade_of_first)
{
    float q2 = fade_of_first * fade_of_first;
    vec2 all = turn; // of k turns
    float fade = fade_of_first; // its k^2-th power
    float step_of_fade = fade_of_first * q2;
    vec2 odd = vec2(0.0f, 0.0f);
    vec2 even = vec2(0.0f, 0.0f);
    for (int k = 1; k < 6 && fade > LEAST_WAVE; k += 2) {
        odd = odd + saw_wave(all, float(k), fade);
        all = turn_sum(all, turn);
        fade = fade * step_of_fade;
        step_of_fade = step_of_fade * q2;
        even = even + saw_wave(all, float(k + 1), fade);
        all = turn_sum(all, turn);
        fade = fade * step_of_fade;
        step_of_fade = step_of_fade * q2;
    }
    SawPair both = {even + odd, even - odd};
    return both;
}

// A square whose sides change x by a >= b, a + b <= 1, and the one tooth that it meets.
FORMULA vec2 narrow_box_saw(const float x, const float a, const float b)
{
    float off = x - floor(x + 0.5f);
    float t = abs(off);
    float outer = 0.5f * (a + b);
    float inner = 0.5f * (a - b);
    float above = 1.0f; // share of the square on this side of the tooth
    float distance_mean = t;
    if (t <= inner) {
        above = 0.5f + t / a;
        distance_mean = (t * t - inner * inner + b * b / 3.0f) / a + inner;
    } else if (t < outer) {
        float rest = outer - t;
        above = 1.0f - 0.5f * rest * rest / (a * b);
        distance_mean = t + rest * rest * rest / (3.0f * a * b);
    }
    float below = off < 0.0f ? 1.0f - above : above;
    return vec2(off + 0.5f - below, off * off + (a * a + b * b) / 12.0f + 1.0f / 6.0f - distance_mean);
}

// The third and fourth polynomials as the second integrals of saw and parabola.
FORMULA vec2 saw_integral_2(const float x)
{
    float f = x - floor(x);
    return vec2(((f - 1.5f) * f + 0.5f) * f / 6.0f, (((f - 2.0f) * f + 1.0f) * f * f - 1.0f / 30.0f) / 12.0f);
}

// A square whose sides change x by a >= b, a + b > 1.
FORMULA vec2 wide_box_saw(const float x, const float a, const float b)
{
    if (b < 1e-3f) { // too narrow to tell its sides apart
        vec2 before = sharp_saw(x - 0.5f * a);
        vec2 after = sharp_saw(x + 0.5f * a);
        float cube_before = 6.0f * saw_integral_2(x - 0.5f * a).x;
        float cube_after = 6.0f * saw_integral_2(x + 0.5f * a).x;
        return vec2((after.y - before.y) / (2.0f * a), (cube_after - cube_before) / (3.0f * a));
    }
    float outer = 0.5f * (a + b);
    float inner = 0.5f * (a - b);
    return (saw_integral_2(x + outer) - saw_integral_2(x + inner) - saw_integral_2(x - inner) + saw_integral_2(x - outer)) / (a * b);
}

// Whether a kernel is so wide that waves are added up.
FORMULA bool is_wide(const Blur blur)
{
    return blur.kernel == KERNEL_GAUSS && blur.a > NARROW_GAUSS;
}

// Saw and parabola at x through a kernel that is not.
FORMULA vec2 narrow_saw(const float x, const Blur blur)
{
    if (blur.kernel == KERNEL_NONE)
        return sharp_saw(x);
    if (blur.kernel == KERNEL_GAUSS)
        return narrow_gauss_saw(x, blur.a);
    return blur.a + blur.b <= 1.0f ? narrow_box_saw(x, blur.a, blur.b) : wide_box_saw(x, blur.a, blur.b);
}

// Through any kernel. `turn` is turn_of(x); it is not looked at where the kernel has no fade.
FORMULA vec2 blurred_saw_turned(const float x, const vec2 turn, const Blur blur)
{
    return is_wide(blur) ? wide_gauss_saws(turn, blur.fade).here : narrow_saw(x, blur);
}

FORMULA vec2 blurred_saw(const float x, const Blur blur)
{
    return blurred_saw_turned(x, blur.fade > 0.0f ? turn_of(x) : vec2(0.0f, 0.0f), blur);
}

// What tells of stretches that begin or end where the phase is whole: blurred saws there, where it is `reach`, and where it is -reach.
struct SawEnds {
    SawPair start;  // at x
    SawPair after;  // at x - reach
    SawPair before; // at x + reach
};

// `halves` tells whether the saws half a period on are wanted; else they are those here.
FORMULA SawEnds blurred_saw_ends(const float x, const float reach, const bool halves, const Blur blur)
{
    SawEnds s;
    if (is_wide(blur)) {
        vec2 turn = turn_of(x);
        vec2 reach_turn = turn_of(reach);
        s.start = wide_gauss_saws(turn, blur.fade);
        s.after = wide_gauss_saws(turn_difference(turn, reach_turn), blur.fade);
        s.before = wide_gauss_saws(turn_sum(turn, reach_turn), blur.fade);
    } else {
        s.start.here = narrow_saw(x, blur);
        s.after.here = narrow_saw(x - reach, blur);
        s.before.here = narrow_saw(x + reach, blur);
        if (halves) {
            s.start.half_on = narrow_saw(x + 0.5f, blur);
            s.after.half_on = narrow_saw(x + 0.5f - reach, blur);
            s.before.half_on = narrow_saw(x + 0.5f + reach, blur);
        }
    }
    if (!halves) {
        s.start.half_on = s.start.here;
        s.after.half_on = s.after.here;
        s.before.half_on = s.before.here;
    }
    return s;
}

// How much of the kernel at x lies where the phase is within `length` after `start`, in every period.
FORMULA float blurred_pulse(const float x, const float start, const float length_of, const Blur blur)
{
    if (length_of <= 0.0f || length_of >= 1.0f)
        return length_of <= 0.0f ? 0.0f : 1.0f;
    float from = x - start;
    if (blur.kernel == KERNEL_NONE)
        return from - floor(from) < length_of ? 1.0f : 0.0f;
    return clamp(length_of + blurred_saw(from - length_of, blur).x - blurred_saw(from, blur).x, 0.0f, 1.0f);
}

// A stretch of the phase under a kernel.
struct Stretch {
    float weight; // how much of the kernel is in it, in [0,1]
    float middle; // where that is on average, from the stretch's centre
    float spread; // standard deviation about there
};

// From the blurred saws at its two ends.
FORMULA Stretch stretch_under(const vec2 at_start, const vec2 at_end, const float length_of, const Blur blur)
{
    Stretch s = {clamp(length_of + at_end.x - at_start.x, 0.0f, 1.0f), 0.0f, 0.0f};
    if (length_of <= 0.0f || s.weight < 1e-5f) {
        s.weight = 0.0f;
        return s;
    }
    float moment = 0.5f * (length_of * (at_start.x + at_end.x) + at_end.y - at_start.y);
    s.middle = clamp(moment / s.weight, -0.5f * length_of, 0.5f * length_of);
    float variance = blur_variance(blur);
    s.spread = sqrt(variance / (1.0f + 12.0f * variance / (length_of * length_of)));
    return s;
}
