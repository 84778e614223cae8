#include "limn/lines/visibility.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "limn/base/parallel.h"
#include "limn/formulas/formulas.h"
#include "limn/lines/edge_zero.h"
#include "limn/lines/element_test.h"

namespace limn {
namespace {

constexpr std::size_t grain = 256;

float radial_curvature_at(const ViewContext& c, std::uint32_t vertex)
{
    const LineModel& m = c.model;
    const auto terms = formulas::radial_terms(c.view.to_eye(m.positions[vertex]), m.normals[vertex], m.e1[vertex], m.e2[vertex],
                                              m.k1[vertex], m.k2[vertex]);
    return formulas::radial_curvature(terms, m.k1[vertex], m.k2[vertex]);
}

/// Radial curvature where the contour crosses a mesh edge.
float radial_curvature_on_edge(const ViewContext& c, std::uint32_t edge)
{
    if (edge == none || edge >= 3 * c.model.faces.size())
        return 0;
    const uvec3& t = c.model.faces[edge / 3];
    const std::uint32_t i = t[int(edge % 3)], j = t[int((edge + 1) % 3)];
    const EdgeZero zero = edge_zero(i, j, c.facing[i], c.facing[j]);
    return zero.mix(radial_curvature_at(c, zero.from), radial_curvature_at(c, zero.to));
}

/// A crease curves without bound: outwards it can be an outline, inwards it is hidden by the side behind it.
float crease_curvature(const LineModel& model, const Segment& s) { return bends_away(model, s) ? 1e6f : -1e6f; }

/// One (1,2,1)/4 pass over the nodes of a chain; fixed nodes stay.
void smooth(std::vector<float>& nodes, const std::vector<std::uint8_t>& fixed)
{
    const std::size_t n = nodes.size();
    const std::vector<float> old = nodes;
    for (std::size_t i = 0; i < n; ++i)
        if (!fixed[i])
            nodes[i] = 0.25f * (old[(i + n - 1) % n] + old[(i + 1) % n]) + 0.5f * old[i];
}

/// Nodes next to a crease and the ends of an open chain have no two neighbours on one smooth piece.
std::vector<std::uint8_t> fixed_nodes(std::span<const Segment> segments, std::span<const Link> links, bool closed)
{
    const std::size_t n = links.size() + (closed ? 0 : 1);
    std::vector<std::uint8_t> fixed(n, n < 3);
    for (std::size_t i = 0; i < links.size(); ++i)
        if (segments[links[i].segment].along_edge)
            fixed[i] = fixed[(i + 1) % n] = 1;
    if (!closed)
        fixed.front() = fixed.back() = 1;
    return fixed;
}

/// True for lines that lie on the mesh itself, whose rays no chord can mislead.
bool lies_on_edge(VisibilityRule rule, const Segment& s) { return rule == VisibilityRule::edge || s.along_edge; }

/// The size of a pixel at a point, in the model's frame.
float pixel_at(const ViewContext& c, const vec3& p) { return float((c.projector.orthographic ? 1.0 : c.projector.depth(p)) / c.projector.scale); }

/// The length that visibility along a segment is measured in: the mean edge of its face. Faces of flat sides are as large as
/// the side, and say nothing of how far an edge's visibility can be trusted; two pixels are enough against the noise of scans.
float step_of_segment(const ViewContext& c, VisibilityRule rule, const Segment& s)
{
    constexpr float most_pixels = 2;
    const float step = step_of_face(c.model, s.face);
    return lies_on_edge(rule, s) ? std::min(step, most_pixels * pixel_at(c, 0.5f * (s.a + s.b))) : step;
}

/// Where n.v, linear in the segment's face, is zero on it; negative where there is no such place.
float turning_point(const ViewContext& c, const Segment& s)
{
    const float a = facing_in_face(c.model, c.facing, s.face, s.a), b = facing_in_face(c.model, c.facing, s.face, s.b);
    return (a < 0) == (b < 0) ? -1 : a / (a - b);
}

/// Points along the normal of a face, averaged from its corners.
dvec3 normal_sum(const LineModel& model, std::uint32_t face)
{
    const uvec3& t = model.faces[face];
    return dvec3(model.normals[t.x] + model.normals[t.y] + model.normals[t.z]);
}

struct Place {
    float t; ///< from a to b
    bool may_hide, may_appear, cusp;
};

/// Appends the elements of one link.
void split_link(const Segment& s, const Link& link, float step, std::vector<Place>& places, Place start, std::vector<Element>& out)
{
    const float length = glm::distance(s.a, s.b);
    std::sort(places.begin(), places.end(), [](const Place& x, const Place& y) { return x.t < y.t; });
    if (link.reversed)
        std::reverse(places.begin(), places.end());
    places.push_back({link.reversed ? 0.0f : 1.0f, false, false, false});
    float from = link.reversed ? 1.0f : 0.0f;
    for (const Place& place : places) {
        out.push_back({link.segment, from, place.t, std::abs(place.t - from) * length, step, start.may_hide, start.may_appear, start.cusp, true});
        start = place;
        from = place.t;
    }
}

/// The cuts of all segments under occluders, and where those of each segment start.
struct SegmentCuts {
    std::vector<Cut> cuts;
    std::vector<std::uint32_t> start;
};

SegmentCuts find_cuts(const ViewContext& c, std::span<const Segment> segments, const OccluderGrid& occluders)
{
    SegmentCuts found;
    found.start.assign(segments.size() + 1, 0);
    if (occluders.empty())
        return found;
    found.cuts = parallel_collect<Cut>(segments.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<Cut>& out) {
        for (std::size_t i = begin; i < end; ++i)
            occluders.find(std::uint32_t(i), segments[i], c.projector.project(segments[i].a), c.projector.project(segments[i].b), c.projector, out);
    });
    for (const Cut& cut : found.cuts)
        ++found.start[cut.segment + 1];
    std::partial_sum(found.start.begin(), found.start.end(), found.start.begin());
    return found;
}

/// The places at which link l is cut, from a to b.
void find_places(const ViewContext& c, VisibilityRule rule, const Segment& s, const Link& link, std::uint32_t l, const LinkCurvature& curvature,
                 const SegmentCuts& cuts, std::vector<Place>& places)
{
    places.clear();
    for (std::uint32_t k = cuts.start[link.segment]; k < cuts.start[link.segment + 1]; ++k) {
        const Cut& cut = cuts.cuts[k];
        places.push_back(link.reversed ? Place{cut.t, cut.may_appear, cut.may_hide, false} : Place{cut.t, cut.may_hide, cut.may_appear, false});
    }
    if (!curvature.enter.empty() && (curvature.enter[l] < 0) != (curvature.leave[l] < 0)) {
        const float t = curvature.enter[l] / (curvature.enter[l] - curvature.leave[l]);
        places.push_back({link.reversed ? 1 - t : t, true, true, true});
    }
    if (rule == VisibilityRule::surface)
        if (const float t = turning_point(c, s); t > 0 && t < 1)
            places.push_back({t, true, true, true});
}

ChainElements split_chains(const ViewContext& c, VisibilityRule rule, std::span<const Segment> segments, const Chains& chains,
                           const LinkCurvature& curvature, const SegmentCuts& cuts)
{
    ChainElements result;
    std::vector<std::uint32_t> elements_before(chains.links.size() + 1, 0); // per link, once its counts are summed
    result.elements = parallel_collect<Element>(chains.links.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<Element>& out) {
        std::vector<Place> places;
        for (std::size_t l = begin; l < end; ++l) {
            const Link& link = chains.links[l];
            const Segment& s = segments[link.segment];
            const std::size_t before = out.size();
            find_places(c, rule, s, link, std::uint32_t(l), curvature, cuts, places);
            split_link(s, link, step_of_segment(c, rule, s), places, {0, false, false, false}, out);
            elements_before[l + 1] = std::uint32_t(out.size() - before);
        }
    });
    std::partial_sum(elements_before.begin(), elements_before.end(), elements_before.begin());
    result.start.reserve(chains.start.size());
    for (const std::uint32_t link : chains.start)
        result.start.push_back(elements_before[link]);
    return result;
}

