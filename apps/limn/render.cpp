#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/parallel.h"
#include "limn/drawing/exr.h"
#include "limn/drawing/png.h"
#include "limn/drawing/raster.h"
#include "limn/gpu/context.h"
#include "limn/gpu/image_lines.h"
#include "limn/gpu/surface_view.h"
#include "limn/lines/feature_size.h"
#include "limn/lines/image_lines.h"
#include "limn/lines/shader_lines.h"
#include "limn/scene/passes.h"
#include "limn/scene/render_options.h"
#include "pictures.h"
#include "subcommand.h"
#include "table_options.h"

using namespace limn;

namespace {

constexpr const char* examples = R"(Examples:
  limn render bunny.ply -o bunny.png
  limn render bunny.ply -o bunny.png --lines contour,suggestive --shading toon --light 1,2,3
  limn render part.stl -o part.png --background '#ffffff' --view 30,20 --size 1280x720 --bits 16
  limn render vase.glb -o turn.png --turntable 24
  limn render bunny.ply -o data.exr --pass ndotv,kr,dwkr,depth,normal,id --cameras cameras.json)";

struct RenderCommand {
    PictureCommand pictures;
    RenderOptions render;
    ImageLineOptions image_lines;
    bool shader_lines = false;
    std::string passes;
};

/// "data-kr.exr" beside "data.exr".
std::string beside(const std::string& path, std::string_view word, std::string_view ending)
{
    const std::filesystem::path file(path);
    return (file.parent_path() / fmt::format("{}-{}.{}", file.stem().string(), word, ending)).string();
}

void write_image(const Image& image, const Output& output, int bits)
{
    if (output.format == "exr")
        write_file(output.path, encode_exr(image));
    else
        write_file(output.path, encode_png(image, {.bits = bits}));
}

/// Writes each pass to a file of its own, and what their numbers mean to one more.
std::vector<std::string> write_passes(const std::vector<Pass>& passes, const Camera& camera, const SeenModel& model, const Output& output)
{
    if (passes.empty())
        return {};
    std::vector<std::string> written;
    nlohmann::ordered_json scales = {{"camera", nlohmann::ordered_json::parse(camera_to_json(camera))}, {"passes", nlohmann::ordered_json::object()}};
    const GBuffer seen = trace_gbuffer(model.scene, camera);
    for (const Pass pass : passes) {
        const PassImage image = make_pass(model.lines, seen, camera, pass);
        const bool whole = output.format == "png";
        written.push_back(beside(output.path, pass_name(pass), output.format));
        write_image(whole ? pass_for_whole_numbers(image) : image.values, {written.back(), output.format}, 16);
        nlohmann::ordered_json& scale = scales["passes"][std::string(pass_name(pass))];
        scale = {{"file", std::filesystem::path(written.back()).filename().string()}, {"unit", pass_unit(pass)}, {"low", image.low}, {"high", image.high}};
        if (whole && pass != Pass::id)
            scale["value"] = "low + (sample - 1) / 65534 * (high - low); sample 0 is background";
    }
    written.push_back(beside(output.path, "passes", "json"));
    write_file(written.back(), scales.dump(2) + "\n");
    return written;
}

/// Lines decided per pixel, by either kind of method, on the device where one was asked for.
class PixelLines {
public:
    /// @throws Error::Device where the command asks for a GPU and there is none.
    explicit PixelLines(const RenderCommand& command) : command_(command)
    {
        if (command.pictures.common.device == "gpu")
            context_.emplace();
    }

    /// Lays them over the picture. They are found at twice the size and averaged, so that they are not jagged.
    void draw_on(Image& picture, const SeenModel& model, const Camera& camera, const vec3& colour) const
    {
        constexpr int finer = 2;
        Camera fine = camera;
        fine.size = finer * camera.size;
        if (command_.image_lines.method != ImageMethod::off)
            lay_over(picture, by_filter(model, fine), finer, colour);
        if (command_.shader_lines)
            lay_over(picture, by_shader(model, fine, finer), finer, colour);
    }

private:
    Image by_filter(const SeenModel& model, const Camera& camera) const
    {
        const LineFields fields = line_fields(trace_gbuffer(model.scene, camera), camera, model.scene, model.scene.scale);
        return context_ ? gpu::ImageLineFinder().find(fields, command_.image_lines) : find_image_lines(fields, command_.image_lines);
    }

