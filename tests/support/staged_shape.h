#pragma once

#include <string>

#include "limn/lines/draw.h"
#include "limn/lines/regions.h"
#include "limn/surface/shapes.h"

namespace limn::test {

/// A generated shape with its exact surface, ready to be drawn.
struct StagedShape {
    Shape shape;
    LineModel model;
    RayScene rays;

    StagedShape(const std::string& name, std::size_t triangles)
        : shape(make_shape({.name = name, .triangles = triangles, .float_positions = false})), model(model_of(shape)), rays(build_ray_scene(model))
    {
    }
    Camera camera(ivec2 size, bool orthographic = false, const std::string& view = "35,25") const
    {
        return Camera::framing(shape.mesh.bounds(), {.view = view, .up_axis = 'z', .size = size, .orthographic = orthographic});
    }
    SeenScene seen() const { return seen_scene(model, rays); }

private:
    static LineModel model_of(const Shape& shape)
    {
        const PlacedSurface placed = {&shape.mesh, &shape.exact};
        return build_line_model({&placed, 1});
    }
};

} // namespace limn::test