/// Viterbi over the two states of each element of a chain: the cheapest sequence of visible and hidden, where an element
/// that contradicts its test costs its length and a change costs its price.
class Decision {
public:
    /// @param cusp  price of a change at a cusp
    Decision(std::span<Element> elements, const ChangePrices& prices, float cusp) : elements_(elements), prices_(prices), cusp_(cusp), from_(elements.size()) {}

    void open() { write(best(run(unary(0, 0), unary(0, 1)))); }

    /// Both start states are tried, and the last element pays for its change to the first.
    void closed()
    {
        Total best_of[2];
        std::vector<From> paths[2];
        for (int first = 0; first < 2; ++first) {
            const float blocked = std::numeric_limits<float>::infinity();
            auto [visible, hidden] = run(first == 0 ? unary(0, 0) : blocked, first == 1 ? unary(0, 1) : blocked);
            best_of[first] = best({visible + change(0, 0, first), hidden + change(0, 1, first)});
            paths[first] = from_;
        }
        const int first = best_of[1].cost < best_of[0].cost;
        from_ = paths[first];
        write(best_of[first]);
    }

private:
    struct From {
        std::uint8_t state[2]; ///< the state before, for each state of this element; 0: visible, 1: hidden
    };
    struct Total {
        float cost;
        int state;
    };
    float unary(std::size_t k, int state) const { return elements_[k].visible == (state == 0) ? 0 : elements_[k].length; }
    /// The price of going from one state to another where element k starts.
    float change(std::size_t k, int from, int to) const
    {
        if (from == to)
            return 0;
        const Element& e = elements_[k];
        return e.step * (e.cusp ? cusp_ : (to == 1 ? e.may_hide : e.may_appear) ? prices_.expected : prices_.other);
    }
    std::pair<float, float> run(float visible, float hidden)
    {
        float cost[2] = {visible, hidden};
        for (std::size_t k = 1; k < elements_.size(); ++k) {
            float next[2];
            for (int to = 0; to < 2; ++to) {
                const float stay = cost[to], move = cost[1 - to] + change(k, 1 - to, to);
                from_[k].state[to] = std::uint8_t(move < stay ? 1 - to : to);
                next[to] = std::min(stay, move) + unary(k, to);
            }
            cost[0] = next[0];
            cost[1] = next[1];
        }
        return {cost[0], cost[1]};
    }
    static Total best(std::pair<float, float> costs) { return costs.second < costs.first ? Total{costs.second, 1} : Total{costs.first, 0}; }
    void write(Total last)
    {
        int state = last.state;
        for (std::size_t k = elements_.size(); k-- > 0;) {
            const int before = k > 0 ? from_[k].state[state] : 0;
            elements_[k].visible = state == 0;
            state = before;
        }
    }
    std::span<Element> elements_;
    ChangePrices prices_;
    float cusp_;
    std::vector<From> from_;
};

