#pragma once

#include "limn/camera/camera.h"
#include "limn/lines/line_model.h"

namespace limn {

/// The camera in the frame of a LineModel: many points to pixels.
struct Projector {
    bool orthographic = false;
    dvec3 eye, right, above, forward; ///< the eye in the model's frame
    double scale = 1;                 ///< pixels per (unit over depth), or per unit for an orthographic camera
    dvec2 middle = dvec2(0);          ///< centre of the picture, pixels

    Projector(const LineModel& model, const Camera& camera)
        : orthographic(camera.orthographic), eye((camera.eye - model.centre) / model.scale), right(camera.right()),
          above(camera.above()), forward(camera.forward()),
          scale(camera.pixels_per_unit(1) * (camera.orthographic ? model.scale : 1)), middle(dvec2(camera.size) * 0.5)
    {
    }
    double depth(const vec3& p) const { return glm::dot(dvec3(p) - eye, forward); }
    /// x, y in pixels (y down) and the depth in the model's frame.
    dvec3 project(const vec3& p) const
    {
        const dvec3 d = dvec3(p) - eye;
        const double z = glm::dot(d, forward), s = orthographic ? scale : scale / z;
        return {middle.x + s * glm::dot(d, right), middle.y - s * glm::dot(d, above), z};
    }
    /// Where the picture's parameter t between two projected ends lies on the segment in space (1/z is linear in the picture).
    double space_parameter(double t, double depth_a, double depth_b) const
    {
        return orthographic ? t : t * depth_a / (depth_b * (1 - t) + t * depth_a);
    }
};

} // namespace limn
