#pragma once

#include "limn/shadow/look_up.h"

namespace limn {

/// Looks up as the seed does: the nearest map, and in it the texel and depth of the place itself, also where that is outside the sphere, so that what the
/// direction of a map is off by grows with the distance (the coherent shadow map specification, 6.4). To compare with; LookUp is for use.
/// @tparam Depths  as LookUp's
template <class Depths> class PlaceLookUp {
public:
    /// @param depths  has to outlive this
    PlaceLookUp(const MapLayout& layout, const Depths& depths) : layout_(layout), depths_(&depths) {}

    Verdict at(const ShadowQuery& query) const
    {
        ShadowLine line = formulas::shadow_line(query.from, query.to);
        if (line.kind == formulas::LINE_FREE)
            return Verdict::lit;
        line.kind = formulas::LINE_FROM, line.from = query.from;
        const ivec2 cell = layout_.grid.cell_of(line.direction);
        const MapProbe probe = formulas::map_probe(layout_.grid.frame(cell), layout_.size, line);
        const std::uint32_t texel = formulas::texel_at(probe.place, layout_.size);
        return texel == formulas::NO_TEXEL ? Verdict::lit : Verdict(formulas::shadow_verdict(probe, depths_->depth(texel, rank_of(layout_.order, layout_.grid.cells, cell))));
    }
    void at(std::span<const ShadowQuery> queries, std::span<Verdict> verdicts) const
    {
        for (std::size_t i = 0; i < queries.size(); ++i)
            verdicts[i] = at(queries[i]);
    }

private:
    MapLayout layout_;
    const Depths* depths_;
};

} // namespace limn
