#include "limn/formulas/shading.glsl"

flat in vec3 normal;
in float depth;
uniform vec3 to_light;
layout(location = 0) out vec4 tone;  // of the face that is seen, from 0 to 1
layout(location = 1) out vec4 depth_seen; // metres along the viewing direction

void main()
{
    tone = vec4(vec3(side_tone(normal, to_light, 0.0f, 0.0f)), 1.0f);
    depth_seen = vec4(depth);
}
