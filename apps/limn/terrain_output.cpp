#include "terrain_output.h"

#include <algorithm>

#include <fmt/format.h>

#include "console.h"
#include "fit_camera.h"
#include "limn/lines/line_model.h"
#include "limn/terrain/terrain_solid.h"

using namespace limn;

namespace {

/// The places of a coarse mesh, for a camera to be fitted around.
LineModel places_of(const Mesh& mesh)
{
    LineModel model;
    const Bounds bounds = mesh.bounds();
    model.centre = bounds.centre();
    model.scale = bounds.radius() > 0 ? bounds.radius() : 1;
    for (const dvec3& p : mesh.positions)
        model.positions.push_back(model.from_world(p));
    model.positions.emplace_back(0); // the spare one
    return model;
}

} // namespace

Sheet place_terrain_camera(ViewOptions view, const Mesh& coarse)
{
    if (view.views.empty() && view.eye.empty())
        view.views = {view.usual_view};
    const LineModel model = places_of(coarse);
    Sheet sheet = place_cameras(view, {model, coarse.bounds()}, 'z');
    if (!view.views.empty() && view.camera_file.empty() && !sheet.cameras.front().orthographic)
        centre_in_picture(sheet.cameras.front(), model);
    return sheet;
}

Mesh for_file(Mesh mesh, double print_size, double base)
{
    if (print_size > 0) {
        const dvec3 size = mesh.bounds().size();
        const double to_mm = print_size / std::max(size.x, size.y);
        for (dvec3& p : mesh.positions)
            p *= to_mm;
    }
    return base > 0 ? terrain_solid(mesh, base) : mesh;
}

std::string unit_of(const TerrainBound& bound) { return bound.in_pixels ? "px" : "m"; }

std::string error_lines(const BuiltTerrain& terrain)
{
    const std::string unit = unit_of(terrain.asked);
    const MeasuredTerrain& m = terrain.measured;
    return fmt::format("bound asked   {:.6g} {}\nmaximum       {:.6g} {}\nRMS           {:.6g} {}\nsamples       {}\nover          "
                       "{}\nwithout mesh  {}\ntriangles     {}\n",
                       terrain.asked.value, unit, m.maximum, unit, m.rms, unit, with_thousands(m.samples), with_thousands(m.over),
                       with_thousands(m.bare), with_thousands(terrain.mesh.triangles.size()));
}
