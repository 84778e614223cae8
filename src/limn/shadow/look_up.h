#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "limn/base/parallel.h"
#include "limn/shadow/map_order.h"
#include "limn/shadow/read_depths.h"

namespace limn {

using formulas::MapProbe;
using formulas::ShadowLine;

/// How the maps of an object lie.
struct MapLayout {
    DirectionGrid grid;
    MapOrder order = MapOrder::theta_zigzag;
    int size = 128; ///< texels along a side of a map
};

enum class Verdict : std::uint8_t {
    lit = formulas::SHADOW_LIT,   ///< the object is not between the places
    dark = formulas::SHADOW_DARK, ///< it is
    unknown = formulas::SHADOW_UNKNOWN, ///< both places are in the object's sphere, and one depth cannot tell: take a ray
};

/// Two places in the unit space of an object, between which it may stand.
struct ShadowQuery {
    vec3 from = vec3(0);
    vec4 to = vec4(0, 0, 0, 1); ///< a place and 1, or a direction of any length towards a light at infinity and 0
    vec2 among = vec2(0.5f);    ///< which of the four nearest maps (formulas::cell_for); the middle takes the nearest
};

/// Of which texels the answers of a look-up are the mean, each as light or dark.
enum class MapTaps : std::uint8_t {
    one,            ///< the nearest texel of the nearest map
    four,           ///< 2 x 2 texels of it
    sixteen,        ///< 4 x 4 texels of it
    four_maps,      ///< the nearest texel of the four nearest maps
    four_maps_four, ///< 2 x 2 texels of each of them
};

/// Looks up whether an object is between two places (formulas/shadow_lookup.glsl; the coherent shadow map specification, 2.8, 2.11, 6.4). A line that misses
/// the object's sphere, ends before it, or falls outside the map is lit. Safe to use from many threads.
/// @tparam Depths  a depth source: `float depth(std::size_t texel, std::uint32_t rank) const`, no_surface where nothing is
template <class Depths> class LookUp {
public:
    /// @param depths  has to outlive this
    LookUp(const MapLayout& layout, const Depths& depths) : layout_(layout), depths_(&depths)
    {
        const ivec2 cells = layout.grid.cells;
        frames_.reserve(layout.grid.count());
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x)
                frames_.push_back(layout.grid.frame({x, y}));
    }
    const MapLayout& layout() const { return layout_; }

    Verdict at(const ShadowQuery& query) const
    {
        const ShadowLine line = formulas::shadow_line(query.from, query.to);
        return line.kind == formulas::LINE_FREE ? Verdict::lit : verdict_in(line, cell_of(line, query.among));
    }

    /// Many at once: several times as fast as one after the other, since memory is waited for together.
    /// @param verdicts  as many
    void at(std::span<const ShadowQuery> queries, std::span<Verdict> verdicts) const
    {
        for (std::size_t first = 0; first < queries.size(); first += together)
            batch(queries.subspan(first, std::min(together, queries.size() - first)), verdicts.data() + first);
    }
    /// The same in parallel.
    void at_in_parallel(std::span<const ShadowQuery> queries, std::span<Verdict> verdicts) const
    {
        parallel_blocks(queries.size(), 64 * together, [&](std::size_t begin, std::size_t end) { at(queries.subspan(begin, end - begin), verdicts.subspan(begin, end - begin)); });
    }

    /// The part of some texels that says light, in [0, 1]; nothing where one of them cannot tell.
    std::optional<float> lit_share(const ShadowQuery& query, MapTaps taps) const
    {
        const ShadowLine line = formulas::shadow_line(query.from, query.to);
        if (line.kind == formulas::LINE_FREE)
            return 1.0f;
        if (taps != MapTaps::four_maps && taps != MapTaps::four_maps_four)
            return share_in_map(line, cell_of(line, query.among), taps == MapTaps::one ? 1 : taps == MapTaps::four ? 2 : 4);
        const vec2 corner = glm::fract(formulas::place_of_direction(int(layout_.grid.spread), line.direction) * vec2(layout_.grid.cells) - 0.5f);
        float sum = 0;
        for (int k = 0; k < 4; ++k) {
            const vec2 side(float(k & 1), float(k >> 1)), weight = glm::mix(1.0f - corner, corner, side);
            const std::optional<float> share = share_in_map(line, cell_of(line, side), taps == MapTaps::four_maps ? 1 : 2);
            if (!share)
                return std::nullopt;
            sum += weight.x * weight.y * *share;
        }
        return sum;
    }

private:
    static constexpr std::size_t together = 64;

    ivec2 cell_of(const ShadowLine& line, const vec2& among) const
    {
        return formulas::cell_for(int(layout_.grid.spread), layout_.grid.cells, line.direction, among);
    }
    MapProbe probe(const ShadowLine& line, const ivec2& cell) const
    {
        return formulas::map_probe(frames_[std::size_t(cell.y) * std::size_t(layout_.grid.cells.x) + std::size_t(cell.x)], layout_.size, line);
    }
    std::uint32_t rank(const ivec2& cell) const { return formulas::rank_of_cell(int(layout_.order), layout_.grid.cells, cell); }

    Verdict verdict_in(const ShadowLine& line, const ivec2& cell) const
    {
        const MapProbe at = probe(line, cell);
        const std::uint32_t texel = formulas::texel_at(at.place, layout_.size);
        return texel == formulas::NO_TEXEL ? Verdict::lit : Verdict(formulas::shadow_verdict(at, depths_->depth(texel, rank(cell))));
    }

    std::optional<float> share_in_map(const ShadowLine& line, const ivec2& cell, int side) const
    {
        const MapProbe at = probe(line, cell);
        const vec2 first = glm::floor(at.place - 0.5f * float(side - 1));
        int lit = 0;
        for (int k = 0; k < side * side; ++k) {
            const std::uint32_t texel = formulas::texel_at(first + vec2(float(k % side), float(k / side)), layout_.size);
            const Verdict verdict = texel == formulas::NO_TEXEL ? Verdict::lit : Verdict(formulas::shadow_verdict(at, depths_->depth(texel, rank(cell))));
            if (verdict == Verdict::unknown)
                return std::nullopt;
            lit += verdict == Verdict::lit;
        }
        return float(lit) / float(side * side);
    }

    void batch(std::span<const ShadowQuery> queries, Verdict* verdicts) const
    {
        std::array<MapPlace, together> places;
        std::array<MapProbe, together> probes;
        std::array<std::uint32_t, together> asked;
        std::size_t count = 0;
        for (std::size_t i = 0; i < queries.size(); ++i) {
            verdicts[i] = Verdict::lit;
            const ShadowLine line = formulas::shadow_line(queries[i].from, queries[i].to);
            if (line.kind == formulas::LINE_FREE)
                continue;
            const ivec2 cell = cell_of(line, queries[i].among);
            probes[count] = probe(line, cell);
            places[count].texel = formulas::texel_at(probes[count].place, layout_.size);
            places[count].rank = rank(cell);
            asked[count] = std::uint32_t(i);
            count += places[count].texel != formulas::NO_TEXEL;
        }
        std::array<float, together> depths;
        read_depths(*depths_, std::span(places.data(), count), depths.data());
        for (std::size_t k = 0; k < count; ++k)
            verdicts[asked[k]] = Verdict(formulas::shadow_verdict(probes[k], depths[k]));
    }

    MapLayout layout_;
    const Depths* depths_;
    std::vector<MapFrame> frames_; ///< by cell, row by row
};

} // namespace limn
