#include "limn/subdivision/loop_masks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limn {
namespace {

constexpr double pi = std::numbers::pi;

/// How many triangles the sector of a vertex has in which a smooth edge lies. The vertex has two sharp edges or more.
std::size_t triangles_of_sector(std::span<const float> spokes, std::size_t at)
{
    const std::size_t n = spokes.size();
    std::size_t triangles = 0;
    for (const std::size_t step : {std::size_t(1), n - 1}) { // one way round, and the other
        std::size_t k = at;
        do {
            k = (k + step) % n;
            ++triangles;
        } while (!(spokes[k] > 0));
    }
    return triangles;
}

double sector_angle(std::span<const float> spokes, VertexKind kind, std::size_t at)
{
    if (kind == VertexKind::smooth || kind == VertexKind::dart)
        return 2 * pi / double(spokes.size());
    return (kind == VertexKind::crease ? pi : pi / 2) / double(triangles_of_sector(spokes, at));
}

/// Biermann et al.: a smooth edge with one end at a sharp one.
EdgeMask biermann_smooth_mask(const EdgeEnd& start, const EdgeEnd& end)
{
    const bool a = start.kind != VertexKind::smooth, b = end.kind != VertexKind::smooth;
    if (a == b)
        return {};
    const double gamma = 0.5 - 0.25 * std::cos((a ? start : end).angle);
    return a ? EdgeMask{0.75 - gamma, gamma, 0.125, 0.125} : EdgeMask{gamma, 0.75 - gamma, 0.125, 0.125};
}

EdgeMask hoppe_sharp_mask(const EdgeEnd& start, const EdgeEnd& end)
{
    if (start.kind == VertexKind::dart || end.kind == VertexKind::dart)
        return {};
    if (start.regular == end.regular)
        return {0.5, 0.5, 0, 0};
    return start.regular ? EdgeMask{0.625, 0.375, 0, 0} : EdgeMask{0.375, 0.625, 0, 0};
}

double mix(double a, double b, double share_of_b) { return a + share_of_b * (b - a); }

EdgeMask mix(const EdgeMask& a, const EdgeMask& b, double share_of_b)
{
    return {mix(a.start, b.start, share_of_b), mix(a.end, b.end, share_of_b), mix(a.left, b.left, share_of_b), mix(a.right, b.right, share_of_b)};
}

void set_smooth(VertexMask& mask, std::size_t valence)
{
    mask.each = loop_beta(valence);
    mask.self = 1 - double(valence) * mask.each;
}

/// @param lasts  tells by its sharpness whether an edge counts as sharp
template <class F> VertexMask mask_where(std::span<const float> spokes, F&& lasts)
{
    std::size_t sharp = 0;
    VertexMask mask;
    for (std::size_t i = 0; i < spokes.size(); ++i)
        if (lasts(spokes[i])) {
            if (sharp < 2)
                mask.crease[sharp] = i;
            ++sharp;
        }
    if (sharp < 2) {
        set_smooth(mask, spokes.size());
    } else if (sharp == 2) {
        mask.self = 0.75;
        mask.along = 0.125;
    }
    return mask;
}

} // namespace

VertexKind vertex_kind(std::span<const float> spokes)
{
    const auto sharp = std::count_if(spokes.begin(), spokes.end(), [](float s) { return s > 0; });
    return VertexKind(std::min<std::ptrdiff_t>(sharp, 3));
}

double loop_beta(std::size_t valence)
{
    if (valence < 2) // a vertex without faces
        return 0;
    const double inner = 3 + 2 * std::cos(2 * pi / double(valence));
    return (0.625 - inner * inner / 64) / double(valence);
}

EdgeEnd edge_end(std::span<const float> spokes, bool closed, std::size_t at)
{
    EdgeEnd end;
    end.kind = vertex_kind(spokes);
    if (end.kind == VertexKind::crease) {
        const auto is_sharp = [](float s) { return s > 0; };
        const auto first = std::find_if(spokes.begin(), spokes.end(), is_sharp), second = std::find_if(first + 1, spokes.end(), is_sharp);
        end.regular = second - first == 3 && spokes.size() == (closed ? 6 : 4);
    }
    if (!(spokes[at] > 0))
        end.angle = sector_angle(spokes, end.kind, at);
    return end;
}

EdgeMask edge_mask(float sharpness, const EdgeEnd& start, const EdgeEnd& end, CreaseRule rule)
{
    const EdgeMask smooth = rule == CreaseRule::biermann && !(sharpness > 0) ? biermann_smooth_mask(start, end) : EdgeMask();
    if (!(sharpness > 0))
        return smooth;
    const EdgeMask sharp = rule == CreaseRule::hoppe ? hoppe_sharp_mask(start, end) : EdgeMask{0.5, 0.5, 0, 0};
    return sharpness < 1 ? mix(smooth, sharp, double(sharpness)) : sharp;
}

EdgeMask edge_mask(const LoopTopology& t, std::uint32_t edge, CreaseRule rule)
{
    const float sharp = t.sharpness[edge];
    if (rule == CreaseRule::opensubdiv || (rule == CreaseRule::hoppe && !(sharp > 0)))
        return edge_mask(sharp, {}, {}, rule); // whatever the ends are
    const std::uint32_t h = t.half_edge[edge];
    if (!(sharp > 0) && t.is_at_sharp_edge(t.start(h)) == t.is_at_sharp_edge(t.end(h)))
        return {};
    const auto end_at = [&](std::uint32_t vertex) {
        const Spokes spokes = t.gather(vertex);
        const auto at = std::find(spokes.edges.begin(), spokes.edges.end(), edge) - spokes.edges.begin();
        return edge_end(spokes.sharpness, spokes.closed, std::size_t(at));
    };
    return edge_mask(sharp, end_at(t.start(h)), end_at(t.end(h)), rule);
}

VertexMask vertex_mask(std::span<const float> spokes)
{
    const VertexMask before = mask_where(spokes, [](float s) { return s > 0; });
    double fading = 0, sum = 0;
    for (const float s : spokes)
        if (s > 0 && !(child_sharpness(s) > 0)) {
            ++fading;
            sum += double(s);
        }
    if (fading == 0)
        return before;
    // The rule of the next level takes over as the sharpness of the edges that fade goes below 1 (DeRose et al. 1998).
    const VertexMask after = mask_where(spokes, [](float s) { return child_sharpness(s) > 0; });
    const double share = 1 - std::min(1.0, sum / fading);
    VertexMask mask = before.along > 0 ? before : after; // at most one of them has a crease
    mask.self = mix(before.self, after.self, share);
    mask.each = mix(before.each, after.each, share);
    mask.along = mix(before.along, after.along, share);
    return mask;
}

SmoothVertexMasks::SmoothVertexMasks()
{
    for (std::size_t n = 0; n < known_.size(); ++n)
        known_[n] = compute(n);
}

VertexMask SmoothVertexMasks::compute(std::size_t valence)
{
    VertexMask mask;
    set_smooth(mask, valence);
    return mask;
}

} // namespace limn
