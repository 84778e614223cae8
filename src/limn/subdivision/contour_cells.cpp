#include "limn/subdivision/contour_cells.h"

#include <algorithm>
#include <cmath>

#include "limn/subdivision/bezier_roots.h"

namespace limn {
namespace {

/// Levels below the refined face to which faces with an extraordinary vertex are cut at first.
constexpr int first_levels = 1;
/// How many parts of a side beside what is not cut into polynomials yet are looked at for changes of sign.
constexpr int parts_of_rest = 16;
/// Crossings are kept this far away from the ends of their side.
constexpr double least = 1e-7;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

/// The weights of a triangle's second and third corner at a place.
dvec2 weights_at(const ParameterTriangle& t, const dvec2& at)
{
    const dvec2 a = t[1] - t[0], b = t[2] - t[0], d = at - t[0];
    const double area = cross(a, b);
    return {cross(d, b) / area, cross(a, d) / area};
}

bool holds(const ParameterTriangle& t, const dvec2& at, double slack = 1e-12)
{
    const dvec2 weights = weights_at(t, at);
    return weights.x >= -slack && weights.y >= -slack && weights.x + weights.y <= 1 + slack;
}

dvec2 across(const dvec2& d) { return {-d.y, d.x}; }

dvec2 centroid(const ParameterTriangle& t) { return (t[0] + t[1] + t[2]) / 3.0; }

/// Calls f(corners, node) for the polynomials of a triangle of a face's tree, to so many levels below; and rest(corners, node) for what is not
/// cut down to them by then. @return whether f always said to go on
template <class F, class Rest>
bool each_patch(const PatchClass& patches, const PatchClass::Node& node, const ParameterTriangle& corners, int levels, F&& f, Rest&& rest)
{
    if (node.kind == PatchClass::Kind::patch)
        return f(corners, node);
    if (node.kind == PatchClass::Kind::corner)
        return true;
    if (levels == 0) {
        rest(corners, node);
        return true;
    }
    const std::array<ParameterTriangle, 4> children = quarters(corners);
    for (std::size_t k = 0; k < 4; ++k)
        if (!each_patch(patches, patches.nodes[node.first_child + k], children[k], levels - 1, f, rest))
            return false;
    return true;
}

void add_pieces(ContourCell& cell, std::uint32_t refined_face, const PatchClass::Node* node, const ParameterTriangle& corners, int levels)
{
    const FacePatches face = cell.of.shape->patches(refined_face);
    each_patch(
        face.patches(), node ? *node : face.patches().nodes[0], corners, levels,
        [&](const ParameterTriangle& at, const PatchClass::Node& patch) {
            const QuarticPatch net = face.patch(patch);
            cell.pieces.push_back(std::make_shared<ContourPiece>(ContourPiece{at, contour_polynomial(face.anchor(), net, *cell.of.eye), at, face.anchor(), net}));
            return true;
        },
        [&](const ParameterTriangle& at, const PatchClass::Node& rest) { cell.rests.push_back({at, refined_face, &rest}); });
}

const ContourPiece* piece_at(const ContourCell& cell, const dvec2& at)
{
    for (const auto& piece : cell.pieces)
        if (holds(piece->corners, at))
            return piece.get();
    return nullptr;
}

/// The direction in the piece's own parameters of one in those of the control face.
dvec2 in_piece(const ContourPiece& piece, const dvec2& direction)
{
    return weights_at(piece.corners, piece.corners[0] + direction);
}

/// Whether g grows in a direction all over a cell.
bool grows(const ContourCell& cell, const dvec2& direction)
{
    for (const auto& piece : cell.pieces) {
        const dvec2 d = in_piece(*piece, direction);
        const ContourPolynomial& g = piece->g;
        for (int k = 0; k < 9; ++k)
            for (int j = 0; j < 9 - k; ++j) {
                const double here = g.at(j, k);
                if (!(d.x * (g.at(j + 1, k) - here) + d.y * (g.at(j, k + 1) - here) > 0))
                    return false;
            }
    }
    return true;
}

bool has_one_sign(const ContourCell& cell)
{
    const bool negative = cell.pieces.empty() ? false : cell.pieces[0]->g.c[0] < 0;
    for (const auto& piece : cell.pieces)
        for (const double c : piece->g.c)
            if ((c < 0) != negative)
                return false;
    return true;
}

/// g and its derivatives after the control face's parameters, where a piece is.
struct ContourPoint {
    double value = 0;
    dvec2 gradient = dvec2(0);
};

ContourPoint contour_point(const ContourPiece& piece, const dvec2& at)
{
    const dvec2 place = weights_at(piece.corners, at);
    const BezierPoint<double> point = bezier_point(piece.g, place.x, place.y);
    const dvec2 one = in_piece(piece, {1, 0}), other = in_piece(piece, {0, 1});
    return {point.value, {point.dv * one.x + point.dw * one.y, point.dv * other.x + point.dw * other.y}};
}

/// The direction of fastest growth at a place, of unit length; 0 where it is not known.
dvec2 growth(const ContourCell& cell, const dvec2& at)
{
    const ContourPiece* piece = piece_at(cell, at);
    if (!piece)
        return dvec2(0);
    const dvec2 gradient = contour_point(*piece, at).gradient;
    const double length = glm::length(gradient);
    return length > 0 ? gradient / length : dvec2(0);
}

/// A direction in which g grows all over the cell, or 0 where none of those was one that suggest themselves.
dvec2 direction_of_growth(const ContourCell& cell, const dvec2& middle, std::span<const BoundaryCrossing> crossings)
{
    const dvec2 here = growth(cell, middle);
    if (here != dvec2(0) && grows(cell, here))
        return here;
    dvec2 sum = here;
    for (const BoundaryCrossing& c : crossings)
        sum += growth(cell, c.at);
    if (crossings.empty())
        for (const dvec2& corner : cell.corners)
            sum += growth(cell, corner);
    return sum != dvec2(0) && grows(cell, sum) ? sum : dvec2(0);
}

/// Appends where g changes its sign between two places of a segment, if their signs differ.
void append_change(const ContourCell& cell, const dvec2& from, const dvec2& along, double low, double high, std::vector<double>& changes)
{
    constexpr int halvings = 30;
    const auto is_front = [&](double t) { return contour_value(cell, from + t * along) >= 0; };
    const bool at_low = is_front(low);
    if (is_front(high) == at_low)
        return;
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        (is_front(middle) == at_low ? low : high) = middle;
    }
    changes.push_back(std::clamp(0.5 * (low + high), least, 1 - least));
}

/// Where g changes its sign along a segment, from 0 to 1: all changes along the sides of pieces; beside rests those that samples show.
std::vector<double> changes_along(const ContourCell& cell, const dvec2& from, const dvec2& to)
{
    const dvec2 along = to - from;
    const double length = glm::dot(along, along);
    std::vector<double> changes, roots;
    std::vector<std::array<double, 2>> known;
    for (const auto& piece : cell.pieces)
        for (int side = 0; side < 3; ++side) {
            const dvec2 a = piece->corners[std::size_t(side)] - from, b = piece->corners[std::size_t(side + 1) % 3] - from;
            if (cross(a, along) != 0 || cross(b, along) != 0) // dyadic numbers: exact
                continue;
            const double begin = glm::dot(a, along) / length, end = glm::dot(b, along) / length;
            known.push_back({std::min(begin, end), std::max(begin, end)});
            roots.clear();
            append_sign_changes(along_side(piece->g, side), roots);
            for (const double root : roots)
                changes.push_back(std::clamp(begin + root * (end - begin), least, 1 - least));
        }
    if (cell.rests.empty())
        known = {{0, 1}};
    std::sort(known.begin(), known.end());
    known.push_back({1, 1});
    double reached = 0;
    for (const auto& [begin, end] : known) {
        for (int i = 0; i < parts_of_rest && begin > reached; ++i)
            append_change(cell, from, along, glm::mix(reached, begin, double(i) / parts_of_rest), glm::mix(reached, begin, double(i + 1) / parts_of_rest), changes);
        reached = std::max(reached, end);
    }
    std::sort(changes.begin(), changes.end());
    return changes;
}

/// The part of a line within a triangle, as parameters of the line.
std::array<double, 2> within(const ParameterTriangle& t, const dvec2& origin, const dvec2& direction)
{
    double low = -1e30, high = 1e30;
    for (std::size_t side = 0; side < 3; ++side) {
        const dvec2 along = t[(side + 1) % 3] - t[side];
        const double height = cross(along, origin - t[side]), slope = cross(along, direction); // inside where height + h slope >= 0
        if (slope > 0)
            low = std::max(low, -height / slope);
        else if (slope < 0)
            high = std::min(high, -height / slope);
    }
    return {low, high};
}

/// The point of the contour on a line through the cell, near a place of it. By Newton's method, and by halving where that leaves the cell or
/// does not get on; where there is none, for rounding, the place given.
dvec2 on_contour(const ContourCell& cell, const dvec2& at, const dvec2& direction)
{
    constexpr int most_steps = 40;
    constexpr double enough = 1e-9; // of the width
    auto [low, high] = within(cell.corners, at, direction);
    if (!(low < high))
        return at;
    const double width = high - low;
    const bool rises = glm::dot(growth(cell, at), direction) >= 0;
    double h = 0;
    for (int i = 0; i < most_steps; ++i) {
        const dvec2 place = at + h * direction;
        const ContourPiece* piece = piece_at(cell, place);
        const ContourPoint point = piece ? contour_point(*piece, place) : ContourPoint{contour_value(cell, place), dvec2(0)};
        ((point.value < 0) == rises ? low : high) = h;
        const double slope = glm::dot(point.gradient, direction);
        double next = slope != 0 ? h - point.value / slope : low;
        if (!(next > low && next < high))
            next = 0.5 * (low + high);
        const double step = std::abs(next - h);
        h = next;
        if (step < enough * width)
            break;
    }
    return at + h * direction;
}

/// The quarters of a cell, without crossings.
std::array<SplitCell, 4> split(const ContourCell& cell)
{
    const std::array<ParameterTriangle, 4> children = quarters(cell.corners);
    std::array<SplitCell, 4> out;
    for (std::size_t k = 0; k < 4; ++k)
        out[k].cell.of = cell.of, out[k].cell.corners = children[k];
    for (const auto& piece : cell.pieces) {
        const double part = std::abs(cross(piece->corners[1] - piece->corners[0], piece->corners[2] - piece->corners[0]) /
                                     cross(cell.corners[1] - cell.corners[0], cell.corners[2] - cell.corners[0]));
        for (std::size_t k = 0; k < 4; ++k) {
            if (part <= 0.25) { // within one of the children
                if (holds(children[k], centroid(piece->corners)))
                    out[k].cell.pieces.push_back(piece);
                continue;
            }
            std::array<dvec3, 3> corners;
            for (std::size_t i = 0; i < 3; ++i) {
                const dvec2 weights = weights_at(piece->corners, children[k][i]);
                corners[i] = {1 - weights.x - weights.y, weights.x, weights.y};
            }
            out[k].cell.pieces.push_back(
                std::make_shared<ContourPiece>(ContourPiece{children[k], bezier_part(piece->g, corners), piece->of_patch, piece->anchor, piece->patch}));
        }
    }
    for (const ContourRest& rest : cell.rests)
        for (std::size_t k = 0; k < 4; ++k)
            if (holds(children[k], centroid(rest.corners)))
                add_pieces(out[k].cell, rest.refined_face, rest.node, rest.corners, 1);
    return out;
}

/// Growth around a rest tells of the rest as well, but not where a sharp edge wears off in it.
bool has_fading_rest(const ContourCell& cell)
{
    const PatchTable& table = cell.of.shape->table();
    return std::any_of(cell.rests.begin(), cell.rests.end(), [&](const ContourRest& rest) { return table.patch_class(table.class_of(rest.refined_face)).fades; });
}

class Tracer {
public:
    Tracer(const NeedsPoint& needs, int deepest) : needs_(needs), deepest_(deepest) {}

