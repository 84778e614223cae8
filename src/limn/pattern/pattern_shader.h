#pragma once

#include <optional>

#include "limn/formulas/formulas.h"
#include "limn/pattern/layer_stack.h"
#include "limn/pattern/pattern_camera.h"

namespace limn {

/// The light of a pattern, in its frame: from far away, or from a place. `share` below is how much of it nothing hides.
struct PatternLight {
    formulas::Illumination lighting; ///< of a light far away; the surroundings
    std::optional<vec3> place;       ///< of a point light
    vec3 intensity = vec3(0);        ///< of it, W/sr
    vec3 falloff = vec3(0, 0, 1);    ///< of it: 1 / (a + b d + c d^2)

    /// @param share  of the light that nothing hides
    formulas::Illumination at(const vec3& position, float share = 1) const
    {
        formulas::Illumination lit = place ? formulas::lit_by_point(lighting, *place, intensity, falloff, position) : lighting;
        lit.light *= share;
        return lit;
    }
};

/// Bricks; the frame's axes are those of the wall.
struct BrickShader {
    formulas::BrickPattern pattern;
    formulas::Finish finish;
    PatternLight light;

    vec4 at(const formulas::PatternPoint& p, int kernel, float width, float share = 1) const
    {
        return vec4(formulas::bricks_through(pattern, finish, p, kernel, width, light.at(p.position, share)), 1);
    }
};

/// Cloth around a sphere, or laid on any surface from its middle out; the axis is the frame's y. Opacity is 0 in holes, and colours are multiplied
/// with it.
struct ThreadShader {
    formulas::ThreadPattern pattern;
    PatternLight light;
    vec3 centre = vec3(0);
    float radius = 1; ///< for samples, which lie on the sphere

    vec4 at(const formulas::PatternPoint& p, int kernel, float width, float share = 1) const
    {
        return formulas::thread_around(pattern, centre, p, kernel, width, light.at(p.position, share));
    }
};

/// Layers of a print.
struct LayerShader {
    formulas::LayerPattern pattern;
    formulas::Finish finish;
    PatternLight light;
    LayerStack stack;

    vec4 at(const formulas::PatternPoint& p, int kernel, float width, float share = 1) const
    {
        const vec2 change = formulas::change_per_pixel(p, pattern.up);
        const formulas::LayerPlace where = stack.place(glm::dot(p.position, pattern.up), change, width);
        return vec4(formulas::layers_through(pattern, finish, p, where, kernel, width, light.at(p.position, share)), 1);
    }
};

} // namespace limn
