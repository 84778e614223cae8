#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "limn/gpu/context.h"
#include "limn/lines/image_lines.h"
#include "limn/lines/line_model.h"
#include "limn/lines/shader_lines.h"
#include "limn/raycast/shading.h"
#include "limn/scene/loop_model.h"
#include "limn/scene/pattern_picture.h"

namespace limn {

/// A model as lines and rays see it.
struct SeenModel {
    const LineModel& lines;
    const SeenScene& scene; ///< seen_scene of `lines`
    dvec3 up;               ///< of the world
    const LoopView* loops = nullptr; ///< where `lines` is that of control meshes as cut for a camera
};

/// What is decided pixel by pixel: lit surfaces and the lines found in them.
struct PixelOptions {
    ShadeOptions shade;
    ImageLineOptions image_lines;
    ShaderLineOptions shader_lines;
    vec3 ink = vec3(0); ///< colour of such lines
    PatternOptions pattern = {}; ///< where it is not plain, surfaces are made of it instead of their materials
    PatternPlace place = {};
};

/// Paints models on the processor or a GPU, and keeps what it made of a model from view to view.
class PixelPainter {
public:
    using Say = std::function<void(const std::string&)>;
    /// @param device  "cpu"; "gpu": any driver, Mesa's software renderer too; "auto": a graphics card where there is one that works
    /// @param say     hears, in one line, when "auto" finds a graphics card that does not do its work
    /// @throws Error::Device where "gpu" was asked for and there is no driver.
    PixelPainter(const std::string& device, Say say);
    ~PixelPainter();

    /// Shadows, lights with a size and openness are computed on the processor.
    /// @throws Error::Device where "gpu" was asked for and it fails at its work, Error::Input where it was asked for what it does not do.
    Image paint(const SeenModel& model, const Camera& camera, const PixelOptions& options);
    /// "processor", or the name of the GPU.
    std::string device() const;

private:
    /// @param can  whether it is able to. @throws Error::Input where it has to and is not
    bool uses_gpu(bool can) const;
    Image lit(const SeenModel& model, const Camera& camera, const PixelOptions& options);
    Image patterned(const SeenModel& model, const Camera& camera, const PixelOptions& options);
    Image paint_once(const SeenModel& model, const Camera& camera, const PixelOptions& options);

    Say say_;
    bool may_fall_back_ = false;
    std::optional<gpu::Context> context_;
    struct OnGpu;
    std::unique_ptr<OnGpu> on_gpu_; ///< after the context: it goes first
};

} // namespace limn
