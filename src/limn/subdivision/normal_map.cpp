#include "limn/subdivision/normal_map.h"

#include <algorithm>
#include <cmath>
#include <concepts>

#include <fmt/format.h>

#include "limn/base/distance_transform.h"
#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/subdivision/tangent_frames.h"

namespace limn {
namespace {

/// What is painted at a place of the surface: a unit vector.
template <class F> concept NormalAt = requires(F f, PatchPoint at) {
    { f(at) } -> std::convertible_to<dvec3>;
};

void put(Image& texels, int x, int y, const dvec3& normal)
{
    float* texel = texels.at(x, y);
    for (int k = 0; k < 3; ++k)
        texel[k] = float(normal[k] / 2 + 0.5);
    texel[3] = 1;
}

/// Parameters of a place in a flat triangle, for any point of the plane.
struct FlatFace {
    dvec2 first, v_side, w_side;
    double area; ///< twice

    explicit FlatFace(const dvec2 (&corners)[3])
        : first(corners[0]), v_side(corners[1] - corners[0]), w_side(corners[2] - corners[0]), area(v_side.x * w_side.y - v_side.y * w_side.x)
    {
    }
    dvec2 parameters(const dvec2& p) const
    {
        const dvec2 d = p - first;
        return {(d.x * w_side.y - d.y * w_side.x) / area, (v_side.x * d.y - v_side.y * d.x) / area};
    }
};

/// Paints the texels whose middle lies in a chart. @return how many
template <NormalAt F> std::size_t paint_faces(Image& texels, const Atlas& atlas, const Chart& chart, std::size_t number, F&& normal_at)
{
    constexpr double rounding = 1e-9; // so that no texel falls between two faces
    const Atlas::Cell& cell = atlas.cells[number];
    std::size_t painted = 0;
    for (int f = 0; f < chart.face_count(); ++f) {
        dvec2 corners[3];
        for (int k = 0; k < 3; ++k)
            corners[k] = atlas.texel(number, chart.corners[f][k]);
        const FlatFace face(corners);
        if (face.area == 0)
            continue;
        const dvec2 low = glm::min(glm::min(corners[0], corners[1]), corners[2]), high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
        for (int y = std::max(cell.low.y, int(low.y)); y < std::min(cell.high.y, int(high.y) + 1); ++y)
            for (int x = std::max(cell.low.x, int(low.x)); x < std::min(cell.high.x, int(high.x) + 1); ++x) {
                const dvec2 p = face.parameters({x + 0.5, y + 0.5});
                if (texels.at(x, y)[3] > 0 || p.x < -rounding || p.y < -rounding || p.x + p.y > 1 + rounding)
                    continue;
                const double v = std::max(p.x, 0.0), w = std::max(p.y, 0.0), sum = std::max(v + w, 1.0);
                put(texels, x, y, normal_at(PatchPoint{chart.faces[f], v / sum, w / sum}));
                ++painted;
            }
    }
    return painted;
}

/// Fills the rest of a cell with the nearest of its painted texels.
void fill_cell(Image& texels, const Atlas::Cell& cell)
{
    const ivec2 size = cell.high - cell.low;
    std::vector<std::uint8_t> marked;
    for (int y = cell.low.y; y < cell.high.y; ++y)
        for (int x = cell.low.x; x < cell.high.x; ++x)
            marked.push_back(texels.at(x, y)[3] > 0);
    const DistanceTransform nearest = distance_transform(marked, size);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            if (marked[std::size_t(y) * std::size_t(size.x) + std::size_t(x)] == 0) {
                const ivec2 from = cell.low + nearest.nearest_to(x, y);
                std::copy_n(texels.at(from.x, from.y), 3, texels.at(cell.low.x + x, cell.low.y + y));
            }
}

constexpr float straight_up[3] = {0.5f, 0.5f, 1};

template <NormalAt F> NormalMap paint(const MapLayout& layout, bool dilate, F&& normal_at)
{
    const Atlas& atlas = layout.atlas;
    NormalMap map;
    map.texels = Image({atlas.size, atlas.size}, 4);
    for (std::size_t i = 0; i < map.texels.samples.size(); i += 4) // what lies outside of all cells
        std::copy_n(straight_up, 3, map.texels.samples.data() + i);
    std::vector<std::size_t> covered(layout.charts.size());
    parallel_each(layout.charts.size(), 8, [&](std::size_t i) {
        covered[i] = paint_faces(map.texels, atlas, layout.charts[i], i, normal_at);
        if (covered[i] == 0) {
            const ivec2 middle = ivec2(atlas.texel(i, layout.charts[i].size / 2.0));
            put(map.texels, middle.x, middle.y, normal_at(PatchPoint{layout.charts[i].faces[0], 1.0 / 3, 1.0 / 3}));
            covered[i] = 1;
        }
        if (dilate)
            fill_cell(map.texels, atlas.cells[i]);
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

} // namespace

const OptionTable<NormalMapOptions>& normal_map_option_table()
{
    using Options = NormalMapOptions;
    static const OptionTable<Options> table = {
        number_row<Options>("map-size", "texels", 16, 16384, "side of the normal map", &Options::size),
        choice_row<Options, NormalSpace>("space", {{"object", NormalSpace::object}, {"tangent", NormalSpace::tangent}},
                                         "what the map's directions refer to", &Options::space),
        choice_row<Options, ChartKind>("map-charts", {{"pairs", ChartKind::pairs}, {"triangles", ChartKind::triangles}},
                                       "lay faces out two by two, or each on its own", &Options::charts),
        choice_row<Options, int>("map-gap", {{"2", 2}, {"4", 4}, {"8", 8}, {"16", 16}, {"32", 32}, {"64", 64}},
                                 "texels between charts; the map is clean in mip levels up to its binary logarithm", &Options::gap),
        choice_row<Options, int>("map-bits", {{"8", 8}, {"16", 16}}, "bits of the map's samples", &Options::bits)};
    return table;
}

MapLayout lay_out_map(const LoopTopology& topology, std::span<const dvec3> limit, const NormalMapOptions& options)
{
    MapLayout layout;
    layout.charts = make_charts(topology, limit, options.charts);
    layout.atlas = pack_charts(layout.charts, options.size, options.gap);
    layout.uvs = atlas_uvs(layout.atlas, layout.charts, topology.triangles.size());
    return layout;
}

NormalMap object_space_map(const MapLayout& layout, const LimitShape& shape, bool dilate)
{
    return paint(layout, dilate, [&](const PatchPoint& at) { return shape.normal(at); });
}

NormalMap tangent_space_map(const MapLayout& layout, const LimitShape& shape, const Mesh& mesh, int levels, bool dilate)
{
    if (mesh.corner_normals.size() != 3 * mesh.triangles.size() || mesh.corner_uvs.size() != mesh.corner_normals.size() ||
        mesh.triangles.size() != (layout.uvs.size() / 3) << (2 * levels))
        throw Error::Input(fmt::format("a mesh of {} triangles is not the mesh after {} levels with normals and texture coordinates", mesh.triangles.size(), levels));
    const std::vector<dvec3> tangents = corner_tangents(mesh);
    return paint(layout, dilate, [&](const PatchPoint& at) {
        const PatchPoint fine = taken_down(at, levels);
        const std::size_t c = 3 * std::size_t(fine.face);
        const auto mixed = [&](const auto& values) { return (1 - fine.v - fine.w) * dvec3(values[c]) + fine.v * dvec3(values[c + 1]) + fine.w * dvec3(values[c + 2]); };
        const dvec3 n = mixed(mesh.corner_normals), t = mixed(tangents), b = glm::cross(n, t);
        const double volume = glm::dot(glm::cross(t, b), n);
        const dvec3 normal = shape.normal(at);
        if (!(volume > 0))
            return dvec3(0, 0, 1); // no frame that could be undone
        return glm::normalize(dvec3(glm::dot(glm::cross(b, n), normal), glm::dot(glm::cross(n, t), normal), glm::dot(glm::cross(t, b), normal)) / volume);
    });
}

} // namespace limn