    Image by_shader(const SeenModel& model, const Camera& camera, int finer) const
    {
        ShaderLineOptions options;
        options.contour_width *= float(finer);
        options.suggestive_width *= float(finer);
        options.suggestive_limit = float(command_.pictures.lines.suggestive_limit);
        options.feature_size = model_feature_size(model.lines, command_.pictures.lines.feature_size);
        return context_ ? gpu::SurfaceRenderer(model.lines).render(camera, options).ink()
                        : find_shader_lines(model.lines, trace_gbuffer(model.scene, camera), camera, options);
    }

    static void lay_over(Image& picture, const Image& lines, int finer, const vec3& colour)
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

    const RenderCommand& command_;
    std::optional<gpu::Context> context_;
};

void check_passes(const RenderCommand& command, const std::vector<Pass>& passes)
{
    if (passes.empty())
        return;
    if (command.pictures.view.views.size() > 1)
        throw Error::Input("--pass makes images of one view; give --view once, or --cameras");
    for (const std::string& output : command.pictures.common.outputs)
        if (output == "-")
            throw Error::Input("--pass writes several files; -o - cannot hold them");
}

void run(RenderCommand& command)
{
    PictureCommand& pictures = command.pictures;
    if (!pictures.style.page.empty())
        throw Error::Input("--page: 'limn render' makes pictures, not pages; 'limn draw --shade smooth' writes pages");
    const std::vector<Pass> passes = passes_from_text(command.passes);
    check_passes(command, passes);
    pictures.need = pass_need(passes);
    if (command.shader_lines)
        pictures.need = Need::derivative;
    if (pictures.common.device == "gpu" && command.image_lines.method == ImageMethod::off && !command.shader_lines)
        throw Error::Device("--device gpu: only --image-lines and --shader-lines are computed on the GPU so far; shading and --lines use the processor");
    PictureHooks hooks;
    const PixelLines pixel_lines(command);
    hooks.underlay = [&](Drawing& drawing, const SeenModel& model) {
        drawing.background = shade(model.scene, drawing.camera, shade_options(command.render, model.scene, model.up));
        pixel_lines.draw_on(drawing.background, model, drawing.camera, pictures.style.line(LineType::contour).colour);
    };
    hooks.write = [&](const Drawing& drawing, const SeenModel& model, const Output& output) {
        const Image picture = drawing.strokes.empty() && drawing.captions.empty() ? drawing.background : lay_over(drawing.background, drawing, pictures.style);
        write_image(picture, output, command.render.bits);
        std::vector<std::string> written = {output.path};
        for (std::string& name : write_passes(passes, drawing.camera, model, output))
            written.push_back(std::move(name));
        return written;
    };
    make_pictures(pictures, hooks);
}

} // namespace

Subcommand add_render(CLI::App& limn)
{
    auto command = std::make_shared<RenderCommand>();
    command->pictures.name = "render";
    command->pictures.uses_gpu = true;
    command->pictures.formats = {"png", "exr"};
    command->pictures.lines.lines.clear();
    CLI::App* app = limn.add_subcommand("render", "Render shaded pictures of models, with or without lines, and their ingredient images");
    app->footer(examples);
    add_table_options(*app, render_option_table(), command->render, "Shading");
    add_table_options(*app, image_line_option_table(), command->image_lines, "Lines per pixel");
    app->add_flag("--shader-lines", command->shader_lines, "contours and suggestive contours decided pixel by pixel from the surface, 2 px wide")
        ->group("Lines per pixel");
    app->add_option("--pass", command->passes, "also write ndotv,kr,dwkr,k1,k2,depth,normal,position,id (or all) to FILE-PASS, and their scales to FILE-passes.json")
        ->type_name("PASS,...")
        ->group("Shading");
    add_picture_options(*app, command->pictures, "file to write; may be given several times: png, exr; '-' is standard output");
    return {app, [command] { with_threads(command->pictures.common.threads, [&] { run(*command); }); }};
}
