#include "limn/pattern/print_options.h"

namespace limn {
namespace {

using O = PrintOptions;

/// One end of a range of layers. @throws Error::Input
int layer_number(std::string_view text, std::string_view all)
{
    int number = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure != std::errc() || end != text.data() + text.size() || number < 1)
        throw Error::Input(fmt::format("--layers: '{}' is not A..B, two layers counted from 1, of which one may be left out", all));
    return number;
}

OptionRow<O> layers_row()
{
    constexpr int last_of_all = std::numeric_limits<int>::max();
    auto set = [](O& options, std::string_view text) {
        options.first_layer = 1;
        options.last_layer = last_of_all;
        if (text == "all")
            return;
        const std::size_t dots = text.find("..");
        const std::string_view first = text.substr(0, dots), last = dots == std::string_view::npos ? text : text.substr(dots + 2);
        if (!first.empty() || last.empty())
            options.first_layer = layer_number(first, text);
        if (!last.empty())
            options.last_layer = layer_number(last, text);
        if (options.last_layer < options.first_layer)
            throw Error::Input(fmt::format("--layers: {} ends before it begins", text));
    };
    auto get = [](const O& options) {
        if (options.first_layer == 1 && options.last_layer == last_of_all)
            return std::string("all");
        return options.last_layer == last_of_all ? fmt::format("{}..", options.first_layer)
                                                 : fmt::format("{}..{}", options.first_layer, options.last_layer);
    };
    return {"layers", "", "A..B|all", "of G-code that are shown, counted from 1; also A.., ..B and A", set, get, OptionKind::text};
}

} // namespace

const OptionTable<PrintOptions>& print_option_table()
{
    static const OptionTable<O> table = {
        choice_row<O, PrintColour>("color",
                                   {{"filament", PrintColour::filament},
                                    {"feature", PrintColour::feature},
                                    {"height", PrintColour::height},
                                    {"speed", PrintColour::speed},
                                    {"tool", PrintColour::tool}},
                                   "what colours of G-code's beads tell; a legend explains them", &O::colour),
        layers_row(),
        switch_row("travel", "show the nozzle's ways without beads, too", &O::travel),
        number_row("bead-detail", "px", 0, 10000, "beads nearer to each other than this are drawn as layers, filtered, not one by one",
                   &O::detail),
    };
    return table;
}

const OptionTable<GcodeOptions>& gcode_option_table()
{
    static const OptionTable<GcodeOptions> table = {
        number_row("filament-diameter", "mm", 0, 20, "of G-code without widths; 0: as the file tells, else 1.75",
                   &GcodeOptions::filament_diameter),
    };
    return table;
}

} // namespace limn