    void trace(const ContourCell& cell, const std::vector<BoundaryCrossing>& crossings, int depth)
    {
        const std::size_t n = crossings.size();
        if (n == 0 && has_one_sign(cell))
            return;
        if (cell.pieces.empty() || depth == deepest_) {
            join_pairs(cell, crossings);
            return;
        }
        if (!has_fading_rest(cell) && (n == 0 || n == 2)) {
            const dvec2 direction = direction_of_growth(cell, n == 0 ? centroid(cell.corners) : 0.5 * (crossings[0].at + crossings[1].at), crossings);
            if (direction != dvec2(0)) {
                if (n == 2)
                    walk(cell, crossings[0].at, crossings[1].at, direction);
                return;
            }
        }
        for (const SplitCell& child : split_with_crossings(cell, crossings))
            trace(child.cell, child.crossings, depth + 1);
    }
    /// Joins arcs that end at the same place.
    std::vector<ContourArc> finish()
    {
        std::vector<ContourArc> done;
        while (!arcs_.empty()) {
            ContourArc arc = std::move(arcs_.back());
            arcs_.pop_back();
            while (arc.front() != arc.back() && (extend(arc) || (std::reverse(arc.begin(), arc.end()), extend(arc)))) {
            }
            done.push_back(std::move(arc));
        }
        return done;
    }

private:
    void walk(const ContourCell& cell, const dvec2& from, const dvec2& to, const dvec2& direction)
    {
        ContourArc arc = {from};
        fill(cell, from, to, direction, 0, arc);
        arc.push_back(to);
        arcs_.push_back(std::move(arc));
    }
    void fill(const ContourCell& cell, const dvec2& a, const dvec2& b, const dvec2& direction, int depth, ContourArc& arc)
    {
        constexpr int most_halvings = 10;
        if (depth == most_halvings)
            return;
        const dvec2 middle = on_contour(cell, 0.5 * (a + b), direction);
        if (!needs_(a, middle, b, depth))
            return;
        fill(cell, a, middle, direction, depth + 1, arc);
        arc.push_back(middle);
        fill(cell, middle, b, direction, depth + 1, arc);
    }
    /// Where nothing more can be known, neighbours along the boundary are taken for the ends of arcs.
    void join_pairs(const ContourCell& cell, std::vector<BoundaryCrossing> crossings)
    {
        std::sort(crossings.begin(), crossings.end(),
                  [](const BoundaryCrossing& a, const BoundaryCrossing& b) { return a.side != b.side ? a.side < b.side : a.t < b.t; });
        for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
            walk(cell, crossings[i].at, crossings[i + 1].at, across(crossings[i + 1].at - crossings[i].at));
    }
    bool extend(ContourArc& arc)
    {
        for (std::size_t i = 0; i < arcs_.size(); ++i) {
            ContourArc& other = arcs_[i];
            if (other.back() == arc.back())
                std::reverse(other.begin(), other.end());
            if (other.front() != arc.back())
                continue;
            arc.insert(arc.end(), other.begin() + 1, other.end());
            arcs_.erase(arcs_.begin() + std::ptrdiff_t(i));
            return true;
        }
        return false;
    }

