#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "limn/subdivision/cage_builder.h"
#include "limn/subdivision/control_shapes.h"

namespace limn {
namespace {

using Row = CageBuilder::Row;

constexpr double plate_width = 0.5; ///< half of it, along z
constexpr float fillet = 4, machined = 10;

/// One side of the bracket: a strip that lies along x, bends, and rises along y, with a hole in each half.
struct Sheet {
    std::array<Row, 7> stations; ///< three vertices across, z ascending; at the holes' stations the middle one is left out
    std::array<Row, 2> holes;    ///< eight vertices from (station before, low z) on, as the hole's frame

    Row frame(std::size_t hole) const
    {
        const Row &a = stations[4 * hole], &b = stations[4 * hole + 1], &c = stations[4 * hole + 2];
        return {a[0], a[1], a[2], b[1], c[2], c[1], c[0], b[0]};
    }
    Row border() const
    {
        Row ring = stations[0];
        for (std::size_t s = 1; s < 6; ++s)
            ring.push_back(stations[s].back());
        ring.insert(ring.end(), stations[6].rbegin(), stations[6].rend());
        for (std::size_t s = 5; s > 0; --s)
            ring.push_back(stations[s].front());
        return ring;
    }
};

/// @param path  of the stations in the plane z = 0
Sheet make_sheet(CageBuilder& cage, const std::array<dvec2, 7>& path)
{
    Sheet sheet;
    for (std::size_t s = 0; s < path.size(); ++s)
        for (const double z : {-plate_width, 0.0, plate_width})
            if (z != 0 || (s != 1 && s != 5))
                sheet.stations[s].push_back(cage.vertex({path[s].x, path[s].y, z}));
    for (const std::size_t hole : {0u, 1u}) {
        const dvec2 middle = path[4 * hole + 1], along = glm::normalize(path[4 * hole + 2] - path[4 * hole]);
        for (int i = 0; i < 8; ++i) {
            const double angle = (5 - i) * std::numbers::pi / 4; // of the frame's vertices: backwards and low first
            const dvec2 p = middle + 0.24 * std::cos(angle) * along;
            sheet.holes[hole].push_back(cage.vertex({p.x, p.y, 0.24 * std::sin(angle)}));
        }
    }
    return sheet;
}

void add_faces(CageBuilder& cage, const Sheet& sheet, bool inner)
{
    const auto closed_band = [&](const Row& a, const Row& b) { inner ? cage.closed_band(b, a) : cage.closed_band(a, b); };
    const auto band = [&](const Row& a, const Row& b) { inner ? cage.band(b, a) : cage.band(a, b); };
    for (const std::size_t hole : {0u, 1u})
        closed_band(sheet.frame(hole), sheet.holes[hole]);
    for (const std::size_t s : {2u, 3u})
        band(sheet.stations[s], sheet.stations[s + 1]);
    cage.crease_ring(sheet.border(), fillet);
    for (const Row& hole : sheet.holes)
        cage.crease_ring(hole, machined);
}

/// A point of a leaf: how far along its stem and blade it lies, how far to the side.
struct LeafStation {
    double along, half_width;
};

} // namespace

Mesh bracket_cage()
{
    // Outer side below and behind, inner side above and in front.
    const std::array<dvec2, 7> outer = {{{1.3, 0}, {0.8, 0}, {0.34, 0}, {0.06, 0.06}, {0, 0.34}, {0, 0.9}, {0, 1.5}}};
    const std::array<dvec2, 7> inner = {{{1.3, 0.2}, {0.8, 0.2}, {0.46, 0.2}, {0.26, 0.26}, {0.2, 0.46}, {0.2, 0.9}, {0.2, 1.5}}};
    CageBuilder cage;
    const Sheet below = make_sheet(cage, outer), above = make_sheet(cage, inner);
    add_faces(cage, below, false);
    add_faces(cage, above, true);
    cage.closed_band(above.border(), below.border());
    for (const std::size_t hole : {0u, 1u})
        cage.closed_band(below.holes[hole], above.holes[hole]);
    return cage.mesh();
}

Mesh leaf_cage()
{
    constexpr LeafStation stations[] = {{-0.7, 0.045}, {-0.4, 0.03}, {-0.08, 0.05}, {0.1, 0.34}, {0.35, 0.5}, {0.62, 0.48}, {0.88, 0.35}, {1.1, 0.18}};
    constexpr std::size_t blade = 3; // the first station of the blade
    CageBuilder cage;
    // The blade bends down towards the tip, and its halves rise from the midrib.
    const auto point = [](double along, double side, double rise) {
        const double bend = 0.22 * along * std::abs(along);
        return dvec3(along, 0.3 - bend + rise * side, side);
    };
    std::vector<Row> rows;
    for (const LeafStation& s : stations)
        rows.push_back({cage.vertex(point(s.along, 0, 0)), cage.vertex(point(s.along, 0.5 * s.half_width, 0.45)), cage.vertex(point(s.along, s.half_width, 0.25))});
    for (std::size_t i = 0; i + 1 < rows.size(); ++i)
        for (std::size_t k = 0; k < 2; ++k) // cut from the midrib forwards
            cage.face({rows[i + 1][k], rows[i][k], rows[i][k + 1], rows[i + 1][k + 1]});
    const std::uint32_t tip = cage.vertex(point(1.34, 0, 0));
    for (std::size_t k = 0; k < 2; ++k)
        cage.face({rows.back()[k], rows.back()[k + 1], tip});
    for (std::size_t i = blade; i < rows.size(); ++i)
        cage.crease(rows[i][0], i + 1 < rows.size() ? rows[i + 1][0] : tip, 10);
    cage.mirror();
    return cage.mesh();
}

} // namespace limn
