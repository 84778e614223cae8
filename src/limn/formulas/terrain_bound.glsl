// How far in the picture heights may be off in a box of terrain, and whether it can be seen. One text for C++, where REAL is double, and GLSL,
// where it is float: decisions have to agree for boxes inside each other, which the larger `slack` of the outer one sees to.
// z is up. Places are relative to the eye, in metres; results in pixels. See terrain_error.glsl for the distance itself.
#pragma once

const float NO_TERRAIN_BOUND = 3.402823466e38f; // where a box reaches nearer to the eye than the camera's near depth

// The camera's axes in the world and its scale: pixels at depth 1, or pixels for each metre of a parallel projection.
struct BoundCamera {
    REAL3 right;
    REAL3 above;
    REAL3 forward;
    REAL scale;
    REAL near_depth;
    REAL is_parallel;
};

// A bound of both for all places in a box, for errors of up to `error` metres between two places in it. Never less for a box around another,
// where that has the greater `slack`: a share of the result, against rounding.
// reach: half the box's size.
FORMULA REAL height_error_bound(const BoundCamera camera, const REAL3 middle, const REAL3 reach, const REAL error, const REAL slack)
{
    if (!(error > REAL(0.0f)))
        return REAL(0.0f);
    REAL scaled = camera.scale * error * (REAL(1.0f) + slack);
    if (camera.is_parallel > REAL(0.5f))
        return scaled;
    REAL nearest = dot(camera.forward, middle) - dot(abs(camera.forward), reach);
    if (nearest <= camera.near_depth * (REAL(1.0f) + slack))
        return REAL(NO_TERRAIN_BOUND);
    // |(u x p)_(x,y)| is at most |u x p|, the distance from the eye in the plane.
    REAL aside = length(REAL2(middle.x, middle.y)) + length(REAL2(reach.x, reach.y));
    REAL3 outside = max(abs(middle) - reach, REAL3(0.0f, 0.0f, 0.0f));
    REAL apart = max(length(outside), nearest);
    return scaled * max(aside / (nearest * nearest), REAL(1.0f) / apart);
}

// Whether a box can be seen: some of it is on the inner side of each plane through the eye and a side of the picture, or nearer to it than
// `slack` metres.
// across: half the picture's size at depth 1, or in metres for a parallel projection.
FORMULA bool box_may_be_seen(const BoundCamera camera, const REAL2 across, const REAL3 middle, const REAL3 reach, const REAL slack)
{
    REAL3 x = camera.right;
    REAL3 y = camera.above;
    if (camera.is_parallel > REAL(0.5f))
        return abs(dot(x, middle)) <= across.x + dot(abs(x), reach) + slack && abs(dot(y, middle)) <= across.y + dot(abs(y), reach) + slack;
    REAL3 forward = camera.forward;
    REAL3 west = forward * across.x + x;
    REAL3 east = forward * across.x - x;
    REAL3 south = forward * across.y + y;
    REAL3 north = forward * across.y - y;
    return dot(forward, middle) + dot(abs(forward), reach) >= -slack && dot(west, middle) + dot(abs(west), reach) >= -slack &&
           dot(east, middle) + dot(abs(east), reach) >= -slack && dot(south, middle) + dot(abs(south), reach) >= -slack &&
           dot(north, middle) + dot(abs(north), reach) >= -slack;
}
