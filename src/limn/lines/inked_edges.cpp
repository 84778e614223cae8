#include "limn/lines/inked_edges.h"

#include <algorithm>

namespace limn {
namespace {

/// Parts of edges shorter than this part of the edge come from rounding.
constexpr float least = 1e-5f;

/// The edge between the two faces of a segment, by the smaller of its half-edges; `none` at a border, where more than two faces
/// meet, and between faces that share more than one edge.
std::uint32_t shared_edge(const LineModel& model, const Segment& s)
{
    std::uint32_t edge = none;
    if (s.other == none)
        return none;
    for (std::uint32_t h = 3 * s.face; h < 3 * s.face + 3; ++h) {
        const std::uint32_t twin = model.solid().twin[h];
        if (twin == none || twin / 3 != s.other)
            continue;
        if (edge != none)
            return none;
        edge = std::min(h, twin);
    }
    return edge;
}

/// Where a point of an edge lies along its half-edge.
float place_on_edge(const LineModel& model, std::uint32_t half_edge, const vec3& p)
{
    const uvec3& t = model.faces[half_edge / 3];
    const dvec3 start = model.positions[t[int(half_edge % 3)]], along = dvec3(model.positions[t[int((half_edge + 1) % 3)]]) - start;
    const double squared = glm::dot(along, along);
    return squared > 0 ? float(glm::dot(dvec3(p) - start, along) / squared) : 0;
}

/// Where along its edge an element begins and ends, in the element's direction.
struct ElementPlace {
    float from, to;
};

ElementPlace place_of(const LineModel& model, std::uint32_t edge, const Segment& s, const Element& e)
{
    const float a = place_on_edge(model, edge, s.a), b = place_on_edge(model, edge, s.b);
    return {glm::mix(a, b, e.t0), glm::mix(a, b, e.t1)};
}

std::span<const InkedPart> parts_of(std::span<const InkedPart> inked, std::uint32_t edge)
{
    const auto [begin, end] = std::equal_range(inked.begin(), inked.end(), InkedPart{edge, 0, 0, false},
                                               [](const InkedPart& x, const InkedPart& y) { return x.edge < y.edge; });
    return {begin, end};
}

bool is_inked(std::span<const InkedPart> parts, float place, bool visible)
{
    return std::any_of(parts.begin(), parts.end(),
                       [&](const InkedPart& part) { return part.from <= place && place <= part.to && (part.visible || !visible); });
}

/// Where an element is cut, from its start (0) to its end (1), both among them.
std::vector<float> cuts_under(std::span<const InkedPart> parts, const ElementPlace& at)
{
    std::vector<float> cuts = {0, 1};
    for (const InkedPart& part : parts)
        for (const float end : {part.from, part.to})
            if (const float t = (end - at.from) / (at.to - at.from); t > least && t < 1 - least)
                cuts.push_back(t);
    std::sort(cuts.begin(), cuts.end());
    return cuts;
}

void append_marked(std::span<const InkedPart> parts, const ElementPlace& at, const Element& whole, std::vector<Element>& out)
{
    const std::vector<float> cuts = cuts_under(parts, at);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
        Element part = whole;
        if (cuts[k] > 0)
            part.t0 = glm::mix(whole.t0, whole.t1, cuts[k]);
        if (cuts[k + 1] < 1)
            part.t1 = glm::mix(whole.t0, whole.t1, cuts[k + 1]);
        part.length = whole.length * (cuts[k + 1] - cuts[k]);
        part.inked = is_inked(parts, glm::mix(at.from, at.to, 0.5f * (cuts[k] + cuts[k + 1])), whole.visible);
        out.push_back(part);
    }
}

} // namespace

std::vector<InkedPart> find_inked_parts(const LineModel& model, std::span<const Segment> contours, const ChainElements& decided)
{
    std::vector<InkedPart> parts;
    for (const Element& e : decided.elements) {
        const Segment& s = contours[e.segment];
        if (!s.along_edge)
            continue;
        if (const std::uint32_t edge = shared_edge(model, s); edge != none) {
            const ElementPlace at = place_of(model, edge, s, e);
            parts.push_back({edge, std::min(at.from, at.to), std::max(at.from, at.to), e.visible});
        }
    }
    std::sort(parts.begin(), parts.end(), [](const InkedPart& x, const InkedPart& y) { return x.edge != y.edge ? x.edge < y.edge : x.from < y.from; });
    return parts;
}

void mark_inked(const LineModel& model, std::span<const InkedPart> inked, std::span<const Segment> segments, ChainElements& decided)
{
    if (inked.empty())
        return;
    ChainElements marked;
    for (std::size_t chain = 0; chain + 1 < decided.start.size(); ++chain) {
        marked.start.push_back(std::uint32_t(marked.elements.size()));
        for (std::size_t k = decided.start[chain]; k < decided.start[chain + 1]; ++k) {
            const Element& e = decided.elements[k];
            const Segment& s = segments[e.segment];
            const std::uint32_t edge = shared_edge(model, s);
            const std::span<const InkedPart> parts = edge == none ? std::span<const InkedPart>() : parts_of(inked, edge);
            if (parts.empty())
                marked.elements.push_back(e);
            else
                append_marked(parts, place_of(model, edge, s, e), e, marked.elements);
        }
    }
    marked.start.push_back(std::uint32_t(marked.elements.size()));
    decided = std::move(marked);
}

} // namespace limn
