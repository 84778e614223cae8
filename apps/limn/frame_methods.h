#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "limn/camera/camera.h"
#include "limn/geometry/bounds.h"
#include "limn/lines/draw.h"
#include "limn/surface/shapes.h"

/// A generated model with what every method needs of it.
struct FrameSubject {
    limn::Bounds bounds;
    limn::LineModel model;
    limn::RayScene rays;
    /// @throws limn::Error::Input for an unknown shape.
    FrameSubject(const std::string& shape, std::size_t triangles);

private:
    explicit FrameSubject(const limn::Shape& shape);
};

/// Milliseconds of each stage of one frame.
using StageTimes = std::vector<double>;

/// A way to a picture with lines. `frame` draws one and waits for it; it keeps what it made of the subject.
struct FrameMethod {
    std::string name;
    std::vector<std::string> stages;
    bool by_pixel = false;               ///< its cost depends on the picture's size
    std::array<int, 5> study = {};       ///< the study's mean frames per second for its five meshes; 0: none given
    std::function<StageTimes(const limn::Camera&)> frame;
};

/// Every method for one subject, which must outlive them. Needs a gpu::Context.
std::vector<FrameMethod> frame_methods(const FrameSubject& subject);

/// The views of one full turn about each axis, `steps` each: the camera is where a face of the box, seen along -z, fills the picture.
std::vector<limn::Camera> turning_cameras(const limn::Bounds& bounds, int pixels, int steps);
