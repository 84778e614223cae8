#include "limn/subdivision/limit_shape.h"

#include <algorithm>

#include "limn/subdivision/loop_refine.h"

namespace limn {
namespace {

/// A place in a triangle of the tree below a control face.
struct Place {
    double v, w;
    dvec2 of_v = dvec2(1, 0), of_w = dvec2(0, 1); ///< PatchPiece
};

/// The same place in the child k of its triangle (refine): that at corner k begins there, the middle one with the first edge's point.
Place in_child(const Place& p, int k)
{
    const double u = 1 - p.v - p.w;
    const auto mapped = [&](double v, double w, const dvec2& from_v, const dvec2& from_w) {
        // from_v, from_w: derivatives of the child's (v, w) after the parent's v and w
        const auto chain = [&](const dvec2& d) { return d.x * from_v + d.y * from_w; };
        return Place{v, w, chain(p.of_v), chain(p.of_w)};
    };
    switch (k) {
    case 0: return mapped(2 * p.v, 2 * p.w, {2, 0}, {0, 2});
    case 1: return mapped(2 * p.w, 2 * u, {0, -2}, {2, -2});
    case 2: return mapped(2 * u, 2 * p.v, {-2, 2}, {-2, 0});
    default: return mapped(1 - 2 * u, 1 - 2 * p.v, {2, -2}, {2, 0});
    }
}

int child_at(const Place& p)
{
    if (1 - p.v - p.w >= 0.5)
        return 0;
    return p.v >= 0.5 ? 1 : p.w >= 0.5 ? 2 : 3;
}

/// Down the tree of a refined face until its end, or to a depth below the control face (the refined face has 1).
struct Found {
    std::uint32_t face;
    const PatchClass::Node* node;
    Place place;
};

Found find(const PatchTable& table, const PatchPoint& at, int deepest)
{
    Place place{at.v, at.w};
    const int k = child_at(place);
    place = in_child(place, k);
    const std::uint32_t face = 4 * at.face + std::uint32_t(k);
    const PatchClass& patches = table.patch_class(table.class_of(face));
    const PatchClass::Node* node = patches.nodes.data();
    for (int depth = 1; node->kind == PatchClass::Kind::inner && depth < deepest; ++depth) {
        const int child = child_at(place);
        place = in_child(place, child);
        node = &patches.nodes[node->first_child + std::size_t(child)];
    }
    return {face, node, place};
}

/// The control face's place that a held one stands for: `reach` from the corner, in the refined face at corner k.
PatchPoint pulled_away(const PatchPoint& at, int k, double reach)
{
    double weights[3] = {1 - at.v - at.w, at.v, at.w};
    double &next = weights[(k + 1) % 3], &last = weights[(k + 2) % 3];
    const double sum = next + last;
    const double share = sum > 0 ? next / sum : 0.5;
    weights[k] = 1 - reach;
    next = share * reach;
    last = reach - next;
    return {at.face, weights[1], weights[2]};
}

dvec3 unit(const dvec3& d)
{
    const double length = glm::length(d);
    return length > 0 ? d / length : dvec3(0);
}

} // namespace

LimitShape::LimitShape(const PatchTable& table, std::span<const dvec3> positions)
    : table_(&table), control_positions_(positions.begin(), positions.end()), positions_(refine_positions(table.control(), positions))
{
}

FacePatches::FacePatches(const PatchTable& table, std::span<const dvec3> positions, std::uint32_t face)
    : patches_(&table.patch_class(table.class_of(face))), regular_(table.class_of(face) == PatchTable::regular)
{
    const std::span<const std::uint32_t> support = table.support(face);
    if (support.size() > usual)
        many_.resize(support.size());
    dvec3* to = many_.empty() ? few_.data() : many_.data();
    for (std::size_t i = 0; i < support.size(); ++i)
        to[i] = positions[support[i]];
    if (patches_->anchored)
        anchor_ = weighted(0);
}

QuarticPatch FacePatches::patch(const PatchClass::Node& node) const
{
    if (regular_)
        return regular_patch(points());
    QuarticPatch out;
    for (std::size_t i = 0; i < out.c.size(); ++i)
        out.c[i] = weighted(node.row + i);
    return out;
}

dvec3 FacePatches::weighted(std::size_t row) const
{
    const std::span<const double> weights = patches_->row(row);
    const dvec3* p = points();
    dvec3 sum(0);
    for (std::size_t i = 0; i < weights.size(); ++i)
        sum += weights[i] * p[i];
    return sum;
}

PatchPiece LimitShape::piece(const PatchPoint& at, int deepest) const
{
    Found found = find(*table_, at, deepest);
    if (found.node->kind != PatchClass::Kind::patch) { // only at the old corner that the refined face begins with
        const double reach = std::exp2(-double(std::min(deepest, PatchClass::deepest)));
        found = find(*table_, pulled_away(at, int(found.face % 4), reach), deepest + 1);
    }
    const FacePatches of_face = patches(found.face);
    return {of_face.anchor(), of_face.patch(*found.node), found.place.v, found.place.w, found.place.of_v, found.place.of_w};
}

SurfaceSample sample_patch(const dvec3& anchor, const QuarticPatch& patch, double v, double w)
{
    const BezierTriangle<1, dvec3> plane = casteljau_step(casteljau_step(casteljau_step(patch, v, w), v, w), v, w);
    return {anchor + bezier_value(plane, v, w), unit(glm::cross(plane.c[1] - plane.c[0], plane.c[2] - plane.c[0]))};
}

SurfaceSample LimitShape::sample(const PatchPoint& at) const
{
    const Found found = find(*table_, at, PatchClass::deepest + 2);
    const FacePatches of_face = patches(found.face);
    if (found.node->kind == PatchClass::Kind::patch)
        return sample_patch(of_face.anchor(), of_face.patch(*found.node), found.place.v, found.place.w);
    return {of_face.anchor(), unit(glm::cross(of_face.weighted(1), of_face.weighted(2)))};
}

LimitJet LimitShape::jet(const PatchPoint& at) const
{
    const PatchPiece p = piece(at);
    const BezierTriangle<3, dvec3> cubic = casteljau_step(p.patch, p.v, p.w);
    const BezierTriangle<2, dvec3> square = casteljau_step(cubic, p.v, p.w);
    const BezierTriangle<1, dvec3> plane = casteljau_step(square, p.v, p.w);
    // Derivatives after the patch's own parameters, then the chain rule: the map between them is linear.
    const dvec3 first[2] = {4.0 * (plane.c[1] - plane.c[0]), 4.0 * (plane.c[2] - plane.c[0])};
    const auto second_of = bezier_dv(bezier_dv(square)), mixed_of = bezier_dw(bezier_dv(square)), last_of = bezier_dw(bezier_dw(square));
    const dvec3 second[3] = {6.0 * second_of.c[0], 6.0 * mixed_of.c[0], 6.0 * last_of.c[0]};
    const auto cubic_v = bezier_dv(bezier_dv(cubic)), cubic_w = bezier_dw(bezier_dw(cubic));
    const dvec3 third[4] = {4.0 * bezier_dv(cubic_v).c[0], 4.0 * bezier_dw(cubic_v).c[0], 4.0 * bezier_dv(cubic_w).c[0], 4.0 * bezier_dw(cubic_w).c[0]};
    const dvec2 &a = p.of_v, &b = p.of_w;
    const auto first_along = [&](const dvec2& d) { return d.x * first[0] + d.y * first[1]; };
    const auto second_along = [&](const dvec2& d, const dvec2& e) { return d.x * e.x * second[0] + (d.x * e.y + d.y * e.x) * second[1] + d.y * e.y * second[2]; };
    const auto third_along = [&](const dvec2& d, const dvec2& e, const dvec2& f) {
        return d.x * e.x * f.x * third[0] + (d.x * e.x * f.y + d.x * e.y * f.x + d.y * e.x * f.x) * third[1] +
               (d.x * e.y * f.y + d.y * e.x * f.y + d.y * e.y * f.x) * third[2] + d.y * e.y * f.y * third[3];
    };
    const SurfaceSample exact = sample(at);
    return {exact.position, exact.normal, first_along(a), first_along(b), second_along(a, a), second_along(a, b), second_along(b, b),
            third_along(a, a, a), third_along(a, a, b), third_along(a, b, b), third_along(b, b, b)};
}

} // namespace limn
