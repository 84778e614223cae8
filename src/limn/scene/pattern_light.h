#pragma once

#include <span>

#include "limn/camera/camera.h"
#include "limn/pattern/options.h"
#include "limn/pattern/pattern_shader.h"
#include "limn/raycast/occlusion.h"
#include "limn/raycast/shading.h"

namespace limn {

/// The light of a picture of a pattern in the frame (world - centre) / scale: that of `shade`, or a studio's, wide, from the upper left before
/// the object. @param up  of the world, unit  @throws Error::Input for environments, which are many lights
PatternLight pattern_light(const dvec3& centre, double scale, const Camera& camera, const ShadeOptions& shade, const dvec3& up);

/// How much of the light nothing hides from a place, by some of its places; each pixel turns them its own way.
/// @param places  in a unit square around 0, evenly spread; at least one @param from  off the surface already
float light_share(const Occlusion& occlusion, const PatternLight& light, std::span<const vec2> places, const vec3& from, const vec2& pixel);

/// How the filament of a print reflects, or what is asked for instead of it.
formulas::Finish print_finish(const PatternOptions& options);

} // namespace limn
