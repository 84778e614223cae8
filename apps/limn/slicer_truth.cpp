#include "slicer_truth.h"

#include <filesystem>

#include <fmt/format.h>

#include "bench_peers.h"
#include "flip.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/geometry/write_mesh.h"
#include "limn/pattern/read_gcode.h"
#include "limn/scene/print_picture.h"
#include "pattern_panels.h"
#include "process_output.h"
#include "scratch_folder.h"
#include "truth_stage.h"

using namespace limn;

namespace {

constexpr double part_radius = 10; ///< mm
constexpr double bed_middle = 100; ///< mm
constexpr LayerModel models[] = {LayerModel::seed, LayerModel::slope, LayerModel::bead};

/// Everything that decides where beads lie: whatever profiles a user has, the same G-code.
std::string settings()
{
    return fmt::format("nozzle_diameter = 0.4\nfilament_diameter = 1.75\nlayer_height = {0}\nfirst_layer_height = {0}\nperimeters = "
                       "2\ntop_solid_layers = 4\nbottom_solid_layers = 3\n"
                       "fill_density = 15%\nfill_pattern = rectilinear\nseam_position = rear\nskirts = 0\nbrim_width = "
                       "0\nelefant_foot_compensation = 0\nsupport_material = 0\n"
                       "extrusion_width = 0.45\nexternal_perimeter_extrusion_width = 0.45\nfirst_layer_extrusion_width = "
                       "0.45\ngcode_comments = 0\nuse_relative_e_distances = 0\n"
                       "bed_shape = 0x0,200x0,200x200,0x200\nthreads = 1\n",
                       sliced_layer);
}

/// In mm, standing in the middle of the bed.
Mesh placed(Mesh mesh)
{
    const Bounds bounds = mesh.bounds();
    const double scale = part_radius / (0.5 * (bounds.high.x - bounds.low.x));
    const dvec3 foot = {bounds.centre().x, bounds.centre().y, bounds.low.z};
    for (dvec3& p : mesh.positions)
        p = scale * (p - foot) + dvec3(bed_middle, bed_middle, 0);
    return mesh;
}

PrintPath sliced(const Mesh& mesh, const std::string& slicer)
{
    const ScratchFolder folder;
    const std::filesystem::path part = folder / "part.stl", config = folder / "settings.ini", gcode = folder / "part.gcode";
    write_mesh(mesh, part);
    write_file(config.string(), settings());
    output_of(fmt::format("{} --load '{}' --center {},{} --export-gcode -o '{}' '{}' 2>/dev/null", slicer, config.string(), bed_middle,
                          bed_middle, gcode.string(), part.string()));
    if (!std::filesystem::exists(gcode))
        throw Error::Device(fmt::format("{} made no G-code of a part", slicer));
    return read_gcode(gcode);
}

/// What `limn render` makes of the beads, in the same light.
Image drawn(const PrintPath& path, const SeenPrint& print, const TruthStage& stage)
{
    PatternOptions pattern;
    pattern.variety = 0;
    pattern.filament = truth_filament;
    ShadeOptions shade = stage.shade;
    shade.up = {0, 0, 1};
    shade.occlusion = bead_occlusion(print);
    return paint_print(print, path, stage.camera, {}, pattern, shade);
}

} // namespace

SlicerTable compare_with_slicer(int width, Console& console)
{
    SlicerTable table;
    const std::optional<std::string> slicer = find_peer("prusa-slicer");
    if (!slicer)
        return table;
    const std::vector<NamedMesh> shapes = print_shapes();
    for (const std::size_t k : {std::size_t(0), std::size_t(1)}) {
        const NamedMesh& shape = shapes[k];
        console.progress(fmt::format("prusa-slicer slices a {}", shape.name), 0.5 * double(k));
        const Mesh mesh = placed(shape.mesh);
        const PrintPath path = sliced(mesh, *slicer);
        table.slicer = path.slicer;
        const SeenPrint print = see_print(path, {});
        for (const int factor : {1, 4}) { // all of it, and its middle near by
            TruthStage stage(mesh, {width, width * 3 / 4});
            if (factor > 1)
                stage.look_closer(factor);
            const TracedPrint wanted = stage.traced(body_of(print));
            std::vector<Image> pictures;
            for (const LayerModel model : models)
                pictures.push_back(stage.painted(model, sliced_layer));
            pictures.push_back(drawn(path, print, stage));
            std::vector<std::string> row = {shape.name, fmt::format("{:.1f}", sliced_layer / stage.layer_height(1)),
                                            std::to_string(print.moves.size())};
            for (const Image& image : pictures)
                row.push_back(fmt::format("{:.3f}", flip(image, wanted.picture)));
            row.push_back(stage.aspect_text(wanted.picture, wanted.filled));
            for (const Image& image : pictures)
                row.push_back(stage.aspect_text(image, wanted.filled));
            table.errors.add(row);
        }
    }
    return table;
}