/// How far from a contour the mesh may still stand in the way of its own ray, in mean edge lengths h. The contour lies up to
/// k h^2/8 below the surface, which falls away under the ray as kr d^2/2: at most about sqrt(k/kr)/2 h. Measured on tori,
/// twice that is needed on irregular meshes.
float exit_distance(const LineModel& model, const Segment& s, float kr)
{
    constexpr float least = 3, most = 8;
    const float k = std::abs(model.k1[model.faces[s.face].x]);
    return kr > 0 ? std::clamp(std::sqrt(k / kr), least, most) : least;
}

/// An unmarked change has no cut: it lies somewhere between the middles of two elements (where one part runs through
/// another, say). Bisection finds the place, and the element that holds it is split there.
/// @param cuts_are_exact  false: marked changes are searched for as well. Edges are cut under interpolated contours, which the mesh
///                        that hides them only resembles.
template <class Test> ChainElements with_exact_changes(ChainElements decided, const Chains& chains, bool cuts_are_exact, const Test& is_visible)
{
    struct Split {
        std::size_t element;
        float t;
        bool before; ///< visibility of the first part
    };
    std::vector<Split> splits;
    const auto bisect = [&](std::size_t k, float seen, float unseen) { // parameters on element k, in either order
        for (int i = 0; i < 12; ++i) {
            const float middle = 0.5f * (seen + unseen);
            (is_visible(decided.elements[k], middle) ? seen : unseen) = middle;
        }
        return 0.5f * (seen + unseen);
    };
    for (std::size_t chain = 0; chain < chains.size(); ++chain) {
        const std::size_t begin = decided.start[chain], end = decided.start[chain + 1];
        for (std::size_t k = chains.closed[chain] ? begin : begin + 1; k < end; ++k) {
            const std::size_t previous = k == begin ? end - 1 : k - 1;
            const Element &a = decided.elements[previous], &b = decided.elements[k];
            const float a_middle = 0.5f * (a.t0 + a.t1), b_middle = 0.5f * (b.t0 + b.t1);
            if (a.visible == b.visible || (cuts_are_exact && (b.cusp || b.may_hide || b.may_appear)) || is_visible(a, a_middle) != a.visible ||
                is_visible(b, b_middle) != b.visible)
                continue;
            if (is_visible(b, b.t0) == a.visible)
                splits.push_back({k, a.visible ? bisect(k, b.t0, b_middle) : bisect(k, b_middle, b.t0), a.visible});
            else
                splits.push_back({previous, a.visible ? bisect(previous, a_middle, a.t1) : bisect(previous, a.t1, a_middle), a.visible});
        }
    }
    if (splits.empty())
        return decided;
    std::stable_sort(splits.begin(), splits.end(), [](const Split& x, const Split& y) { return x.element < y.element; });
    ChainElements result;
    std::size_t next = 0;
    for (std::size_t chain = 0; chain < chains.size(); ++chain) {
        result.start.push_back(std::uint32_t(result.elements.size()));
        for (std::size_t k = decided.start[chain]; k < decided.start[chain + 1]; ++k) {
            Element rest = decided.elements[k];
            // At most two: one where the element begins, one where it ends.
            for (; next < splits.size() && splits[next].element == k; ++next) {
                Element part = rest;
                part.t1 = splits[next].t;
                part.visible = splits[next].before;
                rest.t0 = splits[next].t;
                rest.visible = !splits[next].before;
                const float whole = std::abs(decided.elements[k].t1 - decided.elements[k].t0);
                part.length = whole > 0 ? decided.elements[k].length * std::abs(part.t1 - part.t0) / whole : 0;
                rest.length -= part.length;
                result.elements.push_back(part);
            }
            result.elements.push_back(rest);
        }
    }
    result.start.push_back(std::uint32_t(result.elements.size()));
    return result;
}

} // namespace

