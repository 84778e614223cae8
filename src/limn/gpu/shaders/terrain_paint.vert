// Corners of a terrain's mesh, around its middle. Depths run from 1 (nearest) to 0: so floats tell far ones apart too.
layout(std430, binding = 0) readonly buffer Vertices { vec4 vertices[]; }; // metres; w: 0 lowest to 1 highest
uniform vec3 middle;    // from the eye
uniform vec3 right;
uniform vec3 above;
uniform vec3 forward;
uniform vec2 across;    // half of the picture at depth 1, or at any in parallel views
uniform float nearest;  // metres of depth that are drawn, from
uniform float farthest; // to, in parallel views
uniform int parallel;
out float height;
out vec2 ground; // from the middle, metres

void main()
{
    vec4 v = vertices[gl_VertexID];
    vec3 place = v.xyz + middle;
    height = v.w;
    ground = v.xy;
    float depth = dot(forward, place);
    vec2 plane = vec2(dot(right, place), dot(above, place)) / across;
    if (parallel != 0)
        gl_Position = vec4(plane, 1.0f - (depth - nearest) / (farthest - nearest), 1.0f);
    else
        gl_Position = vec4(plane, nearest, depth);
}
