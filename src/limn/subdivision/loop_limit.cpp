#include "limn/subdivision/loop_limit.h"

#include <algorithm>
#include <array>
#include <optional>

#include "limn/base/parallel.h"
#include "limn/subdivision/loop_limit_masks.h"
#include "limn/subdivision/loop_ring.h"
#include "limn/subdivision/loop_walk.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1024;

/// The limit masks of smooth vertices of common valences, and one of their rings, without memory that must be asked for.
class SmoothLimits {
public:
    static constexpr std::size_t most = 12; ///< edges around a vertex

    struct Ring {
        std::array<std::uint32_t, most> neighbours = {};
        std::size_t size = 0;
        operator std::span<const std::uint32_t>() const { return {neighbours.data(), size}; }
    };
    struct Masks {
        double self = 0, each = 0;                ///< position
        std::array<double, most> u = {}, v = {}; ///< tangents
    };

    SmoothLimits()
    {
        for (std::size_t n = 2; n <= most; ++n) {
            const LimitMasks masks = smooth_limit_masks(n);
            masks_[n].self = masks.position.self;
            masks_[n].each = masks.position.points[0];
            std::copy(masks.u.points.begin(), masks.u.points.end(), masks_[n].u.begin());
            std::copy(masks.v.points.begin(), masks.v.points.end(), masks_[n].v.begin());
        }
    }
    const Masks& of(std::size_t valence) const { return masks_[valence]; }

    /// In the order of Spokes. @param vertex  has faces, and no sharp edge or border
    /// @return false where there are more than `most`
    static bool fill(const LoopTopology& t, std::uint32_t vertex, Ring& ring)
    {
        ring.size = 0;
        return walk_around(t, vertex, [&](std::uint32_t neighbour) {
            if (ring.size == most)
                return false;
            ring.neighbours[ring.size++] = neighbour;
            return true;
        });
    }

private:
    std::array<Masks, most + 1> masks_;
};

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

constexpr double parallel = 1e-12; ///< sine of an angle

/// Whether u x v tells the direction of a normal.
bool has_direction(const dvec3& normal, const dvec3& u, const dvec3& v)
{
    return glm::dot(normal, normal) > parallel * parallel * glm::dot(u, u) * glm::dot(v, v);
}

/// The first of these that has a direction, as a unit vector.
dvec3 unit_normal(const LimitPoint& point, const LoopRing& ring, const Sector& sector, std::size_t face)
{
    const dvec3 normal = glm::cross(point.u, point.v);
    if (has_direction(normal, point.u, point.v))
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

/// The masks that some vertices need.
MaskTable make_table(const LoopTopology& t, CreaseRule rule, std::span<const std::uint32_t> vertices)
{
    std::vector<std::size_t> valences[2];
    Spokes spokes;
    for (const std::uint32_t v : vertices) {
        t.gather(v, spokes);
        const VertexKind kind = settled_kind(spokes);
        if (kind > VertexKind::dart)
            continue;
        std::vector<std::size_t>& seen = valences[kind == VertexKind::dart];
        if (std::find(seen.begin(), seen.end(), spokes.size()) == seen.end())
            seen.push_back(spokes.size());
    }
    return MaskTable(rule, valences[0], valences[1]);
}

/// Calls f(vertex, ring) for the vertices with faces that are smooth, as is all that their limits depend on; parallel.
/// @param f  returns false where it leaves the vertex to be treated as one of the others
/// @return   the other vertices with faces
template <class F> std::vector<std::uint32_t> each_smooth_ring(const LoopTopology& t, CreaseRule rule, F&& f)
{
    const std::vector<std::uint8_t> creased = creased_vertices(t);
    const auto is_smooth = [&](std::uint32_t v, SmoothLimits::Ring& ring) {
        if (creased[v] != 0 || !SmoothLimits::fill(t, v, ring))
            return false;
        return rule != CreaseRule::biermann ||
               std::none_of(ring.neighbours.begin(), ring.neighbours.begin() + std::ptrdiff_t(ring.size), [&](std::uint32_t n) { return creased[n] != 0; });
    };
    return parallel_collect<std::uint32_t>(t.vertex_count(), grain, [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& others) {
        SmoothLimits::Ring ring;
        for (std::uint32_t v = std::uint32_t(begin); v < end; ++v)
            if (t.leaving[v] != none && !(is_smooth(v, ring) && f(v, ring)))
                others.push_back(v);
    });
}

/// Calls f(vertex, spokes, settled ring, masks) for some vertices with faces; parallel.
template <class F> void each_ring(const LoopTopology& t, std::span<const dvec3> positions, CreaseRule rule, std::span<const std::uint32_t> vertices, F&& f)
{
    const MaskTable table = make_table(t, rule, vertices);
    parallel_blocks(vertices.size(), grain, [&](std::size_t begin, std::size_t end) {
        Spokes spokes;
        for (const std::uint32_t v : vertices.subspan(begin, end - begin)) {
            t.gather(v, spokes);
            f(v, spokes, settled_ring(t, spokes, positions, v, rule), table);
        }
    });
}

dvec3 smooth_limit_position(const SmoothLimits::Masks& masks, std::span<const std::uint32_t> ring, std::span<const dvec3> p, std::uint32_t v)
{
    dvec3 sum = masks.self * p[v];
    for (const std::uint32_t neighbour : ring)
        sum += masks.each * p[neighbour];
    return sum;
}

/// u x v, where that has a direction.
std::optional<dvec3> smooth_limit_normal(const SmoothLimits::Masks& masks, std::span<const std::uint32_t> ring, std::span<const dvec3> p)
{
    dvec3 u(0), v(0);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const dvec3& neighbour = p[ring[i]];
        u += masks.u[i] * neighbour;
        v += masks.v[i] * neighbour;
    }
    const dvec3 normal = glm::cross(u, v);
    return has_direction(normal, u, v) ? std::optional(glm::normalize(normal)) : std::nullopt;
}