    const NeedsPoint& needs_;
    int deepest_;
    std::vector<ContourArc> arcs_;
};

} // namespace

std::array<ParameterTriangle, 4> quarters(const ParameterTriangle& t)
{
    const dvec2 middle[3] = {0.5 * (t[0] + t[1]), 0.5 * (t[1] + t[2]), 0.5 * (t[2] + t[0])};
    return {{{t[0], middle[0], middle[2]}, {t[1], middle[1], middle[0]}, {t[2], middle[2], middle[1]}, {middle[0], middle[1], middle[2]}}};
}

ContourCell contour_cell(const LimitShape& shape, const Eye& eye, std::uint32_t face)
{
    ContourCell cell{{&shape, &eye, face}, {dvec2(0, 0), dvec2(1, 0), dvec2(0, 1)}, {}, {}};
    const std::array<ParameterTriangle, 4> children = quarters(cell.corners);
    for (std::uint32_t k = 0; k < 4; ++k)
        add_pieces(cell, 4 * face + k, nullptr, children[k], first_levels);
    return cell;
}

std::array<SplitCell, 4> split_with_crossings(const ContourCell& cell, const std::vector<BoundaryCrossing>& crossings)
{
    std::array<SplitCell, 4> out = split(cell);
    for (const BoundaryCrossing& c : crossings) {
        if (c.t < 0.5)
            out[std::size_t(c.side)].crossings.push_back({0, 2 * c.t, c.at});
        else
            out[std::size_t(c.side + 1) % 3].crossings.push_back({2, 2 * c.t - 1, c.at});
    }
    const ContourCell& middle = out[3].cell;
    for (int side = 0; side < 3; ++side) { // shared with the second side of another quarter
        const dvec2 from = middle.corners[std::size_t(side)], to = middle.corners[std::size_t(side + 1) % 3];
        for (const double t : changes_along(middle, from, to)) {
            const dvec2 at = from + t * (to - from);
            out[3].crossings.push_back({side, t, at});
            out[std::size_t(side + 1) % 3].crossings.push_back({1, 1 - t, at});
        }
    }
    return out;
}

