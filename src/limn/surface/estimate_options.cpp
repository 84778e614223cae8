#include "limn/surface/estimate.h"

#include <fmt/format.h>

namespace limn {
namespace {

OptionRow<EstimateOptions> radius_row()
{
    auto set = [](EstimateOptions& options, std::string_view text) {
        const double rings = text == "auto" ? 0 : parse_number("curvature-radius", text);
        if (rings != 0 && rings != 2 && rings != 3 && rings != 4 && rings != 5 && rings != 6)
            throw Error::Input(fmt::format("--curvature-radius: '{}' is neither auto nor a whole number in 2..6", text));
        options.radius = int(rings);
    };
    auto get = [](const EstimateOptions& options) { return options.radius == 0 ? std::string("auto") : fmt::format("{}", options.radius); };
    return {"curvature-radius", "rings", "auto|2..6", "neighbours that a curvature fit looks at", set, get};
}

OptionTable<EstimateOptions> make_table()
{
    using O = EstimateOptions;
    return {
        choice_row<O, CurvatureMethod>("curvature", {{"jets", CurvatureMethod::jets}, {"tensor", CurvatureMethod::tensor}},
                                       "fit of the surface at each vertex, or average of per-face tensors", &O::method),
        radius_row(),
        number_row("smooth", "passes", 0, 1000, "smoothing of noisy scans: normals, curvature and its derivative", &O::smooth),
    };
}

} // namespace

const OptionTable<EstimateOptions>& estimate_option_table()
{
    static const OptionTable<EstimateOptions> table = make_table();
    return table;
}

} // namespace limn
