#include "bench_truth.h"

#include <fmt/format.h>

#include "flip.h"
#include "pattern_panels.h"

using namespace limn;

namespace {

constexpr double periods[] = {6, 1.5}; ///< pixels a layer on upright walls
constexpr LayerModel models[] = {LayerModel::seed, LayerModel::slope, LayerModel::bead};

} // namespace

TruthTables compare_with_truth(int width, Console& console)
{
    TruthTables tables;
    std::vector<std::vector<Image>> rows;
    const std::vector<NamedMesh> shapes = print_shapes();
    double done = 0;
    for (const NamedMesh& shape : shapes) {
        const TruthStage stage(shape.mesh, {width, width * 3 / 4});
        for (const double period : periods) {
            console.progress(fmt::format("rays meet the steps of a {}", shape.name), done++ / double(std::size(periods) * shapes.size()));
            const double height = stage.layer_height(period);
            const auto truth = [&](double bulge) { return stage.traced(body_of(stepped_print(shape.mesh, {height, bulge}))); };
            const TracedPrint flat = truth(0), rounded = truth(single_wall_bulge);
            std::vector<Image> painted;
            for (const LayerModel model : models)
                painted.push_back(stage.painted(model, height));
            for (const bool beads : {false, true}) {
                const TracedPrint& wanted = beads ? rounded : flat;
                std::vector<std::string> row = {shape.name, fmt::format("{}", period), beads ? "beads" : "flat steps"};
                for (const Image& image : painted)
                    row.push_back(fmt::format("{:.3f}", flip(image, wanted.picture)));
                row.push_back(stage.aspect_text(wanted.picture, wanted.filled));
                for (const Image& image : painted)
                    row.push_back(stage.aspect_text(image, wanted.filled));
                tables.errors.add(row);
            }
            if (period == periods[0])
                rows.push_back({flat.picture, painted[0], painted[1], rounded.picture, painted[2]});
        }
    }
    tables.strip = in_rows(rows, 2);
    return tables;
}
