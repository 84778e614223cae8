#pragma once

#include <vector>

#include "limn/shadow/caster_rays.h"
#include "limn/shadow/shadow_maps.h"

/// Nanoseconds of processor time for each query in one thread, medians.
struct LookUpTimes {
    double rays = 0;         ///< Embree's any-hit ray
    double seed = 0;         ///< the seed's lists, many at once
    double bricks = 0;       ///< bricks, many at once
    double bricks_alone = 0; ///< bricks, one after the other
};

/// Places on an object that face lights around it, in a random order.
std::vector<limn::ShadowQuery> shuffled_queries(const limn::CasterRays& rays);
LookUpTimes time_look_ups(const limn::CasterRays& rays, const limn::ShadowMaps& seed, const limn::ShadowMaps& bricks, const std::vector<limn::ShadowQuery>& queries);
