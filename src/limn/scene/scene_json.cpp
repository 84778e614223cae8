#include "limn/scene/scene_json.h"

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/scene/light_json.h"
#include "limn/scene/options_json.h"
#include "limn/scene/transform_json.h"
#include "limn/scene/view_json.h"

namespace limn {
namespace {

/// The options of `render` that a scene file says elsewhere.
OptionTable<RenderOptions> render_rows()
{
    OptionTable<RenderOptions> rows = render_option_table();
    std::erase_if(rows, [](const OptionRow<RenderOptions>& row) { return row.name == "light" || row.name == "lamp"; });
    return rows;
}

Material read_material(const JsonPlace& place)
{
    Material material;
    read_options(place, material_option_table(), material);
    return material;
}

Json material_json(const Material& material) { return options_json(material_option_table(), material, Material()); }

std::variant<std::string, Material> read_own_material(const JsonPlace& place, const std::map<std::string, Material>& materials)
{
    if (place.value().is_object())
        return read_material(place);
    if (!place.value().is_string())
        place.expected("the name of a material, or an object with its options");
    const std::string name = place.text();
    if (!materials.contains(name)) {
        std::vector<std::string> names;
        for (const auto& [known, material] : materials)
            names.push_back(known);
        place.refuse(fmt::format("no material is called {}{}", quoted(name), did_you_mean(name, names)));
    }
    return name;
}

SceneObject read_object(const JsonPlace& place, const Scene& scene, const std::filesystem::path& folder)
{
    std::vector<std::string> keys = {"name", "file", "from", "material", "shadow-maps"};
    keys.insert(keys.end(), transform_keys.begin(), transform_keys.end());
    place.check_keys(keys);
    place.need({"file"});
    SceneObject object;
    object.file = read_path(place.at("file"), folder);
    if (place.has("name"))
        object.name = place.at("name").text();
    if (place.has("from"))
        object.format = place.at("from").text();
    if (place.has("shadow-maps"))
        object.shadow_maps = read_path(place.at("shadow-maps"), folder);
    object.transform = read_transform(place);
    if (place.has("material"))
        object.material = read_own_material(place.at("material"), scene.materials);
    return object;
}

Json object_json(const SceneObject& object, const std::filesystem::path& folder, std::size_t index)
{
    if (object.mesh)
        throw Error::Input(fmt::format("objects[{}] is a mesh in memory; a scene file names models by their files", index));
    Json json = Json::object();
    if (!object.name.empty())
        json["name"] = object.name;
    json["file"] = path_from(object.file, folder);
    if (!object.format.empty())
        json["from"] = object.format;
    if (!object.shadow_maps.empty())
        json["shadow-maps"] = path_from(object.shadow_maps, folder);
    if (object.transform != dmat4(1))
        json["matrix"] = matrix_json(object.transform);
    if (const auto* own = std::get_if<Material>(&object.material))
        json["material"] = material_json(*own);
    else if (const std::string& name = std::get<std::string>(object.material); !name.empty())
        json["material"] = name;
    return json;
}

void check_version(const JsonPlace& scene)
{
    if (!scene.has("limn"))
        scene.refuse(fmt::format("the key 'limn' is missing; it holds the version of the scene file, {}", scene_version));
    if (scene.at("limn").value() != scene_version)
        scene.at("limn").expected(fmt::format("{}, the version of scene files that this Limn reads", scene_version));
}

void read_materials(const JsonPlace& place, Scene& scene)
{
    if (!place.value().is_object())
        place.expected("an object");
    for (const auto& [name, value] : place.value().items()) {
        if (name.empty())
            place.refuse("a material's name is empty");
        scene.materials[name] = read_material(place.at(name));
    }
}

/// Calls read(place) where the scene has the key.
template <class Read> void where_given(const JsonPlace& scene, const char* key, Read&& read)
{
    if (scene.has(key))
        read(scene.at(key));
}

template <class Options> void write_section(Json& json, const char* key, const OptionTable<Options>& table, const Options& options, const Options& usual)
{
    if (Json section = options_json(table, options, usual); !section.empty())
        json[key] = std::move(section);
}

} // namespace

Scene scene_from_json(std::string_view text, const std::filesystem::path& file)
{
    const Json json = parse_json(text, file.string());
    const JsonPlace place(json, file.string());
    if (!json.is_object())
        place.expected("an object");
    check_version(place);
    place.check_keys({"limn", "objects", "materials", "lights", "camera", "surface", "subdivision", "lines", "style", "render", "image-lines", "shader-lines", "pattern"});
    place.need({"objects"});

    Scene scene;
    where_given(place, "materials", [&](const JsonPlace& at) { read_materials(at, scene); });
    for (const JsonPlace& object : place.at("objects").entries())
        scene.objects.push_back(read_object(object, scene, file.parent_path()));
    if (scene.objects.empty())
        place.at("objects").expected("at least one object");
    where_given(place, "lights", [&](const JsonPlace& at) { scene.lights = read_lights(at, file.parent_path()); });
    where_given(place, "camera", [&](const JsonPlace& at) { scene.view = read_view(at); });
    where_given(place, "surface", [&](const JsonPlace& at) { read_options(at, estimate_option_table(), scene.surface); });
    where_given(place, "subdivision", [&](const JsonPlace& at) { read_options(at, subdivision_option_table(), scene.subdivision); });
    where_given(place, "lines", [&](const JsonPlace& at) { read_options(at, line_option_table(), scene.lines); });
    where_given(place, "style", [&](const JsonPlace& at) { read_options(at, style_option_table(), scene.style); });
    where_given(place, "render", [&](const JsonPlace& at) { read_options(at, render_rows(), scene.render); });
    where_given(place, "pattern", [&](const JsonPlace& at) { read_options(at, pattern_option_table(), scene.pattern); });
    where_given(place, "image-lines", [&](const JsonPlace& at) { read_options(at, image_line_option_table(), scene.image_lines); });
    where_given(place, "shader-lines", [&](const JsonPlace& at) { read_options(at, shader_line_option_table(), scene.shader_lines); });
    return scene;
}

Scene read_scene(const std::filesystem::path& file) { return scene_from_json(read_file(file), file == "-" ? "standard input" : file); }

std::string scene_to_json(const Scene& scene, const std::filesystem::path& folder)
{
    const Scene usual;
    Json json = {{"limn", scene_version}};
    for (const auto& [name, material] : scene.materials)
        json["materials"][name] = material_json(material);
    json["objects"] = Json::array();
    for (const SceneObject& object : scene.objects)
        json["objects"].push_back(object_json(object, folder, json["objects"].size()));
    for (const Light& light : all_lights(scene))
        json["lights"].push_back(light_json(light, folder));
    if (Json view = view_json(scene.view); !view.empty())
        json["camera"] = std::move(view);
    write_section(json, "surface", estimate_option_table(), scene.surface, usual.surface);
    write_section(json, "subdivision", subdivision_option_table(), scene.subdivision, usual.subdivision);
    write_section(json, "lines", line_option_table(), scene.lines, usual.lines);
    write_section(json, "style", style_option_table(), scene.style, usual.style);
    write_section(json, "render", render_rows(), scene.render, usual.render);
    write_section(json, "pattern", pattern_option_table(), scene.pattern, usual.pattern);
    write_section(json, "image-lines", image_line_option_table(), scene.image_lines, usual.image_lines);
    write_section(json, "shader-lines", shader_line_option_table(), scene.shader_lines, usual.shader_lines);
    return json.dump(2) + "\n";
}

} // namespace limn
