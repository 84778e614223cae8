#include "limn/subdivision/loop_limit.h"

#include <algorithm>

#include "limn/base/parallel.h"
#include "limn/subdivision/loop_limit_masks.h"
#include "limn/subdivision/loop_ring.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1024;

/// The masks of vertices whose whole ring counts, by valence.
class MaskTable {
public:
    MaskTable(CreaseRule rule, std::span<const std::size_t> smooth, std::span<const std::size_t> darts)
    {
        for (const std::size_t n : smooth)
            smooth_.try_emplace(n, smooth_limit_masks(n));
        for (const std::size_t n : darts)
            darts_.try_emplace(n, dart_limit_masks(n, rule));
    }
    const LimitMasks& of(VertexKind kind, std::size_t valence) const { return (kind == VertexKind::dart ? darts_ : smooth_).at(valence); }

private:
    std::map<std::size_t, LimitMasks> smooth_, darts_;
};

/// Whether the masks around a vertex may depend on what its neighbours are, until these are points of edges.
bool asks_neighbours(const LoopTopology& t, const Spokes& spokes, CreaseRule rule)
{
    const bool smooth = vertex_kind(spokes.sharpness) == VertexKind::smooth;
    if (rule != CreaseRule::biermann || !smooth)
        return rule != CreaseRule::opensubdiv && !smooth;
    return std::any_of(spokes.neighbours.begin(), spokes.neighbours.end(), [&](std::uint32_t v) { return t.is_at_sharp_edge(v); });
}

/// The ring of a vertex from the level on at which the rules around it no longer change.
LoopRing settled_ring(const LoopTopology& t, const Spokes& spokes, std::span<const dvec3> positions, std::uint32_t vertex, CreaseRule rule)
{
    if (is_settled(spokes.sharpness) && !asks_neighbours(t, spokes, rule))
        return ring_of(spokes, positions, vertex);
    LoopRing ring = refined_ring(t, spokes, positions, vertex, rule);
    while (!is_settled(ring.sharpness))
        ring = refined_ring(ring, rule);
    return ring;
}

std::size_t first_sharp(const LoopRing& ring)
{
    return std::size_t(std::find_if(ring.sharpness.begin(), ring.sharpness.end(), [](float s) { return s > 0; }) - ring.sharpness.begin());
}

/// @param first  the neighbour that has the mask's first weight
dvec3 apply(const RingMask& mask, const LoopRing& ring, std::size_t first)
{
    dvec3 sum = mask.self * ring.centre;
    for (std::size_t i = 0; i < mask.points.size(); ++i)
        sum += mask.points[i] * ring.points[(first + i) % ring.points.size()];
    return sum;
}

/// The faces from one crease to the next, or all where there are fewer than two.
struct Sector {
    std::size_t first = 0, triangles = 0; ///< the first face and point; how many faces
};

Sector sector_of(const LoopRing& ring, VertexKind kind, std::size_t face)
{
    const std::size_t n = ring.points.size();
    if (kind == VertexKind::smooth || kind == VertexKind::dart)
        return {kind == VertexKind::dart ? first_sharp(ring) : 0, n};
    Sector sector{face, 1};
    while (!(ring.sharpness[sector.first] > 0)) {
        sector.first = (sector.first + n - 1) % n;
        ++sector.triangles;
    }
    while (!(ring.sharpness[(sector.first + sector.triangles) % n] > 0))
        ++sector.triangles;
    return sector;
}

dvec3 face_normal(const LoopRing& ring, std::size_t face)
{
    const std::size_t n = ring.points.size();
    return glm::cross(ring.points[face % n] - ring.centre, ring.points[(face + 1) % n] - ring.centre);
}

/// The first of these that has a direction, as a unit vector.
dvec3 unit_normal(const LimitPoint& point, const LoopRing& ring, const Sector& sector, std::size_t face)
{
    constexpr double parallel = 1e-12;
    const dvec3 normal = glm::cross(point.u, point.v);
    if (glm::length(normal) > parallel * glm::length(point.u) * glm::length(point.v))
        return glm::normalize(normal);
    dvec3 sum(0);
    double most = 0;
    for (std::size_t i = 0; i < sector.triangles; ++i) {
        sum += face_normal(ring, sector.first + i);
        most += glm::length(face_normal(ring, sector.first + i));
    }
    if (glm::length(sum) > parallel * most)
        return glm::normalize(sum);
    const dvec3 own = face_normal(ring, face);
    return glm::length(own) > 0 ? glm::normalize(own) : dvec3(0, 0, 1);
}

dvec3 limit_position(const LoopRing& ring, VertexKind kind, CreaseRule rule, const MaskTable& table)
{
    switch (kind) {
    case VertexKind::smooth:
    case VertexKind::dart: return apply(table.of(kind, ring.points.size()).position, ring, kind == VertexKind::dart ? first_sharp(ring) : 0);
    case VertexKind::crease: {
        const Sector sector = sector_of(ring, kind, first_sharp(ring));
        const std::size_t ends[2] = {sector.first, (sector.first + sector.triangles) % ring.points.size()};
        const double self = crease_limit_weight(edge_end(ring.sharpness, ring.closed, ends[0]).regular, rule);
        return self * ring.centre + (1 - self) / 2 * (ring.points[ends[0]] + ring.points[ends[1]]);
    }
    case VertexKind::corner: break;
    }
    return ring.centre;
}

