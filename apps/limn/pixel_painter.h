#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "limn/gpu/context.h"
#include "limn/lines/image_lines.h"
#include "limn/lines/shader_lines.h"
#include "limn/raycast/shading.h"
#include "pictures.h"

/// What is decided pixel by pixel: lit surfaces and the lines found in them.
struct PixelOptions {
    limn::ShadeOptions shade;
    limn::ImageLineOptions image_lines;
    limn::ShaderLineOptions shader_lines;
    limn::vec3 ink = limn::vec3(0); ///< colour of such lines
};

/// Paints models on the processor or a GPU, and keeps what it made of a model from view to view.
class PixelPainter {
public:
    using Say = std::function<void(const std::string&)>;
    /// @param device  "cpu"; "gpu": any driver, Mesa's software renderer too; "auto": a graphics card where there is one that works
    /// @param say     hears, in one line, when "auto" finds a graphics card that does not do its work
    /// @throws limn::Error::Device where "gpu" was asked for and there is no driver.
    PixelPainter(const std::string& device, Say say);
    ~PixelPainter();

    /// @throws limn::Error::Device where "gpu" was asked for and it fails at its work.
    limn::Image paint(const SeenModel& model, const limn::Camera& camera, const PixelOptions& options);
    /// "processor", or the name of the GPU.
    std::string device() const;

private:
    limn::Image paint_once(const SeenModel& model, const limn::Camera& camera, const PixelOptions& options);

    Say say_;
    bool may_fall_back_ = false;
    std::optional<limn::gpu::Context> context_;
    struct OnGpu;
    std::unique_ptr<OnGpu> on_gpu_; ///< after the context: it goes first
};
