#include "scene_file.h"

#include <algorithm>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/scene/scene_json.h"

using namespace limn;

namespace {

bool is_scene(const std::string& file, const std::string& from) { return input_format(file, from) == "json"; }

/// The scene that the command line names, if it names one.
std::optional<Scene> scene_of(const PictureCommand& command)
{
    const std::vector<std::string>& files = command.files;
    const auto found = std::find_if(files.begin(), files.end(), [&](const std::string& file) { return is_scene(file, command.from); });
    if (found == files.end())
        return std::nullopt;
    if (files.size() > 1)
        throw Error::Input(fmt::format("{} is a scene and stands alone; name the other files in its \"objects\"", *found));
    return read_scene(*found);
}

std::vector<SceneObject> objects_of(const PictureCommand& command)
{
    std::vector<SceneObject> objects;
    for (const std::string& file : command.files) {
        objects.emplace_back().file = file;
        objects.back().format = command.from;
    }
    return objects;
}

/// Whether any of the options stands on the command line.
bool is_given(const CLI::App& app, std::initializer_list<const char*> options)
{
    return std::any_of(options.begin(), options.end(), [&](const char* option) { return app.count(option) > 0; });
}

/// A view's size and lens, and its place where the command line has none.
void take_view(const CLI::App& app, const SceneView& from, ViewOptions& view)
{
    const bool is_placed = is_given(app, {"--view", "--eye", "--camera", "--cameras"});
    if (from.camera && !is_placed) {
        for (const char* option : {"--fov", "--ortho", "--scale"})
            if (is_given(app, {option}))
                throw Error::Input(fmt::format("{}: the scene holds the whole camera; give --view or --eye too, to place another", option));
        view.camera = from.camera;
        return;
    }
    const std::optional<ivec2> size = from.camera ? from.camera->size : from.size;
    if (size && !is_given(app, {"--size", "--camera"}))
        view.size = fmt::format("{}x{}", size->x, size->y);
    if (!is_given(app, {"--fov"}))
        view.fov_degrees = from.fov_degrees;
    if (!is_placed && !from.view.empty())
        view.views = {from.view};
    view.orthographic = view.orthographic || from.orthographic;
}

} // namespace

std::optional<Scene> take_files(const CLI::App& app, PictureCommand& command)
{
    std::optional<Scene> scene = scene_of(command);
    if (!scene) {
        command.model.objects = objects_of(command);
        return scene;
    }
    command.model.objects = scene->objects;
    const std::vector<LineType> usual_lines = command.lines.lines; // or those of --lines
    take_options(app, line_option_table(), scene->lines, command.lines);
    if (command.lines.lines.empty())
        command.lines.lines = usual_lines;
    take_options(app, style_option_table(), scene->style, command.style);
    take_options(app, estimate_option_table(), scene->surface, command.model.prepare.estimate);
    take_options(app, subdivision_option_table(), scene->subdivision, command.model.subdivision);
    if (scene->view.up_axis != 0 && !is_given(app, {"--up-axis"}))
        command.view.up_axis = std::string(1, scene->view.up_axis);
    take_view(app, scene->view, command.view);
    return scene;
}