void set_tangents(LimitPoint& point, const LoopRing& ring, VertexKind kind, const Sector& sector, CreaseRule rule, const MaskTable& table)
{
    const dvec3 &first = ring.points[sector.first], &last = ring.points[(sector.first + sector.triangles) % ring.points.size()];
    switch (kind) {
    case VertexKind::smooth:
    case VertexKind::dart: {
        const LimitMasks& masks = table.of(kind, ring.points.size());
        point.u = apply(masks.u, ring, sector.first);
        point.v = apply(masks.v, ring, sector.first);
        return;
    }
    case VertexKind::crease: {
        const bool regular = edge_end(ring.sharpness, ring.closed, sector.first).regular;
        point.u = first - last;
        point.v = apply(across_mask(sector.triangles + 1, regular, rule), ring, sector.first);
        return;
    }
    case VertexKind::corner: break;
    }
    point.u = first - ring.centre;
    point.v = last - ring.centre;
    dvec3 outward(0);
    for (std::size_t i = 0; i < sector.triangles; ++i)
        outward += face_normal(ring, sector.first + i);
    if (glm::dot(glm::cross(point.u, point.v), outward) < 0) // the sector is wider than half a turn
        std::swap(point.u, point.v);
}

/// All but the normal, which depends on the face where there is no tangent plane.
LimitPoint limit_of_sector(const LoopRing& ring, VertexKind kind, const Sector& sector, CreaseRule rule, const MaskTable& table)
{
    LimitPoint point{limit_position(ring, kind, rule, table), dvec3(0), dvec3(0), dvec3(0)};
    set_tangents(point, ring, kind, sector, rule, table);
    return point;
}

/// What kind a vertex has once its fading edges have faded.
VertexKind settled_kind(const Spokes& spokes)
{
    std::vector<float> sharp = spokes.sharpness;
    for (float& s : sharp)
        s = s >= infinitely_sharp ? s : 0;
    return vertex_kind(sharp);
}

/// The masks that the vertices [0, count) need. @param vertex  gives their numbers
template <class F> MaskTable make_table(const LoopTopology& t, CreaseRule rule, std::size_t count, F&& vertex)
{
    std::vector<std::size_t> valences[2];
    Spokes spokes;
    for (std::size_t i = 0; i < count; ++i) {
        t.gather(vertex(i), spokes);
        const VertexKind kind = settled_kind(spokes);
        if (spokes.size() == 0 || kind > VertexKind::dart)
            continue;
        std::vector<std::size_t>& seen = valences[kind == VertexKind::dart];
        if (std::find(seen.begin(), seen.end(), spokes.size()) == seen.end())
            seen.push_back(spokes.size());
    }
    return MaskTable(rule, valences[0], valences[1]);
}

/// Calls f(vertex, spokes, settled ring, masks) for every vertex with faces; parallel.
template <class F> void each_ring(const LoopTopology& t, std::span<const dvec3> positions, CreaseRule rule, F&& f)
{
    const MaskTable table = make_table(t, rule, t.vertex_count(), [](std::size_t v) { return std::uint32_t(v); });
    parallel_blocks(t.vertex_count(), grain, [&](std::size_t begin, std::size_t end) {
        Spokes spokes;
        for (std::uint32_t v = std::uint32_t(begin); v < end; ++v) {
            t.gather(v, spokes);
            if (spokes.size() > 0)
                f(v, spokes, settled_ring(t, spokes, positions, v, rule), table);
        }
    });
}

} // namespace

LimitPoint limit_point(const LoopTopology& t, std::span<const dvec3> positions, std::uint32_t half_edge, CreaseRule rule)
{
    const std::uint32_t vertex = t.start(half_edge);
    const Spokes spokes = t.gather(vertex);
    const auto face = std::find(spokes.half_edges.begin(), spokes.half_edges.end(), half_edge) - spokes.half_edges.begin();
    const MaskTable table = make_table(t, rule, 1, [&](std::size_t) { return vertex; });
    const LoopRing ring = settled_ring(t, spokes, positions, vertex, rule);
    const VertexKind kind = vertex_kind(ring.sharpness);
    const Sector sector = sector_of(ring, kind, std::size_t(face));
    LimitPoint point = limit_of_sector(ring, kind, sector, rule, table);
    point.normal = unit_normal(point, ring, sector, std::size_t(face));
    return point;
}

LimitSurface limit_surface(const LoopTopology& t, std::span<const dvec3> positions, CreaseRule rule)
{
    LimitSurface limit{{positions.begin(), positions.end()}, std::vector<dvec3>(t.twin.size())};
    each_ring(t, positions, rule, [&](std::uint32_t v, const Spokes& spokes, const LoopRing& ring, const MaskTable& table) {
        const VertexKind kind = vertex_kind(ring.sharpness);
        Sector sector;
        LimitPoint point;
        for (std::size_t face = 0; face < spokes.half_edges.size(); ++face) {
            if (face == 0 || (kind > VertexKind::dart && ring.sharpness[face] > 0)) {
                sector = sector_of(ring, kind, face);
                point = limit_of_sector(ring, kind, sector, rule, table);
            }
            limit.normals[spokes.half_edges[face]] = unit_normal(point, ring, sector, face);
        }
        limit.positions[v] = point.position;
    });
    return limit;
}

std::vector<dvec3> limit_positions(const LoopTopology& t, std::span<const dvec3> positions, CreaseRule rule)
{
    std::vector<dvec3> limit(positions.begin(), positions.end());
    each_ring(t, positions, rule, [&](std::uint32_t v, const Spokes&, const LoopRing& ring, const MaskTable& table) {
        limit[v] = limit_position(ring, vertex_kind(ring.sharpness), rule, table);
    });
    return limit;
}

} // namespace limn
