// What lines are found in, per pixel, before it is brought into the filters' units.
layout(location = 0) out vec4 shape;      // unit normal, depth along the viewing direction
layout(location = 1) out float intensity; // under a headlight
layout(location = 2) out uint id;         // of the object, counted from 1; 0 where nothing is seen
in vec3 position;
in vec3 normal;
flat in uint object;
uniform vec3 eye;        // position, or the direction towards it
uniform int orthographic;
uniform vec4 depth_of;   // depth = dot(xyz, position) + w

void main()
{
    vec3 n = normalize(normal);
    vec3 to_eye = orthographic != 0 ? eye : normalize(eye - position);
    shape = vec4(n, dot(depth_of.xyz, position) + depth_of.w);
    intensity = abs(dot(n, to_eye));
    id = object + 1u;
}
