#include "limn/subdivision/normal_map.h"

#include <algorithm>
#include <cmath>
#include <concepts>

#include <fmt/format.h>

#include "limn/base/distance_transform.h"
#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/drawing/png.h"
#include "limn/subdivision/map_gutter.h"
#include "limn/subdivision/tangent_frames.h"

namespace limn {
namespace {

/// What is painted at a place: a vector of unit length. `own` is a place of the chart, `seen` the one whose normal is meant; they differ in gutters.
template <class F> concept Painter = requires(F f, PatchPoint own, PatchPoint seen) {
    { f(own, seen) } -> std::convertible_to<dvec3>;
};

constexpr float straight_up[3] = {0.5f, 0.5f, 1};

void put(float* texel, const dvec3& normal)
{
    for (int k = 0; k < 3; ++k)
        texel[k] = float(normal[k] / 2 + 0.5);
}

/// Paints the texels whose middle lies in a chart, at least one. @return how many
template <Painter F> std::size_t paint_faces(Image& texels, const Atlas& atlas, const Chart& chart, std::size_t number, F&& paint)
{
    constexpr double rounding = 1e-9; // so that no texel falls between two faces
    const Atlas::Cell& cell = atlas.cells[number];
    std::size_t painted = 0;
    const auto paint_texel = [&](int x, int y, const PatchPoint& at) {
        put(texels.at(x, y), paint(at, at));
        texels.at(x, y)[3] = 1;
        ++painted;
    };
    for (int f = 0; f < chart.face_count(); ++f) {
        dvec2 corners[3];
        for (int k = 0; k < 3; ++k)
            corners[k] = atlas.texel(number, chart.corners[f][k]);
        const dvec2 low = glm::min(glm::min(corners[0], corners[1]), corners[2]), high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
        for (int y = std::max(cell.low.y, int(low.y)); y < std::min(cell.high.y, int(high.y) + 1); ++y)
            for (int x = std::max(cell.low.x, int(low.x)); x < std::min(cell.high.x, int(high.x) + 1); ++x) {
                const dvec2 p = flat_parameters(corners, {x + 0.5, y + 0.5});
                if (texels.at(x, y)[3] > 0 || !(p.x >= -rounding && p.y >= -rounding && p.x + p.y <= 1 + rounding))
                    continue;
                paint_texel(x, y, inside_face(chart.faces[f], p));
            }
    }
    if (painted == 0) {
        const ivec2 middle = ivec2(atlas.texel(number, chart.size / 2.0));
        paint_texel(middle.x, middle.y, {chart.faces[0], 1.0 / 3, 1.0 / 3});
    }
    return painted;
}

/// Fills the rest of a cell.
template <Painter F> void fill_cell(Image& texels, const MapLayout& layout, const LoopTopology& topology, std::size_t number, MapGutter gutter, F&& paint)
{
    constexpr std::int64_t continued = 2 * 2; // texels, squared
    const Atlas::Cell& cell = layout.atlas.cells[number];
    const ivec2 size = cell.high - cell.low;
    std::vector<std::uint8_t> marked;
    for (int y = cell.low.y; y < cell.high.y; ++y)
        for (int x = cell.low.x; x < cell.high.x; ++x)
            marked.push_back(texels.at(x, y)[3] > 0);
    const DistanceTransform nearest = distance_transform(marked, size);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            float* texel = texels.at(cell.low.x + x, cell.low.y + y);
            if (const std::int64_t distance = nearest.squared_distance(x, y); distance > 0 && distance <= continued && gutter == MapGutter::continued) {
                const dvec2 p = layout.atlas.chart_point(number, dvec2(cell.low + ivec2(x, y)) + 0.5);
                const GutterPoint at = gutter_point(layout.charts[number], p, topology, layout.limit);
                put(texel, paint(at.own, at.beyond));
            } else if (distance > 0) {
                const ivec2 from = cell.low + nearest.nearest_to(x, y);
                std::copy_n(texels.at(from.x, from.y), 3, texel);
            }
        }
}

template <Painter F> NormalMap paint_map(const MapLayout& layout, const LoopTopology& topology, MapGutter gutter, F&& paint)
{
    NormalMap map;
    map.texels = Image({layout.atlas.size, layout.atlas.size}, 4);
    for (std::size_t i = 0; i < map.texels.samples.size(); i += 4) // what lies outside of all cells
        std::copy_n(straight_up, 3, map.texels.samples.data() + i);
    std::vector<std::size_t> covered(layout.charts.size());
    parallel_each(layout.charts.size(), 8, [&](std::size_t i) {
        covered[i] = paint_faces(map.texels, layout.atlas, layout.charts[i], i, paint);
        if (gutter != MapGutter::empty)
            fill_cell(map.texels, layout, topology, i, gutter, paint);
    });
    for (const std::size_t count : covered)
        map.covered += count;
    return map;
}

/// The same place in a face of the mesh after some steps, whose numbers are those of loop_refine.h.
PatchPoint taken_down(PatchPoint at, int levels)
{
    for (; levels > 0; --levels) {
        const double u = 1 - at.v - at.w;
        if (u >= 0.5)
            at = {4 * at.face, 2 * at.v, 2 * at.w};
        else if (at.v >= 0.5)
            at = {4 * at.face + 1, 2 * at.w, 2 * u};
        else if (at.w >= 0.5)
            at = {4 * at.face + 2, 2 * u, 2 * at.v};
        else
            at = {4 * at.face + 3, 1 - 2 * u, 1 - 2 * at.v};
    }
    return at;
}

/// A direction's components along tangent, bitangent and normal, which need not be at right angles or units; made a unit.
dvec3 in_frame(const dvec3& tangent, const dvec3& normal, const dvec3& direction)
{
    const dvec3 bitangent = glm::cross(normal, tangent);
    const double volume = glm::dot(glm::cross(tangent, bitangent), normal);
    if (!(volume > 0))
        return {0, 0, 1}; // no frame: whatever stands in the map, the mesh's own normal is as good
    return glm::normalize(dvec3(glm::dot(glm::cross(bitangent, normal), direction), glm::dot(glm::cross(normal, tangent), direction),
                                glm::dot(glm::cross(tangent, bitangent), direction)));
}

} // namespace

