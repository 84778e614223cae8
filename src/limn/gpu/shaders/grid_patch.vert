// Four vertices a patch, which carry its number.
void main() { gl_Position = vec4(float(gl_VertexID / 4), 0.0f, 0.0f, 1.0f); }
