// What pictures need of a surface, at its vertices. Everything is computed at every vertex, back sides too (trap T8: what is left out
// there is undefined in the very faces that hold the contour).
#include "limn/formulas/radial_curvature.glsl"

struct Vertex {
    vec4 position;   // w: number of the object, counted from 1
    vec4 normal_k1;
    vec4 e1_k2;
    vec4 derivative; // P Q S T
};
layout(std430, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
uniform mat4 to_clip;
uniform vec3 eye;        // position, or the direction towards it
uniform int orthographic;

out float nv;
out float kr;
out float dwkr;
out float strength;     // sin^2(theta) D kr
out vec3 normal;
out float eye_depth;     // w of the clip position: along the viewing direction
flat out uint object;

void main()
{
    Vertex p = vertices[gl_VertexID];
    vec3 v = orthographic != 0 ? eye : eye - p.position.xyz;
    vec3 n = p.normal_k1.xyz;
    float k1 = p.normal_k1.w;
    float k2 = p.e1_k2.w;
    RadialTerms t = radial_terms(v, n, p.e1_k2.xyz, cross(n, p.e1_k2.xyz), k1, k2);
    nv = t.nv / sqrt(t.vv);
    kr = radial_curvature(t, k1, k2);
    dwkr = radial_curvature_derivative(t, k1, k2, p.derivative);
    strength = suggestive_strength(t, dwkr, 1.0f, 0.0f);
    normal = n;
    object = uint(p.position.w + 0.5f);
    gl_Position = to_clip * vec4(p.position.xyz, 1.0f);
    eye_depth = gl_Position.w;
}
