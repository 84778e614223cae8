// The surface's depth alone.
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
uniform mat4 to_clip;

void main() { gl_Position = to_clip * vec4(positions[gl_VertexID].xyz, 1.0f); }
