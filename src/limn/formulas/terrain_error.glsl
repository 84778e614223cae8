// How far a height that is off moves a point in the picture. One text for C++ and GLSL.
// z is up. Places are relative to the eye, in metres; results in pixels. Reference: Heide 2009, section on the error metric (the terrain
// specification, 2.2), where the projection of a difference of heights is worked out, so that no digits cancel:
// p and q = p + (0, 0, dz) are dz |(u x p)_(x,y)| / (p.z q.z) apart in a picture at distance 1, in the camera's axes, where u is "up".
#pragma once

const float NO_BOUND = 3.402823466e38f; // in front of the camera's near plane and behind it: as far off as can be

// The camera's axes in the world and its scale: pixels at depth 1, or pixels for each metre of a parallel projection.
struct ErrorCamera {
    vec3 right;
    vec3 above;
    vec3 forward;
    float scale;
    float near_depth; // what is nearer has no bound
    float is_parallel; // 1 or 0
};

// How far above the middle of an edge the terrain is: heights of the edge's ends and of the terrain at its middle. The same for both orders of the
// ends; differences first, so that heights far from 0 lose no digits.
FORMULA REAL height_off_chord(const REAL a, const REAL middle, const REAL b)
{
    return REAL(0.5f) * ((middle - a) + (middle - b));
}

// The distance in the picture between a place and the one dz above it.
FORMULA float height_error_exact(const ErrorCamera camera, const vec3 place, const float dz)
{
    float ux = camera.right.z;
    float uy = camera.above.z;
    float uz = camera.forward.z;
    if (camera.is_parallel > 0.5f)
        return camera.scale * abs(dz) * sqrt(ux * ux + uy * uy);
    float z = dot(camera.forward, place);
    float far_z = z + dz * uz;
    if (min(z, far_z) <= camera.near_depth)
        return NO_BOUND;
    float x = dot(camera.right, place);
    float y = dot(camera.above, place);
    float cx = ux * z - x * uz;
    float cy = uy * z - y * uz;
    return camera.scale * abs(dz) * sqrt(cx * cx + cy * cy) / (z * far_z);
}

// The same where the error may point in any direction: it does not vanish where one looks straight down.
FORMULA float height_error_any_way(const ErrorCamera camera, const vec3 place, const float dz)
{
    if (camera.is_parallel > 0.5f)
        return camera.scale * abs(dz);
    if (dot(camera.forward, place) <= camera.near_depth)
        return NO_BOUND;
    return camera.scale * abs(dz) / length(place);
}