float step_of_face(const LineModel& model, std::uint32_t face)
{
    const uvec3& t = model.faces[face];
    const vec3 &a = model.positions[t.x], &b = model.positions[t.y], &c = model.positions[t.z];
    const float ab = glm::distance(a, b), bc = glm::distance(b, c), ca = glm::distance(c, a);
    const float longest = std::max({ab, bc, ca}), shortest = std::min({ab, bc, ca});
    return longest > 5 * shortest ? longest : (ab + bc + ca) / 3;
}

LinkCurvature curvature_along_contours(const ViewContext& c, std::span<const Segment> segments, const Chains& chains)
{
    LinkCurvature result;
    if (!c.model.has_curvature())
        return result;
    result.enter.resize(chains.links.size());
    result.leave.resize(chains.links.size());
    const auto at = [&](const Link& link, bool enter) {
        const Segment& s = segments[link.segment];
        return s.along_edge ? 0 : radial_curvature_on_edge(c, enter != link.reversed ? s.edge_a : s.edge_b);
    };
    parallel_each(chains.links.size(), grain, [&](std::size_t l) { result.enter[l] = at(chains.links[l], true); });
    parallel_each(chains.size(), 1, [&](std::size_t chain) {
        const std::uint32_t begin = chains.start[chain], end = chains.start[chain + 1];
        std::vector<float> nodes(result.enter.begin() + begin, result.enter.begin() + end);
        if (!chains.closed[chain])
            nodes.push_back(at(chains.links[end - 1], false));
        // Where a smooth piece meets a crease, the node belongs to the smooth piece.
        for (std::uint32_t l = begin; l + 1 < end; ++l)
            if (segments[chains.links[l + 1].segment].along_edge)
                nodes[l + 1 - begin] = at(chains.links[l], false);
        const std::vector<std::uint8_t> fixed = fixed_nodes(segments, chains[chain], chains.closed[chain]);
        smooth(nodes, fixed);
        smooth(nodes, fixed);
        for (std::uint32_t l = begin; l < end; ++l) {
            const Segment& s = segments[chains.links[l].segment];
            result.enter[l] = s.along_edge ? crease_curvature(c.model, s) : nodes[l - begin];
            result.leave[l] = s.along_edge ? result.enter[l] : nodes[(l - begin + 1) % nodes.size()];
        }
    });
    return result;
}

