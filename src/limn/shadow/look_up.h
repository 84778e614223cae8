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

/// The other end of a query from a known place.
struct ShadowEnd {
    vec4 to = vec4(0, 0, 0, 1); ///< as in ShadowQuery
    vec2 among = vec2(0.5f);    ///< as in ShadowQuery
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
            batch(std::min(together, queries.size() - first), [&](std::size_t i) { return queries[first + i]; }, false, verdicts.data() + first);
    }
    /// The same for one place and many ends. From a place in the object's sphere those that lie in the direction of one map are looked up once.
    /// @param verdicts  as many as ends
    void at(const vec3& from, std::span<const ShadowEnd> ends, std::span<Verdict> verdicts) const
    {
        const bool inside = glm::dot(from, from) < 1.0f;
        for (std::size_t first = 0; first < ends.size(); first += together) {
            const auto query = [&](std::size_t i) { return ShadowQuery{from, ends[first + i].to, ends[first + i].among}; };
            batch(std::min(together, ends.size() - first), query, inside, verdicts.data() + first);
        }
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

    /// Numbers the different cells of a few, from 0 on.
    class CellNumbers {
    public:
        CellNumbers() { cells_.fill(none); }
        /// @param next  the number of a cell that is new
        std::uint8_t number(std::uint32_t cell, std::size_t next)
        {
            std::size_t slot = (cell * 0x9E3779B1u) >> 25;
            while (cells_[slot] != none && cells_[slot] != cell)
                slot = (slot + 1) % cells_.size();
            if (cells_[slot] == none)
                cells_[slot] = cell, numbers_[slot] = std::uint8_t(next);
            return numbers_[slot];
        }

    private:
        static constexpr std::uint32_t none = 0xFFFFFFFFu; // more than a grid has
        std::array<std::uint32_t, 2 * together> cells_;
        std::array<std::uint8_t, 2 * together> numbers_;
    };

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

    /// @param query   of a number below `size`, at most `together`
    /// @param shared  whether all are from one place in the sphere: then those that see no end in it share an answer where they lie in one cell
    template <class Query> void batch(std::size_t size, Query&& query, bool shared, Verdict* verdicts) const
    {
        CellNumbers numbers;
        std::array<MapPlace, together> places;
        std::array<MapProbe, together> probes;
        std::array<std::uint8_t, together> asked, number;
        std::size_t count = 0, answers = 0;
        for (std::size_t i = 0; i < size; ++i) {
            verdicts[i] = Verdict::lit;
            const ShadowQuery at = query(i);
            const ShadowLine line = formulas::shadow_line(at.from, at.to);
            if (line.kind == formulas::LINE_FREE)
                continue;
            const ivec2 cell = cell_of(line, at.among);
            if (shared && line.reach < 0) {
                const std::uint8_t known = numbers.number(std::uint32_t(cell.y) * std::uint32_t(layout_.grid.cells.x) + std::uint32_t(cell.x), count);
                if (known < count) {
                    asked[answers] = std::uint8_t(i), number[answers++] = known;
                    continue;
                }
            }
            probes[count] = probe(line, cell);
            places[count] = {formulas::texel_at(probes[count].place, layout_.size), rank(cell)};
            if (places[count].texel == formulas::NO_TEXEL)
                places[count].texel = 0, probes[count].depth = -1; // nearer than all surfaces: lit
            asked[answers] = std::uint8_t(i), number[answers++] = std::uint8_t(count++);
        }
        std::array<float, together> depths;
        read_depths(*depths_, std::span(places.data(), count), depths.data());
        for (std::size_t k = 0; k < answers; ++k)
            verdicts[asked[k]] = Verdict(formulas::shadow_verdict(probes[number[k]], depths[number[k]]));
    }

    MapLayout layout_;
    const Depths* depths_;
    std::vector<MapFrame> frames_; ///< by cell, row by row
};

} // namespace limn
