#pragma once

#include "limn/subdivision/loop_topology.h"

namespace limn {

/// Walks around a vertex in the order of its Spokes without memory for them: calls f(neighbour) for each, and stops where f returns false.
/// @param vertex  has faces and no border
/// @return whether the walk came round
template <class F> bool walk_around(const LoopTopology& t, std::uint32_t vertex, F&& f)
{
    const std::uint32_t first = t.leaving[vertex];
    std::uint32_t h = first;
    do {
        const std::uint32_t face = h / 3, corner = h - 3 * face;
        const uvec3& triangle = t.triangles[face];
        if (!f(corner == 0 ? triangle.y : corner == 1 ? triangle.z : triangle.x))
            return false;
        h = t.twin[corner == 0 ? h + 2 : h - 1];
    } while (h != first);
    return true;
}

/// The neighbours of the start of h, counter-clockwise from h's end. @return whether they are six, all around, with no sharp edge
inline bool six_around(const LoopTopology& t, std::uint32_t h, std::uint32_t (&ring)[6])
{
    std::uint32_t at = h;
    for (std::uint32_t& neighbour : ring) {
        if (t.sharpness[t.edge[at]] > 0)
            return false;
        neighbour = t.end(at);
        at = t.twin[next_half_edge(next_half_edge(at))];
        if (at == none || (at == h) != (&neighbour == &ring[5])) // all around before the sixth, or not even then
            return false;
    }
    return true;
}

} // namespace limn