const OptionTable<NormalMapOptions>& normal_map_option_table()
{
    using Options = NormalMapOptions;
    static const OptionTable<Options> table = {
        number_row<Options>("map-size", "texels", 16, 8192, "side of the normal map", &Options::size),
        choice_row<Options, NormalSpace>("space", {{"object", NormalSpace::object}, {"tangent", NormalSpace::tangent}},
                                         "what the map's directions refer to", &Options::space),
        choice_row<Options, ChartKind>("map-charts", {{"pairs", ChartKind::pairs}, {"triangles", ChartKind::triangles}},
                                       "lay faces out two by two, or each on its own", &Options::charts),
        choice_row<Options, int>("map-gap", {{"2", 2}, {"4", 4}, {"8", 8}, {"16", 16}, {"32", 32}, {"64", 64}},
                                 "texels between charts; the map is clean in mip levels up to its binary logarithm", &Options::gap),
        choice_row<Options, int>("map-bits", {{"8", 8}, {"16", 16}}, "bits of the map's samples", &Options::bits),
        switch_row<Options>("map-alpha", "add an alpha channel that tells which texels lie in charts", &Options::alpha)};
    return table;
}

MapLayout lay_out_map(const LoopTopology& topology, std::vector<dvec3> limit, const NormalMapOptions& options)
{
    MapLayout layout;
    layout.limit = std::move(limit);
    layout.charts = make_charts(topology, layout.limit, options.charts);
    layout.atlas = pack_charts(layout.charts, options.size, options.gap);
    layout.uvs = atlas_uvs(layout.atlas, layout.charts, topology.triangles.size());
    return layout;
}

NormalMap object_space_map(const MapLayout& layout, const LimitShape& shape, MapGutter gutter)
{
    return paint_map(layout, shape.table().control(), gutter, [&](const PatchPoint&, const PatchPoint& seen) { return shape.normal(seen); });
}

std::string normal_map_png(const NormalMap& map, const NormalMapOptions& options)
{
    if (options.alpha)
        return encode_png(map.texels, {.bits = options.bits});
    Image opaque(map.texels.size(), 3);
    for (std::size_t i = 0; i < opaque.samples.size() / 3; ++i)
        std::copy_n(map.texels.samples.data() + 4 * i, 3, opaque.samples.data() + 3 * i);
    return encode_png(opaque, {.bits = options.bits});
}

NormalMap tangent_space_map(const MapLayout& layout, const LimitShape& shape, const Mesh& mesh, int levels, MapGutter gutter)
{
    if (mesh.corner_normals.size() != 3 * mesh.triangles.size() || mesh.corner_uvs.size() != mesh.corner_normals.size() ||
        mesh.triangles.size() != (layout.uvs.size() / 3) << (2 * levels))
        throw Error::Input(fmt::format("a mesh of {} triangles is not the mesh after {} levels with normals and texture coordinates", mesh.triangles.size(), levels));
    const std::vector<dvec3> tangents = corner_tangents(mesh);
    return paint_map(layout, shape.table().control(), gutter, [&](const PatchPoint& own, const PatchPoint& seen) {
        const PatchPoint fine = taken_down(own, levels);
        const std::size_t c = 3 * std::size_t(fine.face);
        const auto mixed = [&](const auto& values) { return (1 - fine.v - fine.w) * dvec3(values[c]) + fine.v * dvec3(values[c + 1]) + fine.w * dvec3(values[c + 2]); };
        return in_frame(mixed(tangents), mixed(mesh.corner_normals), shape.normal(seen));
    });
}

} // namespace limn
