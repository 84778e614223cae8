#pragma once

#include "limn/base/vec.h"

namespace limn {

/// A straight piece of printed bead. Its section is a stadium, width by height; its ends are round, so that pieces that meet make a round joint: the
/// body is all that is within half the thinner of both sides of a flat strip whose ends are half circles.
struct Bead {
    vec3 from, to;       ///< the ends of its middle line
    float width, height; ///< above 0; the height is upright where the bead is level
};

/// The body of a bead in its own frame: along it, level aside, and above.
class BeadShape {
public:
    explicit BeadShape(const Bead& bead);

    /// Half the sides of the box around the body between two parts of its length, each in [0,1], and that box's middle.
    vec3 half_box(float part) const;
    vec3 middle() const { return middle_; }
    const vec3& along() const { return along_; }
    const vec3& aside() const { return aside_; }
    const vec3& above() const { return above_; }
    float half_length() const { return half_; }
    float flat() const { return flat_; }   ///< half of the width that is flat
    float round() const { return round_; } ///< radius of the rounding
    float width() const { return 2 * (flat_ + round_); }
    float height() const { return 2 * (tall_ + round_); }

    /// How far a place is from the body; below 0 inside. `normal`: the unit direction in which that grows.
    float distance(const vec3& place, vec3& normal) const;
    /// Where a line that starts outside enters.
    /// @param direction  unit
    /// @return how far away that is, at most `far`; below 0 where it does not
    float meet(const vec3& origin, const vec3& direction, float near, float far, vec3& normal) const;

private:
    /// In the frame: the distance and its gradient, which is a unit vector outside the core.
    float local_distance(const vec3& p, vec3& gradient) const;

    vec3 middle_, along_, aside_, above_;
    float half_;                ///< of the length
    float flat_, tall_, round_; ///< half of what is flat across and above, and the radius of the rounding
};

} // namespace limn