/// @return false, and nothing is set, where u x v has no direction
bool set_smooth_limit(const SmoothLimits::Masks& masks, std::span<const std::uint32_t> ring, std::span<const dvec3> p, std::uint32_t v, LimitSurface& limit)
{
    const std::optional<dvec3> normal = smooth_limit_normal(masks, ring, p);
    if (!normal)
        return false;
    limit.positions[v] = smooth_limit_position(masks, ring, p, v);
    limit.vertex_normals[v] = *normal;
    return true;
}

void resize(const LoopTopology& t, std::span<const dvec3> positions, LimitSurface& limit)
{
    limit.positions.assign(positions.begin(), positions.end());
    limit.vertex_normals.resize(positions.size());
    limit.normals.resize(t.twin.size());
}

/// Gives every corner its vertex's normal, and sets all of the other vertices.
void finish(const LoopTopology& t, std::span<const dvec3> positions, CreaseRule rule, std::span<const std::uint32_t> others, LimitSurface& limit)
{
    parallel_each(t.triangles.size(), grain, [&](std::size_t f) {
        const uvec3& corners = t.triangles[f];
        limit.normals[3 * f] = limit.vertex_normals[corners.x];
        limit.normals[3 * f + 1] = limit.vertex_normals[corners.y];
        limit.normals[3 * f + 2] = limit.vertex_normals[corners.z];
    });
    each_ring(t, positions, rule, others, [&](std::uint32_t v, const Spokes& spokes, const LoopRing& ring, const MaskTable& table) {
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
        limit.vertex_normals[v] = limit.normals[spokes.half_edges[0]];
    });
    parallel_each(t.vertex_count(), grain, [&](std::size_t v) {
        if (t.leaving[v] == none)
            limit.vertex_normals[v] = dvec3(0);
    });
}

} // namespace

LimitPoint limit_point(const LoopTopology& t, std::span<const dvec3> positions, std::uint32_t half_edge, CreaseRule rule)
{
    const std::uint32_t vertex = t.start(half_edge);
    const Spokes spokes = t.gather(vertex);
    const auto face = std::find(spokes.half_edges.begin(), spokes.half_edges.end(), half_edge) - spokes.half_edges.begin();
    const MaskTable table = make_table(t, rule, {&vertex, 1});
    const LoopRing ring = settled_ring(t, spokes, positions, vertex, rule);
    const VertexKind kind = vertex_kind(ring.sharpness);
    const Sector sector = sector_of(ring, kind, std::size_t(face));
    LimitPoint point = limit_of_sector(ring, kind, sector, rule, table);
    point.normal = unit_normal(point, ring, sector, std::size_t(face));
    return point;
}

void limit_surface(const LoopTopology& t, std::span<const dvec3> positions, CreaseRule rule, LimitSurface& limit)
{
    resize(t, positions, limit);
    const SmoothLimits smooth;
    const std::vector<std::uint32_t> others = each_smooth_ring(t, rule, [&](std::uint32_t v, const SmoothLimits::Ring& ring) {
        return set_smooth_limit(smooth.of(ring.size), ring, positions, v, limit);
    });
    finish(t, positions, rule, others, limit);
}

LimitStep::LimitStep(const LoopTopology& t, CreaseRule rule) : rule_(rule), rings_(t.vertex_count(), {none})
{
    each_smooth_ring(t, rule, [&](std::uint32_t v, const SmoothLimits::Ring& ring) {
        if (ring.size == 6)
            std::copy_n(ring.neighbours.begin(), 6, rings_[v].begin());
        return true;
    });
}

void LimitStep::apply(const LoopTopology& t, std::span<const dvec3> positions, LimitSurface& limit) const
{
    resize(t, positions, limit);
    const SmoothLimits smooth;
    const SmoothLimits::Masks& masks = smooth.of(6);
    const std::vector<std::uint32_t> others = parallel_collect<std::uint32_t>(rings_.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& out) {
        for (std::uint32_t v = std::uint32_t(begin); v < end; ++v) {
            const bool is_set = rings_[v][0] != none && set_smooth_limit(masks, rings_[v], positions, v, limit);
            if (!is_set && t.leaving[v] != none)
                out.push_back(v);
        }
    });
    finish(t, positions, rule_, others, limit);
}

LimitSurface limit_surface(const LoopTopology& t, std::span<const dvec3> positions, CreaseRule rule)
{
    LimitSurface limit;
    limit_surface(t, positions, rule, limit);
    return limit;
}

std::vector<dvec3> limit_positions(const LoopTopology& t, std::span<const dvec3> positions, CreaseRule rule)
{
    std::vector<dvec3> limit(positions.begin(), positions.end());
    const SmoothLimits smooth;
    const std::vector<std::uint32_t> others = each_smooth_ring(t, rule, [&](std::uint32_t v, const SmoothLimits::Ring& ring) {
        limit[v] = smooth_limit_position(smooth.of(ring.size), ring, positions, v);
        return true;
    });
    each_ring(t, positions, rule, others, [&](std::uint32_t v, const Spokes&, const LoopRing& ring, const MaskTable& table) {
        limit[v] = limit_position(ring, vertex_kind(ring.sharpness), rule, table);
    });
    return limit;
}

} // namespace limn