double contour_value(const ContourCell& cell, const dvec2& at)
{
    const ContourPiece* piece = piece_at(cell, at);
    if (!piece) {
        const SurfaceSample there = sample(cell, at);
        return glm::dot(cell.of.eye->from(there.position), there.normal);
    }
    const dvec2 place = weights_at(piece->corners, at);
    return bezier_value(piece->g, place.x, place.y);
}

SurfaceSample sample(const ContourCell& cell, const dvec2& at)
{
    const ContourPiece* piece = piece_at(cell, at);
    if (!piece)
        return cell.of.shape->sample({cell.of.face, at.x, at.y});
    const dvec2 place = weights_at(piece->of_patch, at);
    return sample_patch(piece->anchor, piece->patch, place.x, place.y);
}

bool is_clear_of_contours(const LimitShape& shape, const Eye& eye, std::uint32_t control_face)
{
    for (std::uint32_t k = 0; k < 4; ++k) {
        const FacePatches face = shape.patches(4 * control_face + k);
        const auto is_clear = [&](const ParameterTriangle&, const PatchClass::Node& node) {
            const QuarticPatch patch = face.patch(node);
            if (shows_one_side(face.anchor(), patch, eye))
                return true;
            const ContourPolynomial g = contour_polynomial(face.anchor(), patch, eye);
            return std::all_of(g.c.begin(), g.c.end(), [&](double c) { return (c < 0) == (g.c[0] < 0); });
        };
        if (!each_patch(face.patches(), face.patches().nodes[0], {}, first_levels, is_clear, [](const ParameterTriangle&, const PatchClass::Node&) {}))
            return false;
    }
    return true;
}

std::vector<ContourArc> trace_contour(const ContourCell& cell, const std::vector<BoundaryCrossing>& crossings, const NeedsPoint& needs, int deepest)
{
    Tracer tracer(needs, deepest);
    tracer.trace(cell, crossings, 0);
    return tracer.finish();
}

} // namespace limn
