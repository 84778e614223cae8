#pragma once

#include "limn/pattern/bead_colours.h"
#include "limn/pattern/options.h"
#include "limn/pattern/pattern_camera.h"
#include "limn/pattern/pattern_shader.h"
#include "limn/scene/print_scene.h"

namespace limn {

/// A place of a bead that a line of sight meets, in the frame of a SeenPrint.
struct SeenBead {
    std::uint32_t bead = none;
    vec3 position = vec3(0), normal = vec3(0); ///< of the bead's own surface
    bool hit() const { return bead != none; }
};

/// How dense the structure of a surface that beads make is in a picture, in pixels a period.
struct BeadPeriods {
    float layers = 0;   ///< of the layers, along the surface
    float beads = 0;    ///< of the beads side by side
    bool level = false; ///< the surface is more of a floor than of a wall: what is seen of it lies side by side
    float facing =
        1; ///< of a wall: the part of the direction to the eye that is level and out of it. Below 0 only steps are seen, from behind
    /// What decides whether beads can be drawn one by one.
    float least() const;
    /// How much of a pixel is drawn bead by bead, in [0,1]. @param detail  pixels from which on a period is
    float bodies(float detail) const;
};

/// Lights beads in two ways that give the same mean: as the bodies that they are, and as the layers that they make, seen through a pixel's kernel
/// (formulas/print_layers.glsl, whose rounded edges are half circles as those of beads are).
class BeadShader {
public:
    BeadShader(const SeenPrint& print, const PrintPath& path, const PatternCamera& camera, const PatternOptions& options,
               const formulas::Finish& finish, const PatternLight& light, const BeadColours& colours);

    /// Radiance of a place of a bead. @param share  of the light that nothing hides
    vec3 own(const SeenBead& seen, float share) const;
    /// Radiance of the pixel that sees the place in a surface that beads make.
    /// @param surface  normal of that surface, unit, towards the eye @param colour  linear, of the beads around
    vec3 filtered(const SeenBead& seen, const vec3& surface, const vec3& colour, float share) const;
    BeadPeriods periods(const SeenBead& seen, const vec3& surface) const;
    vec3 colour(const SeenBead& seen) const { return colours_.of(move(seen)); }
    const PrintMove& move(const SeenBead& seen) const { return path_.moves[print_.moves[seen.bead]]; }

private:
    struct Groove {
        bool narrow = false;                   ///< false: the place is in the open
        vec3 out = vec3(0), towards = vec3(0); ///< out of it, and to the bead that is near, unit
        float shift = 0;                       ///< how much further in that bead is
    };
    Groove groove(const SeenBead& seen) const;
    formulas::PatternPoint point(const SeenBead& seen, const vec3& surface, const BeadShape& shape) const;
    vec3 floor(const formulas::PatternPoint& seen, const BeadShape& shape, const formulas::Finish& finish,
               const formulas::Illumination& lit) const;

    const SeenPrint& print_;
    const PrintPath& path_;
    const PatternCamera& camera_;
    formulas::Finish finish_;
    PatternLight light_;
    const BeadColours& colours_;
    int kernel_;
    float width_, variety_;
};

} // namespace limn
