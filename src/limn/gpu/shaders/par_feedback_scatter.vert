// A mark to its texel of the edge error map.
layout(location = 0) in uint packed_point;
uniform ivec2 points;

void main()
{
    vec2 p = vec2(float(packed_point & 0xffffu), float(packed_point >> 16)) + 0.5f;
    gl_Position = vec4(2.0f * p / vec2(points) - 1.0f, 0.0f, 1.0f);
}
