#include "limn/scene/pixel_painter.h"

#include "limn/base/error.h"
#include "limn/gpu/field_view.h"
#include "limn/gpu/lit_view.h"
#include "limn/gpu/pattern_view.h"
#include "limn/gpu/surface_view.h"

namespace limn {
namespace {

/// Lines are found at so many times the picture's size and averaged, so that they are not jagged.
constexpr int finer = 2;

/// Pixels along an edge of what a GPU draws at once.
constexpr int gpu_tile = 2048;

Camera finer_camera(Camera camera)
{
    camera.size = finer * camera.size;
    return camera;
}

ShaderLineOptions finer_lines(ShaderLineOptions options)
{
    options.contour_width *= float(finer);
    options.suggestive_width *= float(finer);
    return options;
}

void lay_over(Image& picture, const Image& lines, const vec3& colour)
{
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            float cover = 0;
            for (int k = 0; k < finer * finer; ++k)
                cover += *lines.at(finer * x + k % finer, finer * y + k / finer) / float(finer * finer);
            for (int c = 0; c < 3; ++c)
                picture.at(x, y)[c] = glm::mix(picture.at(x, y)[c], colour[c], cover);
        }
}

Image lit_on_processor(const SeenModel& model, const Camera& camera, const PixelOptions& options) { return shade(model.scene, camera, options.shade); }

Image filtered_on_processor(const SeenModel& model, const Camera& camera, const PixelOptions& options)
{
    return find_image_lines(line_fields(trace_gbuffer(model.scene, camera), camera, model.scene, model.scene.scale), options.image_lines);
}

Image shader_lines_on_processor(const SeenModel& model, const Camera& camera, const ShaderLineOptions& options)
{
    return find_shader_lines(model.lines, trace_gbuffer(model.scene, camera), camera, options);
}

} // namespace

/// What the device has no way to compute.
bool asks_for_visibility(const ShadeOptions& options) { return options.wide || options.occlusion || options.open_radius; }

/// The same of patterns, for which most lights with a size are one that is wide.
bool asks_for_visibility_of_patterns(const ShadeOptions& options)
{
    return options.occlusion || options.open_radius || (options.wide && std::holds_alternative<EnvironmentLight>(*options.wide));
}

/// What the device keeps of a model, made when it is first needed.
struct PixelPainter::OnGpu {
    explicit OnGpu(const SeenModel& of) : model(of.lines), loops(of.loops) {}
    const LineModel& model;
    const LoopView* loops; ///< gone with the model
    std::optional<gpu::LitRenderer> lit;
    std::optional<gpu::FieldRenderer> fields;
    std::optional<gpu::ImageLineFinder> finder;
    std::optional<gpu::SurfaceRenderer> surface;
    std::optional<gpu::PatternRenderer> patterns;

    Image shaded(const Camera& camera, const PixelOptions& options)
    {
        if (!lit)
            lit.emplace(model, gpu_tile, loops ? loops->mapped_normals() : MappedNormals());
        return lit->render(camera, options.shade);
    }
    /// Where normals come from maps, patterns are not drawn on the device.
    bool has_patterns() const { return !loops || loops->mapped_normals().empty(); }
    Image patterned(const SeenScene& scene, const Camera& camera, const PixelOptions& options)
    {
        if (!patterns)
            patterns.emplace(model, gpu_tile);
        return patterns->render(camera, compose_pattern(scene, options.pattern, options.place, options.shade, pattern_lights(scene, camera, options.shade, options.place)));
    }
    Image filtered(const Camera& camera, const PixelOptions& options)
    {
        if (!fields) {
            fields.emplace(model);
            finder.emplace();
        }
        return gpu::draw_image_lines(*fields, *finder, camera, options.image_lines);
    }
    Image shader_lines(const Camera& camera, const ShaderLineOptions& options)
    {
        if (!surface)
            surface.emplace(model);
        return gpu::draw_shader_lines(*surface, camera, options);
    }
};

PixelPainter::PixelPainter(const std::string& device, Say say) : say_(std::move(say)), may_fall_back_(device == "auto"), context_(gpu::wanted_context(device, say_)) {}

PixelPainter::~PixelPainter() = default;

std::string PixelPainter::device() const { return context_ ? context_->info().renderer : "processor"; }

Image PixelPainter::paint(const SeenModel& model, const Camera& camera, const PixelOptions& options)
{
    try {
        return paint_once(model, camera, options);
    } catch (const Error::Device& error) {
        if (!context_ || !may_fall_back_)
            throw;
        say_(std::string(error.what()) + "; the processor is used from here on");
        on_gpu_.reset();
        context_.reset();
        return paint_once(model, camera, options);
    }
}

bool PixelPainter::uses_gpu(bool can) const
{
    if (context_ && !can && !may_fall_back_)
        throw Error::Input("--device gpu: shadows, lights with a size and --ao are computed on the processor; leave the option out");
    return context_ && can;
}

Image PixelPainter::lit(const SeenModel& model, const Camera& camera, const PixelOptions& options)
{
    return uses_gpu(!asks_for_visibility(options.shade)) ? on_gpu_->shaded(camera, options) : lit_on_processor(model, camera, options);
}

Image PixelPainter::patterned(const SeenModel& model, const Camera& camera, const PixelOptions& options)
{
    if (context_ && !may_fall_back_ && !on_gpu_->has_patterns())
        throw Error::Input("--device gpu: patterns on control meshes with normals in maps are computed on the processor; leave the option out");
    if (uses_gpu(!asks_for_visibility_of_patterns(options.shade)) && on_gpu_->has_patterns())
        return on_gpu_->patterned(model.scene, camera, options);
    return paint_pattern(model.scene, camera, options.pattern, options.place, options.shade);
}

Image PixelPainter::paint_once(const SeenModel& model, const Camera& camera, const PixelOptions& options)
{
    if (context_ && (!on_gpu_ || &on_gpu_->model != &model.lines))
        on_gpu_ = std::make_unique<OnGpu>(model);
    Image picture = options.pattern.kind == PatternKind::plain ? lit(model, camera, options) : patterned(model, camera, options);
    const Camera fine = finer_camera(camera);
    if (options.image_lines.method != ImageMethod::off)
        lay_over(picture, context_ ? on_gpu_->filtered(fine, options) : filtered_on_processor(model, fine, options), options.ink);
    if (options.shader_lines.method != ShaderMethod::off) {
        const ShaderLineOptions lines = finer_lines(options.shader_lines);
        lay_over(picture, context_ ? on_gpu_->shader_lines(fine, lines) : shader_lines_on_processor(model, fine, lines), options.ink);
    }
    return picture;
}

} // namespace limn
