#pragma once

#include <span>
#include <vector>

#include "limn/lines/chain.h"
#include "limn/lines/crossings.h"
#include "limn/lines/line_model.h"
#include "limn/lines/projector.h"
#include "limn/raycast/ray_scene.h"

namespace limn {

/// How the visibility of a kind of line is tested (line-visibility specification, sections 3 and 5).
enum class VisibilityRule : std::uint8_t {
    contour, ///< an interpolated contour: hidden where the radial curvature is negative, else a filtered ray
    surface, ///< a line inside front-facing faces: hidden where the interpolated n.v is negative, else a filtered ray
    edge,    ///< a line along mesh edges: a plain ray
};

/// What every test of one view reads.
struct ViewContext {
    const LineModel& model;
    const RayScene& rays;
    const View& view;
    const Projector& projector;
    std::span<const float> facing; ///< n.v per vertex, as facing_of_vertices
};

/// Part of a segment between two cuts, in the order and direction of its chain.
struct Element {
    std::uint32_t segment;
    float t0, t1;       ///< from a to b of the segment, so t0 > t1 where the chain walks it backwards
    float length, step; ///< its length, and the mean edge length h of its face, along mesh edges at most two pixels; model units
    bool may_hide, may_appear; ///< whether a change to hidden / to visible is expected where it starts
    bool cusp;          ///< it starts at a cusp: any change is expected
    bool visible;
    bool inked = false; ///< another line already draws it: it makes no stroke
};

/// Elements of chain c are elements[start[c]] … elements[start[c+1]-1].
struct ChainElements {
    std::vector<Element> elements;
    std::vector<std::uint32_t> start;
};

/// Prices of a change of visibility along a chain, in mean edge lengths.
struct ChangePrices {
    float expected = 0.5f; ///< at a cusp, or at a crossing in its direction
    float other = 2.0f;
    float turn = 0;         ///< where a surface line turns away: its place is exact, and what lies behind it is surely hidden
};

/// Radial curvature at the ends of each link of contour chains, in the order of the links; smoothed along the chain.
struct LinkCurvature {
    std::vector<float> enter, leave;
};
/// Empty where the model has no curvature.
LinkCurvature curvature_along_contours(const ViewContext& context, std::span<const Segment> segments, const Chains& chains);

/// The pieces of chained contours that can hide other lines: those of non-negative radial curvature.
std::vector<Occluder> occluders_of_contours(const ViewContext& context, std::span<const Segment> segments, const Chains& chains,
                                            const LinkCurvature& curvature);

/// Cuts chains at cusps (contours), where the surface turns away (surface lines) and under occluders, tests each element
/// with at most one ray, and decides along each chain where the line is visible (Viterbi).
/// @param curvature  of contours; empty for other rules
ChainElements find_visibility(const ViewContext& context, VisibilityRule rule, std::span<const Segment> segments, const Chains& chains,
                              const LinkCurvature& curvature, const OccluderGrid& occluders, const ChangePrices& prices = {});

/// Mean edge length of a face; its longest edge where it is stretched by more than 5.
float step_of_face(const LineModel& model, std::uint32_t face);

} // namespace limn
