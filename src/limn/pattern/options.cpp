#include "limn/pattern/options.h"

#include <array>

#include "limn/drawing/style.h"
#include "limn/pattern/filament.h"

namespace limn {
namespace {

using O = PatternOptions;

/// Numbers between commas. @throws Error::Input naming the option and what it wants.
template <std::size_t N> std::array<double, N> parse_numbers(std::string_view name, std::string_view text, std::string_view wish)
{
    std::array<double, N> numbers = {};
    std::string_view rest = text;
    for (std::size_t k = 0; k < N; ++k) {
        const std::size_t comma = rest.find(',');
        if ((comma == std::string_view::npos) != (k + 1 == N))
            throw Error::Input(fmt::format("--{}: '{}' is not {}", name, text, wish));
        numbers[k] = parse_number(name, rest.substr(0, comma));
        rest.remove_prefix(std::min(rest.size(), comma + 1));
    }
    return numbers;
}

/// A length in millimetres; "0.2", "0.2mm", "200um" and "0.01in".
double parse_length(std::string_view name, std::string_view text)
{
    const std::pair<std::string_view, double> units[] = {{"mm", 1}, {"um", 1e-3}, {"µm", 1e-3}, {"in", 25.4}};
    for (const auto& [unit, mm] : units)
        if (text.ends_with(unit))
            return mm * parse_number(name, text.substr(0, text.size() - unit.size()));
    return parse_number(name, text);
}

OptionRow<O> length_row(std::string name, double low, double high, std::string help, double O::*member)
{
    auto set = [=](O& options, std::string_view text) {
        const double value = parse_length(name, text);
        if (value < low || value > high)
            throw Error::Input(fmt::format("--{}: {} is outside {}..{} mm", name, text, low, high));
        options.*member = value;
    };
    auto get = [=](const O& options) { return fmt::format("{}", options.*member); };
    return {name, "mm", fmt::format("{}..{}", low, high), std::move(help), set, get, OptionKind::text};
}

OptionRow<O> direction_row()
{
    const std::string name = "print-direction";
    auto set = [=](O& options, std::string_view text) {
        if (text == "up") {
            options.direction.reset();
            return;
        }
        dvec3 direction(0);
        const bool negative = text.starts_with('-') && text.size() == 2;
        const std::string_view axis = negative ? text.substr(1) : text;
        if (axis == "x" || axis == "y" || axis == "z") {
            direction[axis[0] - 'x'] = negative ? -1 : 1;
        } else {
            const std::array<double, 3> v = parse_numbers<3>(name, text, "up, x, y, z, -x, -y, -z or x,y,z");
            direction = {v[0], v[1], v[2]};
        }
        if (!(glm::length(direction) > 0))
            throw Error::Input(fmt::format("--{}: {} is no direction", name, text));
        options.direction = direction;
    };
    auto get = [](const O& options) {
        return options.direction ? fmt::format("{},{},{}", options.direction->x, options.direction->y, options.direction->z)
                                 : std::string("up");
    };
    return {name, "", "x,y,z|up", "layers follow each other along it; also x, y, z, -x, -y, -z", set, get, OptionKind::vector};
}

OptionRow<O> filament_row()
{
    std::string names;
    for (const Filament& filament : filaments())
        names += (names.empty() ? "" : "|") + std::string(filament.name);
    auto set = [](O& options, std::string_view text) { options.filament = find_filament(text).name; };
    auto get = [](const O& options) { return options.filament; };
    return {"filament", "", names, "what the print is made of", set, get, OptionKind::choice};
}

OptionRow<O> own_colour_row()
{
    auto set = [](O& options, std::string_view text) {
        options.colour = text == "filament" ? std::nullopt : std::optional(colour_from_text("print-colour", text));
    };
    auto get = [](const O& options) { return options.colour ? colour_text(*options.colour) : std::string("filament"); };
    return {"print-colour", "", "#rrggbb|filament", "instead of the filament's", set, get, OptionKind::text};
}

OptionRow<O> colour_row(std::string name, std::string help, vec3 O::*member)
{
    auto set = [=](O& options, std::string_view text) { options.*member = colour_from_text(name, text); };
    auto get = [=](const O& options) { return colour_text(options.*member); };
    return {name, "", "#rrggbb", std::move(help), set, get, OptionKind::colour};
}

OptionRow<O> turn_row()
{
    const std::string name = "pattern-turn";
    auto set = [=](O& options, std::string_view text) {
        const std::array<double, 4> q = parse_numbers<4>(name, text, "a quaternion x,y,z,w");
        options.turn = {q[0], q[1], q[2], q[3]};
        if (!(glm::length(options.turn) > 0))
            throw Error::Input(fmt::format("--{}: {} is no rotation", name, text));
    };
    auto get = [](const O& options) { return fmt::format("{},{},{},{}", options.turn.x, options.turn.y, options.turn.z, options.turn.w); };
    return {name, "", "x,y,z,w", "quaternion that turns the pattern", set, get, OptionKind::text};
}

} // namespace

const OptionTable<PatternOptions>& pattern_option_table()
{
    static const OptionTable<PatternOptions> table = {
        choice_row<O, PatternKind>("material",
                                   {{"plain", PatternKind::plain},
                                    {"layers", PatternKind::layers},
                                    {"bricks", PatternKind::bricks},
                                    {"thread", PatternKind::thread}},
                                   "what surfaces are made of: layers of a 3D print, bricks, threads around the middle", &O::kind),
        length_row("layer-height", 0.001, 1000, "of a print; also 200um, 0.01in", &O::layer_height),
        length_row("first-layer", 0, 1000, "height of the lowest layer; 0: as the others", &O::first_layer),
        direction_row(),
        choice_row<O, LayerModel>("layer-model",
                                  {{"bead", LayerModel::bead},
                                   {"slope", LayerModel::slope},
                                   {"seed", LayerModel::seed},
                                   {"soft", LayerModel::soft},
                                   {"voxel", LayerModel::voxel}},
                                  "rounded steps, flat ones, or those of the study behind them: hard, soft, or along two axes",
                                  &O::layer_model),
        number_row("bead-bulge", "", 0.02, 2, "how far beads stand out, by half their height", &O::bulge),
        length_row("soft-low", -1000, 1000, "where soft steps begin", &O::soft_low),
        length_row("soft-high", -1000, 1000, "where they end", &O::soft_high),
        number_row("variety", "", 0, 1, "how much layers and bricks differ in colour", &O::variety),
        choice_row<O, PrintShow>("show", {{"print", PrintShow::print}, {"cusp", PrintShow::cusp}},
                                 "the print, or how far its steps stand out of the model", &O::show),
        number_row("overhang", "degrees", 0, 89, "marks what hangs over by more than this from upright; 0: nothing", &O::overhang),
        choice_row<O, char>("units", {{"auto", 'a'}, {"mm", 'm'}, {"cm", 'c'}, {"m", 'M'}, {"in", 'i'}},
                            "of the models' lengths; auto: mm for stl and 3mf, m for gltf and glb, others become 100 mm long", &O::units),
        filament_row(),
        own_colour_row(),
        choice_row<O, PatternReflection>("reflection",
                                         {{"filament", PatternReflection::filament},
                                          {"phong", PatternReflection::phong},
                                          {"blinn-phong", PatternReflection::blinn_phong},
                                          {"matte", PatternReflection::matte}},
                                         "as the filament does (GGX), or modified Phong, modified Blinn-Phong, none", &O::reflection),
        number_row("specular", "", 0, 1, "strength of both Phong models", &O::specular),
        number_row("exponent", "", 1, 10000, "of both Phong models", &O::exponent),
        number_row("brick-width", "of the longest side", 1e-5, 10, "of a brick", &O::brick_width),
        number_row("brick-height", "of the longest side", 1e-5, 10, "of a brick", &O::brick_height),
        number_row("brick-depth", "of the longest side", 1e-5, 10, "of a brick", &O::brick_depth),
        number_row("mortar", "of the longest side", 1e-6, 10, "between bricks", &O::mortar),
        number_row("brick-relief", "of the longest side", 0, 1, "how far bricks stand out of the mortar", &O::brick_relief),
        colour_row("brick-colour", "of bricks", &O::brick_colour),
        colour_row("mortar-colour", "of mortar", &O::mortar_colour),
        switch_row("brick-solid", "bricks go through the object; no: a wall in x and y", &O::brick_solid),
        switch_row("brick-bond", "every other row of solid bricks is shifted on all sides; no: along x alone", &O::brick_bond),
        number_row("thread-hole", "of the way around", 1e-5, 0.5, "between threads", &O::hole),
        number_row("thread-width", "of the way around", 1e-5, 0.5, "of a thread", &O::thread),
        colour_row("thread-colour", "of threads", &O::thread_colour),
        number_row("thread-specular", "", 0, 10, "strength of their highlights", &O::thread_specular),
        number_row("thread-exponent", "", 1, 1000, "of their highlights", &O::thread_exponent),
        switch_row("woven", "threads pass over each other in turn; no: level ones are always above", &O::woven),
        switch_row("mirror-cone", "highlights of threads are on the mirror cone of the light; no: on its own side, as the study prints it",
                   &O::mirror_cone),
        choice_row<O, PatternFilter>(
            "pattern-filter",
            {{"gauss", PatternFilter::gauss},
             {"box", PatternFilter::box},
             {"even", PatternFilter::even},
             {"seed", PatternFilter::seed},
             {"none", PatternFilter::off}},
            "what is finer than a pixel: in closed form (gauss, box), by samples (even; seed: those of the study), or not at all",
            &O::filter),
        number_row("filter-width", "px", 0.05, 8, "standard deviation of gauss and even", &O::filter_width),
        choice_row<O, int>("filter-box", {{"1", 1}, {"2", 2}}, "side of box and seed, px", &O::filter_box),
        number_row("pattern-samples", "", 1, 4096, "of even and seed, for a pixel", &O::pattern_samples),
        number_row("sample-seed", "", 0, 65535, "of the seed's generator", &O::sample_seed),
        choice_row<O, bool>("pattern-with", {{"world", false}, {"object", true}}, "what the pattern stays with when objects move",
                            &O::with_object),
        turn_row(),
    };
    return table;
}

} // namespace limn
