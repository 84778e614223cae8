// What a view makes of the vertices (extract_vertices.comp) and what the passes of line extraction (line_extraction.h) ask of it.
#include "limn/formulas/suggestive_line.glsl"

const uint BLOCK = 256u; // threads of a work-group
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 2) buffer Values { vec4 values[]; }; // per vertex n.v, kr, strength of contours and of highlights
layout(std430, binding = 3) buffer Speeds { vec2 speeds[]; }; // per vertex turn and gradient; unread where no speed is limited

uniform vec3 eye; // position, or the direction towards it
uniform int orthographic;
uniform uint wanted; // bit k: kind k of contours, suggestive contours, suggestive highlights
uniform SuggestiveLimits limits[2]; // of contours and of highlights

vec3 to_eye(const vec3 p) { return orthographic != 0 ? eye : eye - p; }
uint group_number() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