std::vector<Occluder> occluders_of_contours(const ViewContext& c, std::span<const Segment> segments, const Chains& chains,
                                            const LinkCurvature& curvature)
{
    const auto collect = [&](std::size_t begin, std::size_t end, std::vector<Occluder>& out) {
        for (std::size_t l = begin; l < end; ++l) {
            if (!curvature.enter.empty() && curvature.enter[l] + curvature.leave[l] < 0)
                continue;
            const Segment& s = segments[chains.links[l].segment];
            const dvec3 normal = normal_sum(c.model, s.face) + (s.other == none ? dvec3(0) : normal_sum(c.model, s.other));
            const dvec2 outward = {glm::dot(normal, c.projector.right), -glm::dot(normal, c.projector.above)};
            out.push_back({c.projector.project(s.a), c.projector.project(s.b), outward, s.edge_a, s.edge_b});
        }
    };
    return parallel_collect<Occluder>(chains.links.size(), 1024, collect);
}

ChainElements find_visibility(const ViewContext& c, VisibilityRule rule, std::span<const Segment> segments, const Chains& chains,
                              const LinkCurvature& curvature, const OccluderGrid& occluders, const ChangePrices& prices)
{
    ChainElements result = split_chains(c, rule, segments, chains, curvature, find_cuts(c, segments, occluders));
    // The curvature of a link, found again from an element by its segment.
    std::vector<std::uint32_t> link_of(curvature.enter.empty() ? 0 : segments.size());
    for (std::uint32_t l = 0; l < chains.links.size() && !link_of.empty(); ++l)
        link_of[chains.links[l].segment] = l;
    const auto is_visible = [&](const Element& e, float t) {
        const Segment& s = segments[e.segment];
        float exit = 3;
        bool from_within = false;
        if (!link_of.empty()) {
            const std::uint32_t l = link_of[e.segment];
            const float along = chains.links[l].reversed ? 1 - t : t;
            const float kr = glm::mix(curvature.enter[l], curvature.leave[l], along);
            // Nearly flat: the sign is noise, only the ray decides.
            from_within = kr < 0 && -kr * e.step >= 1e-4f;
            // The surface in front of such a point hides it, unless the shell has a hole through which its inside is seen.
            if (from_within && !c.model.is_open(s.face))
                return false;
            exit = exit_distance(c.model, s, from_within ? -kr : kr);
        }
        const vec3 p = glm::mix(s.a, s.b, t);
        return lies_on_edge(rule, s) ? is_edge_point_visible(c, s, p, e.step) : is_surface_point_visible(c, rule, s, p, e.step, exit, from_within);
    };
    parallel_each(result.elements.size(), grain, [&](std::size_t k) {
        Element& e = result.elements[k];
        e.visible = is_visible(e, 0.5f * (e.t0 + e.t1));
    });
    parallel_each(chains.size(), 1, [&](std::size_t chain) {
        const std::span<Element> elements(result.elements.data() + result.start[chain], result.elements.data() + result.start[chain + 1]);
        Decision decision(elements, prices, rule == VisibilityRule::surface ? prices.turn : prices.expected);
        chains.closed[chain] ? decision.closed() : decision.open();
    });
    return with_exact_changes(std::move(result), chains, rule != VisibilityRule::edge, is_visible);
}

} // namespace limn
