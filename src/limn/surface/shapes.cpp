#include "limn/surface/shapes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/base/random.h"
#include "limn/surface/shape_grid.h"
#include "limn/surface/shape_parts.h"
#include "limn/surface/sharp_shapes.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1 << 10;
constexpr double most_triangles = 1e8, most_jitter = 0.5;

bool is_sharp(std::string_view name) { return name == "cube" || name == "cylinder"; }

/// The fewest triangles that a part's topology can be made of.
std::size_t fewest_triangles(const ShapePart& part)
{
    switch (part.topology) {
    case ShapePart::Topology::sphere: return 20;
    case ShapePart::Topology::torus: return 18;
    case ShapePart::Topology::sheet: return 2;
    }
    return 0;
}

std::size_t fewest_triangles(const std::vector<ShapePart>& parts)
{
    std::size_t sum = 0;
    for (const ShapePart& part : parts)
        sum += fewest_triangles(part);
    return sum;
}

void check(const ShapeOptions& options, std::size_t fewest)
{
    if (options.triangles < fewest || double(options.triangles) > most_triangles)
        throw Error::Input(fmt::format("--triangles: {} cannot be met by '{}', which takes {} to {}", options.triangles, options.name,
                                       fewest, std::size_t(most_triangles)));
    if (!(options.jitter >= 0 && options.jitter <= most_jitter))
        throw Error::Input(fmt::format("--jitter: {} is outside 0..{} cells", options.jitter, most_jitter));
    if (!(options.noise >= 0 && std::isfinite(options.noise)))
        throw Error::Input(fmt::format("--noise: {} is not a length", options.noise));
    if (!(options.tube_radius > 0 && options.tube_radius < 1))
        throw Error::Input(fmt::format("the tube radius {} is outside 0..1", options.tube_radius));
}

void resize(Surface& surface, std::size_t count)
{
    surface.normals.resize(count);
    surface.e1.resize(count);
    surface.e2.resize(count);
    surface.k1.resize(count);
    surface.k2.resize(count);
    surface.derivative.resize(count);
}

void store(Surface& surface, std::size_t i, const SurfacePoint& point)
{
    surface.normals[i] = vec3(point.normal);
    surface.e1[i] = vec3(point.e1);
    surface.e2[i] = vec3(point.e2);
    surface.k1[i] = float(point.k1);
    surface.k2[i] = float(point.k2);
    surface.derivative[i] = vec4(point.derivative);
}

/// Appends a part with its exact fields.
void append(Shape& shape, const ShapePart& part, const ParameterMesh& domain)
{
    const std::size_t first = shape.mesh.positions.size();
    shape.mesh.positions.resize(first + domain.parameters.size());
    resize(shape.exact, shape.mesh.positions.size());
    parallel_each(domain.parameters.size(), grain, [&](std::size_t i) {
        const SurfacePoint point = surface_point(part.jet(domain.parameters[i]));
        shape.mesh.positions[first + i] = point.position;
        store(shape.exact, first + i, point);
    });
    shape.mesh.triangles.reserve(shape.mesh.triangles.size() + domain.triangles.size());
    for (const uvec3& t : domain.triangles)
        shape.mesh.triangles.push_back(t + uvec3(std::uint32_t(first)));
    shape.closed = shape.closed && part.topology != ShapePart::Topology::sheet;
}

/// Displaces along `normals`, then rounds.
void disturb(Mesh& mesh, const std::vector<vec3>& normals, const ShapeOptions& options)
{
    parallel_each(mesh.positions.size(), grain, [&](std::size_t i) {
        dvec3& p = mesh.positions[i];
        if (options.noise > 0) {
            Random random(options.seed ^ 0x6E6F697365u, i); // a stream of its own beside the jitter's
            p += options.noise * random.normal() * dvec3(normals[i]);
        }
        if (options.float_positions)
            p = dvec3(vec3(p));
    });
}

Shape make_sharp(const ShapeOptions& options)
{
    check(options, fewest_sharp_triangles(options.name));
    Shape shape;
    shape.mesh = options.name == "cube" ? make_cube(options.triangles, options.jitter, options.seed)
                                        : make_cylinder(options.triangles, options.jitter, options.seed);
    disturb(shape.mesh, options.noise > 0 ? area_normals(shape.mesh) : std::vector<vec3>(), options);
    return shape;
}

} // namespace

Shape make_shape(const ShapeOptions& options)
{
    const std::vector<std::string>& known = shape_names();
    if (std::find(known.begin(), known.end(), options.name) == known.end())
        throw Error::Input(fmt::format("there is no shape '{}'; known are {}", options.name, fmt::join(known, ", ")));
    if (is_sharp(options.name))
        return make_sharp(options);
    const std::vector<ShapePart> parts = shape_parts(options.name, options.tube_radius);
    check(options, fewest_triangles(parts));
    Shape shape;
    for (std::size_t i = 0; i < parts.size(); ++i)
        append(shape, parts[i], part_domain(parts[i], options.triangles / parts.size(), options.jitter, options.seed + i));
    disturb(shape.mesh, shape.exact.normals, options);
    return shape;
}

const std::vector<std::string>& shape_names()
{
    static const std::vector<std::string> names = {"sphere", "ellipsoid", "torus", "bumpy-torus", "sine-sheet", "bump", "plane", "bent-sheet",
                                                   "rings", "knot", "blob", "discs", "spheres", "cube", "cylinder"};
    return names;
}

const OptionTable<ShapeOptions>& shape_option_table()
{
    static const OptionTable<ShapeOptions> table = {
        number_row<ShapeOptions>("triangles", "", 2, most_triangles, "wanted number of triangles", &ShapeOptions::triangles),
        number_row<ShapeOptions>("jitter", "cells", 0, most_jitter, "move vertices on the surface by up to this much", &ShapeOptions::jitter),
        number_row<ShapeOptions>("noise", "length", 0, 1e3, "standard deviation of a displacement along the normal", &ShapeOptions::noise),
        number_row<ShapeOptions>("seed", "", 0, 4294967295.0, "seed of jitter and noise, or of a terrain or tree", &ShapeOptions::seed),
        {"double", "", "yes|no", "keep double positions instead of rounding to float",
         [](ShapeOptions& options, std::string_view text) {
             if (text != "yes" && text != "no")
                 throw Error::Input(fmt::format("--double: '{}' is none of yes|no", text));
             options.float_positions = text == "no";
         },
         [](const ShapeOptions& options) { return std::string(options.float_positions ? "no" : "yes"); }}};
    return table;
}

SurfacePoint shape_point(std::string_view name, const dvec3& parameter, std::size_t part)
{
    const std::vector<ShapePart> parts = shape_parts(name);
    if (part >= parts.size())
        throw Error::Input(fmt::format("the shape '{}' has no smooth part {}", name, part));
    return surface_point(parts[part].jet(parameter));
}

} // namespace limn
