#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "limn/shadow/caster_rays.h"

namespace limn {

/// Answers many queries in an object's unit space.
using AskShadows = std::function<void(std::span<const ShadowQuery>, std::span<Verdict>)>;

/// Pictures of an object from random places on its sphere, each lit by a lamp at a random place outside (the coherent shadow map specification, 7.7).
struct ObjectErrorOptions {
    int images = 100;
    int size = 96;             ///< pixels along a side
    double nearest = 1.05, farthest = 3.05; ///< of lamps from the middle, in radii
    double fov_degrees = 70;   ///< of the cameras, which look at the middle
    std::uint64_t seed = 1;
};

/// How many answers are not those of rays.
struct ObjectShadowError {
    std::size_t pixels = 0;  ///< of all pictures
    std::size_t object = 0;  ///< that show the object
    std::size_t facing = 0;  ///< that show a side of it that faces the lamp: only they are asked about
    std::size_t wrong = 0;
    std::size_t unknown = 0; ///< could not be told; not wrong
    double of_pixels() const { return share(pixels); } ///< wrong ones in %
    double of_object() const { return share(object); }
    double of_facing() const { return share(facing); }

private:
    double share(std::size_t whole) const { return whole == 0 ? 0 : 100 * double(wrong) / double(whole); }
};

/// In parallel; the same for any number of threads.
/// @throws Error::Input for no images, pixels or a lamp inside the sphere
ObjectShadowError object_shadow_error(const CasterRays& truth, const AskShadows& ask, const ObjectErrorOptions& options = {});

/// Places on a floor under an object, lit from above: rays from random lamps through random points of the object's sphere to the plane y = -1,
/// where they meet it within 4 radii (section 8.3).
struct FloorErrorOptions {
    int rays = 60000;
    std::uint64_t seed = 1;
};
struct FloorShadowError {
    std::size_t queries = 0, wrong = 0;
    double of_queries() const { return queries == 0 ? 0 : 100 * double(wrong) / double(queries); } ///< in %
};
FloorShadowError floor_shadow_error(const CasterRays& truth, const AskShadows& ask, const FloorErrorOptions& options = {});

} // namespace limn
