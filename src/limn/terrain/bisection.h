#pragma once

#include <cstdint>
#include <vector>

#include "limn/base/parallel.h"
#include "limn/terrain/lattice.h"

namespace limn {

/// Appends the leaves below a triangle, in the order of the hierarchy. Nothing outside the map is kept.
/// @param is_split  of a triangle that can be split, whether it is; the same for both triangles of a hypotenuse
template <class Test> void append_leaves(const Lattice& lattice, const BisectionTriangle& t, const Test& is_split, std::vector<BisectionTriangle>& out)
{
    if (lattice.is_outside_in_part(t) && !lattice.is_inside_in_part(t))
        return;
    if (!t.can_split() || !is_split(t)) {
        out.push_back(t);
        return;
    }
    append_leaves(lattice, t.left(), is_split, out);
    append_leaves(lattice, t.right(), is_split, out);
}

/// The leaves of the whole hierarchy, found in parallel, in its order.
template <class Test> std::vector<BisectionTriangle> find_leaves(const Lattice& lattice, const Test& is_split)
{
    constexpr std::size_t enough = 256;
    std::vector<BisectionTriangle> tops = root_triangles(lattice);
    for (bool growing = true; growing && tops.size() < enough;) {
        growing = false;
        std::vector<BisectionTriangle> finer;
        for (const BisectionTriangle& t : tops) {
            const bool split = t.can_split() && is_split(t);
            growing = growing || split;
            if (split)
                finer.insert(finer.end(), {t.left(), t.right()});
            else
                finer.push_back(t);
        }
        tops = std::move(finer);
    }
    return parallel_collect<BisectionTriangle>(tops.size(), 1, [&](std::size_t begin, std::size_t end, std::vector<BisectionTriangle>& out) {
        for (std::size_t i = begin; i < end; ++i)
            append_leaves(lattice, tops[i], is_split, out);
    });
}

} // namespace limn
