#include "limn/scene/render_options.h"

#include <limits>

#include "limn/drawing/style.h"
#include "limn/raycast/occlusion.h"

namespace limn {
namespace {

using O = RenderOptions;

/// "1,2,3". @throws Error::Input naming the option and the text.
dvec3 parse_vector(std::string_view name, std::string_view text)
{
    dvec3 vector(0);
    std::string_view rest = text;
    for (int k = 0; k < 3; ++k) {
        const std::size_t comma = rest.find(',');
        if ((comma == std::string_view::npos) != (k == 2))
            throw Error::Input(fmt::format("--{}: '{}' is not x,y,z", name, text));
        vector[k] = parse_number(name, rest.substr(0, comma));
        rest.remove_prefix(std::min(rest.size(), comma + 1));
    }
    return vector;
}

std::string vector_text(const std::optional<dvec3>& v, std::string_view otherwise)
{
    return v ? fmt::format("{},{},{}", v->x, v->y, v->z) : std::string(otherwise);
}

OptionRow<O> vector_row(std::string name, std::string otherwise, std::string help, std::optional<dvec3> O::*member)
{
    auto set = [=](O& options, std::string_view text) {
        options.*member = text == otherwise ? std::nullopt : std::optional(parse_vector(name, text));
    };
    auto get = [=](const O& options) { return vector_text(options.*member, otherwise); };
    return {name, "", "x,y,z|" + otherwise, std::move(help), set, get, OptionKind::vector};
}

/// A distant light or one with a size.
OptionRow<O> light_row()
{
    OptionRow<O> row = vector_row("light", "headlight", "direction towards a distant light, or one with a size: a ball, a rectangle (and where it faces), a picture", &O::light);
    row.range += "|sphere:x,y,z,r|rect:x,y,z,w,h[,x,y,z]|env:FILE.hdr";
    row.set = [set = row.set](O& options, std::string_view text) {
        options.wide = wide_light_from_text("light", text);
        set(options, options.wide ? "headlight" : text);
    };
    row.get = [get = row.get](const O& options) { return options.wide ? wide_light_text(*options.wide) : get(options); };
    row.kind = OptionKind::text;
    return row;
}

OptionRow<O> openness_row()
{
    OptionRow<O> row = number_row("ao", "radii", 0.001, 1000, "darken places by what is near (ambient occlusion): within so many radii of all models", &O::openness);
    row.range = "yes|no|" + row.range;
    row.set = [set = row.set](O& options, std::string_view text) {
        if (text == "yes" || text == "no")
            options.openness = text == "yes" ? usual_openness : 0;
        else
            set(options, text);
    };
    row.get = [](const O& options) { return options.openness == 0 ? "no" : options.openness == usual_openness ? "yes" : fmt::format("{}", options.openness); };
    row.kind = OptionKind::yes_no_number;
    return row;
}

template <class Options> OptionRow<Options> colour_row(std::string name, std::string help, vec3 Options::*member)
{
    auto set = [=](Options& options, std::string_view text) { options.*member = colour_from_text(name, text); };
    auto get = [=](const Options& options) { return colour_text(options.*member); };
    return {name, "", "#rrggbb", std::move(help), set, get, OptionKind::colour};
}

} // namespace

const OptionTable<Material>& material_option_table()
{
    static const OptionTable<Material> table = {
        colour_row("colour", "of lit places", &Material::colour),
        number_row("unlit", "", 0, 1, "tone of unlit places, as a part of the colour", &Material::unlit),
    };
    return table;
}

Material default_material(const RenderOptions& options) { return {options.colour, options.shade}; }

ShadeOptions shade_options(const RenderOptions& options, const SeenScene& scene, const dvec3& up)
{
    ShadeOptions result;
    result.shading = options.shading;
    result.to_light = options.light;
    result.lamp = options.lamp;
    if (options.wide)
        result.wide = loaded(*options.wide);
    if (options.shadow == ShadowMethod::rays || (options.shadow == ShadowMethod::automatic && options.wide))
        result.occlusion = ray_occlusion(scene);
    if (options.openness > 0)
        result.open_radius = options.openness * scene.scale;
    result.light_samples = options.shadow_samples;
    result.up = up;
    result.toon_levels = options.toon_levels;
    result.toon_limit = options.toon_limit;
    result.dark = default_material(options).dark();
    result.light = options.colour;
    result.background = options.background;
    result.samples = options.samples;
    if (options.ground) {
        result.ground = ground_under(scene, up);
        result.ground->material = {options.ground_colour, options.shade};
    }
    return result;
}

const OptionTable<RenderOptions>& render_option_table()
{
    static const OptionTable<RenderOptions> table = {
        choice_row<O, Shading>("shading",
                               {{"smooth", Shading::smooth}, {"flat", Shading::flat}, {"toon", Shading::toon}, {"gouraud", Shading::gouraud}, {"normals", Shading::normals}},
                               "how light falls on the surface; gouraud: on its vertices; normals: normals as colours", &O::shading),
        light_row(),
        vector_row("lamp", "none", "place of a point light", &O::lamp),
        choice_row<O, ShadowMethod>("shadow", {{"auto", ShadowMethod::automatic}, {"csm", ShadowMethod::maps}, {"ray", ShadowMethod::rays}, {"none", ShadowMethod::nothing}},
                                    "what tells where light is hidden; auto: maps where given, else rays for lights with a size", &O::shadow),
        number_row("shadow-samples", "", 1, 4096, "places of a light with a size, and directions of --ao, that a pixel looks at", &O::shadow_samples),
        openness_row(),
        colour_row("surface-colour", "of lit places", &O::colour),
        number_row("unlit", "", 0, 1, "tone of unlit places, as a part of the colour", &O::shade),
        colour_row("background", "where nothing is seen", &O::background),
        switch_row("ground", "a level plane under everything, seen from above, that fades into the background", &O::ground),
        colour_row("ground-colour", "of the ground where it is lit", &O::ground_colour),
        number_row("toon-levels", "", 2, 16, "tones of toon shading", &O::toon_levels),
        number_row("toon-limit", "", 0.001, 0.999, "light below which toon shading is dark", &O::toon_limit),
        number_row("samples", "", 1, 256, "rays through a pixel on an edge", &O::samples),
        choice_row<O, int>("bits", {{"8", 8}, {"16", 16}}, "depth of a PNG's samples", &O::bits),
    };
    return table;
}

} // namespace limn
