// Reflection of light by plastic and thread (the procedural structures specification, 2.3 and 7.4). Directions are unit vectors that point
// away from the surface.
#pragma once
#include "limn/formulas/irradiance.glsl"

const float BRDF_PI = 3.14159265359f;

const int FINISH_MATTE = 0;       // Lambert's law alone
const int FINISH_PHONG = 1;       // modified Phong
const int FINISH_BLINN_PHONG = 2; // modified Blinn-Phong
const int FINISH_GGX = 3;         // microfacets

// What a surface is made of.
struct Finish {
    int model;
    vec3 colour;     // diffuse albedo, linear
    float specular;  // of the Phong models
    float exponent;
    float along;     // GGX: roughness (alpha) along the direction that is given with the normal, and across
    float across;
    float f0;        // GGX: reflectance straight on
};

// The specular lobes without their albedo, 1/sr.
FORMULA float phong_lobe(const vec3 n, const vec3 to_light, const vec3 to_eye, const float exponent)
{
    vec3 mirrored = n * (2.0f * dot(to_light, n)) - to_light;
    return (exponent + 2.0f) / (2.0f * BRDF_PI) * pow(max(dot(mirrored, to_eye), 0.0f), exponent);
}

FORMULA float blinn_phong_lobe(const vec3 n, const vec3 to_light, const vec3 to_eye, const float exponent)
{
    vec3 between = to_light + to_eye;
    float size = dot(between, between);
    if (size < 1e-12f)
        return 0.0f;
    return (exponent + 8.0f) / (8.0f * BRDF_PI) * pow(max(dot(between, n) * inversesqrt(size), 0.0f), exponent);
}

// Fresnel's reflectance after Schlick.
FORMULA float schlick(const float f0, const float cosine)
{
    float m = clamp(1.0f - cosine, 0.0f, 1.0f);
    float m2 = m * m;
    return f0 + (1.0f - f0) * m2 * m2 * m;
}

// GGX with the height-correlated masking of Smith, without Fresnel's factor, 1/sr. `t` is a unit tangent.
FORMULA float ggx_lobe(const vec3 n, const vec3 t, const vec3 to_light, const vec3 to_eye, const float along, const float across)
{
    float nl = dot(n, to_light);
    vec3 between = to_light + to_eye;
    float size = dot(between, between);
    if (nl <= 0.0f || size < 1e-12f)
        return 0.0f;
    vec3 h = between * inversesqrt(size);
    vec3 b = cross(n, t);
    float nv = max(dot(n, to_eye), 0.02f);
    vec3 m = vec3(dot(h, t) / along, dot(h, b) / across, dot(h, n));
    float bulk = dot(m, m);
    float density = 1.0f / (BRDF_PI * along * across * bulk * bulk);
    vec3 l = vec3(along * dot(to_light, t), across * dot(to_light, b), nl);
    vec3 v = vec3(along * dot(to_eye, t), across * dot(to_eye, b), nv);
    return density * 0.5f / (nl * sqrt(dot(v, v)) + nv * sqrt(dot(l, l)));
}

// Share of even surrounding light that GGX reflects: the analytic fit of Karis (2014) to its integral.
FORMULA float ggx_ambient(const float f0, const float alpha, const float nv)
{
    float rough = sqrt(alpha);
    float r = 1.0f - rough;
    float slope = min(r * r, exp2(-9.28f * nv)) * r + (0.0425f - 0.0275f * rough);
    return clamp(f0 * (1.04f - 0.572f * rough - 1.04f * slope) + 1.04f * slope + 0.022f * rough - 0.04f, 0.0f, 1.0f);
}

// Radiance towards the eye. `t` is a unit tangent: for anisotropic finishes. `spread` is the variance across it (radians squared) of normals
// that the pixel sees about `n`: they widen highlights.
// `ambient` is the mean radiance of sky and floor that reaches the place, and `seen` how much of them it sees along the mirrored line of sight.
FORMULA vec3 reflected_in(const Finish f, const vec3 n, const vec3 t, const vec3 to_eye, const float spread, const Illumination lit, const vec3 ambient, const float seen)
{
    float cosine = facing(n, lit.to_light);
    vec3 diffuse_light = lit.light * (cosine / BRDF_PI) + ambient;
    float wide = spread + lit.radius * lit.radius / 16.0f;
    if (f.model == FINISH_GGX) {
        float grow = lit.radius * lit.radius / 8.0f;
        float along = min(sqrt(f.along * f.along + grow), 1.0f);
        float across = min(sqrt(f.across * f.across + grow + 2.0f * spread), 1.0f);
        vec3 between = lit.to_light + to_eye;
        float vh = sqrt(max(0.25f * dot(between, between), 0.0f)); // cosine between the eye and the half vector
        float shine = cosine > 0.0f ? ggx_lobe(n, t, lit.to_light, to_eye, along, across) * schlick(f.f0, vh) : 0.0f;
        float nv = clamp(dot(n, to_eye), 0.0f, 1.0f);
        float around = ggx_ambient(f.f0, sqrt(along * across), nv);
        vec3 mirrored = n * (2.0f * dot(n, to_eye)) - to_eye;
        return f.colour * diffuse_light * (1.0f - around) + lit.light * (shine * cosine) + radiance_around(lit, mirrored) * (around * seen);
    }
    float lobe = 0.0f;
    float exponent = f.exponent / (1.0f + f.exponent * wide);
    if (f.model == FINISH_PHONG)
        lobe = phong_lobe(n, lit.to_light, to_eye, exponent);
    if (f.model == FINISH_BLINN_PHONG)
        lobe = blinn_phong_lobe(n, lit.to_light, to_eye, exponent);
    return f.colour * diffuse_light + lit.light * (f.specular * lobe * cosine);
}

// The same of a place in the open.
FORMULA vec3 reflected(const Finish f, const vec3 n, const vec3 t, const vec3 to_eye, const float spread, const Illumination lit)
{
    return reflected_in(f, n, t, to_eye, spread, lit, ambient_around(lit, n), 1.0f);
}

// Hair and thread after Kajiya and Kay: the diffuse part, in [0,1], for a tangent t.
FORMULA float hair_diffuse(const vec3 t, const vec3 to_light)
{
    float c = dot(t, to_light);
    return sqrt(max(1.0f - c * c, 0.0f));
}

// The specular part. sign = -1: about the mirror cone of the light; 1: about the cone on the light's own side, as the seed prints it.
FORMULA float hair_specular(const vec3 t, const vec3 to_light, const vec3 to_eye, const float exponent, const float sign_of)
{
    float cosines = sign_of * dot(t, to_light) * dot(t, to_eye);
    return pow(max(cosines + hair_diffuse(t, to_light) * hair_diffuse(t, to_eye), 0.0f), exponent);
}
