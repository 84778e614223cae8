#include <gtest/gtest.h>

#include "limn/subdivision/contour_cells.h"
#include "limn/subdivision/contour_crossings.h"
#include "limn/subdivision/contour_filter.h"
#include "limn/subdivision/silhouette_view.h"
#include "subdivision/exact_views.h"

namespace limn::test {
namespace {

/// (eye - p) . n at a place, with the unit normal.
double height_at(const LimitShape& shape, const Eye& eye, const PatchPoint& at)
{
    const SurfaceSample s = shape.sample(at);
    return glm::dot(eye.from(s.position), s.normal);
}

const std::vector<Eye> eyes = {{dvec4(3, 2, 4, 1)}, {dvec4(-0.3, 0.9, 0.2, 0)}, {dvec4(0.1, -0.2, 0.4, 1)}};

/// Its sign is that of the surface's normal everywhere, and over a patch it is the cross product's though of one degree less.
TEST(ContourPolynomial, IsThatOfTheNormal)
{
    const ExactSubject subject(shaken(torus(6, 8), 0.1));
    for (const Eye& eye : eyes)
        for (std::uint32_t refined = 0; refined < 40; ++refined) {
            const FacePatches face = subject.pose().shape.patches(refined);
            for (const PatchClass::Node& node : face.patches().nodes) {
                if (node.kind != PatchClass::Kind::patch)
                    continue;
                const QuarticPatch patch = face.patch(node);
                const ContourPolynomial g = contour_polynomial(face.anchor(), patch, eye);
                for (const dvec2& at : {dvec2(0.2, 0.3), dvec2(1, 0), dvec2(0.1, 0.8)}) {
                    const BezierPoint<dvec3> p = bezier_point(patch, at.x, at.y);
                    const dvec3 to_eye = eye.from(face.anchor() + p.value), normal = glm::cross(p.dv, p.dw) / 16.0; // of coefficients' differences
                    EXPECT_NEAR(bezier_value(g, at.x, at.y), glm::dot(to_eye, normal), 1e-13 * glm::length(to_eye) * glm::length(normal) + 1e-18);
                }
                for (int side = 0; side < 3; ++side) {
                    const SideNet net = side_net(face, node, side);
                    const auto along = contour_along(face.anchor(), net, eye), same = along_side(g, side);
                    for (std::size_t i = 0; i < along.size(); ++i) {
                        EXPECT_NEAR(along[i], same[i], 1e-12 * std::abs(same[5]) + 1e-16);
                    }
                    for (const double t : {0.0, 0.3, 1.0}) {
                        const dvec2 places[3] = {{t, 0}, {1 - t, t}, {0, 1 - t}};
                        const SurfaceSample sample = sample_side(face.anchor(), net, t), of_patch = sample_patch(face.anchor(), patch, places[side].x, places[side].y);
                        EXPECT_LT(glm::distance(sample.position, of_patch.position), 1e-14);
                        EXPECT_LT(glm::distance(sample.normal, of_patch.normal), 1e-12);
                    }
                }
                if (shows_one_side(face.anchor(), patch, eye)) {
                    for (const double c : g.c) {
                        EXPECT_EQ(c < 0, g.c[0] < 0);
                    }
                }
                break; // one for each face will do
            }
        }
}

/// The kernel's signs are those of the scalar code.
TEST(ContourFilter, HasTheSignsOfThePolynomial)
{
    const ExactSubject subject(shaken(torus(12, 10), 0.4));
    const ControlEdges& edges = subject.table().edges();
    std::size_t changes = 0, negatives = 0, tested = 0;
    for (const Eye& eye : eyes)
        for (std::uint32_t first = 0; first + edge_lanes <= subject.topology().edge_count(); first += edge_lanes) {
            EdgeLanes lanes;
            std::array<std::array<dvec3, regular_edge_support>, edge_lanes> points;
            for (std::uint32_t k = 0; k < edge_lanes; ++k) {
                ASSERT_EQ(edges.kind(first + k), ControlEdges::Kind::regular);
                for (std::size_t p = 0; p < regular_edge_support; ++p) {
                    points[k][p] = subject.pose().shape.control_positions()[edges.regular(first + k)[p]];
                    lanes.set(k, p, points[k][p]);
                }
            }
            const SignLanes signs = contour_signs(lanes, eye);
            for (std::uint32_t k = 0; k < edge_lanes; ++k) {
                const std::array<double, 10> c = contour_along(dvec3(0), regular_side_net(points[k]), eye);
                const bool change = std::any_of(c.begin(), c.end(), [&](double value) { return (value < 0) != (c[0] < 0); });
                EXPECT_EQ(bool(signs.change >> k & 1), change);
                EXPECT_EQ(bool(signs.negative >> k & 1), c[0] < 0);
                changes += change, negatives += c[0] < 0, ++tested;
            }
        }
    EXPECT_GT(changes, 50u);
    EXPECT_GT(negatives, 50u);
    EXPECT_GT(tested, changes + 100);
}

/// Checklist 39: as many crossings as dense sampling sees, at the same places; also two on an edge, and more.
TEST(ContourCrossings, AreThoseOfDenseSampling)
{
    constexpr int samples = 200;
    std::size_t found = 0, even = 0, three = 0;
    for (const auto& [name, mesh] : {NamedMesh{"creature", make_control_sample("creature")}, NamedMesh{"crumpled", shaken(torus(6, 8), 1.5)},
                                     NamedMesh{"mug", make_control_sample("mug")}}) {
        const ExactSubject subject(mesh);
        const LimitShape& shape = subject.pose().shape;
        for (int number = 0; number < 3; ++number) {
            const Camera camera = any_view(subject.bounds(), number);
            const SilhouetteView view{subject.pose(), PicturePlane(camera), searched_eye(camera, dvec3(0)), 0.25, 0, 0};
            CrossingSearch search(shape, view.eye);
            for (std::uint32_t h = 0; h < subject.topology().twin.size(); ++h) {
                const std::vector<EdgeCrossing>& crossings = search.along(h, {view.faces_eye(h), view.faces_eye(next_half_edge(h))});
                ASSERT_EQ(crossings.size() % 2 == 1, view.faces_eye(h) != view.faces_eye(next_half_edge(h)));
                found += crossings.size();
                even += !crossings.empty() && crossings.size() % 2 == 0;
                three += crossings.size() > 2;
                std::vector<double> dense;
                bool before = height_at(shape, view.eye, on_half_edge(h, 0.5 / samples)) >= 0;
                for (int i = 1; i < samples; ++i) {
                    const bool now = height_at(shape, view.eye, on_half_edge(h, (i + 0.5) / samples)) >= 0;
                    if (now != before)
                        dense.push_back(double(i) / samples);
                    before = now;
                }
                EXPECT_GE(crossings.size(), dense.size()) << name << ", view " << number << ", half-edge " << h;
                for (const double t : dense) {
                    double nearest = 1;
                    for (const EdgeCrossing& crossing : crossings)
                        nearest = std::min(nearest, std::abs(crossing.t - t));
                    EXPECT_LT(nearest, 0.6 / samples) << name << ", view " << number << ", half-edge " << h;
                }
                for (const auto& [t, sample] : crossings) {
                    EXPECT_LT(glm::distance(sample.position, shape.position(on_half_edge(h, t))), 1e-13);
                    if (t > 0.02 && t < 0.98 && subject.topology().sharpness[subject.topology().edge[h]] == 0) {
                        EXPECT_LT(std::abs(height_at(shape, view.eye, on_half_edge(h, t))), 1e-7);
                    }
                }
            }
        }
    }
    EXPECT_GT(found, 500u);
    EXPECT_GT(even, 10u);
    EXPECT_GT(three, 0u);
}

NeedsPoint halved(int times)
{
    return [times](const dvec2&, const dvec2&, const dvec2&, int halvings) { return halvings < times; };
}

/// Crossings of a face's boundary, as cells take them.
std::vector<BoundaryCrossing> crossings_of(const SilhouetteView& view, std::uint32_t face)
{
    std::vector<BoundaryCrossing> crossings;
    CrossingSearch search(view.pose.shape, view.eye);
    for (std::uint32_t side = 0; side < 3; ++side) {
        const std::uint32_t h = 3 * face + side;
        for (const EdgeCrossing& crossing : search.along(h, {view.faces_eye(h), view.faces_eye(next_half_edge(h))})) {
            const PatchPoint at = on_half_edge(h, crossing.t);
            crossings.push_back({int(side), crossing.t, {at.v, at.w}});
        }
    }
    return crossings;
}

/// Closed contours that cross no edge: on them g is 0, and within them the surface is turned the other way.
TEST(ContourCells, FindLoopsWithinAFace)
{
    std::size_t loops = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        const ExactSubject subject(shaken(torus(6, 8), 0.7, seed));
        const LimitShape& shape = subject.pose().shape;
        for (int number = 0; number < 10; ++number) {
            const Camera camera = any_view(subject.bounds(), number);
            const SilhouetteView view{subject.pose(), PicturePlane(camera), searched_eye(camera, dvec3(0)), 0.25, 0, 0};
            for (std::uint32_t f = 0; f < subject.topology().triangles.size(); ++f) {
                if (!crossings_of(view, f).empty() || is_clear_of_contours(shape, view.eye, f))
                    continue;
                for (const ContourArc& arc : trace_contour(contour_cell(shape, view.eye, f), {}, halved(2))) {
                    ASSERT_EQ(arc.front(), arc.back());
                    dvec2 middle(0);
                    for (std::size_t i = 1; i < arc.size(); ++i) {
                        EXPECT_LT(std::abs(height_at(shape, view.eye, {f, arc[i].x, arc[i].y})), 1e-7);
                        middle += arc[i] / double(arc.size() - 1);
                    }
                    EXPECT_NE(height_at(shape, view.eye, {f, middle.x, middle.y}) >= 0, view.faces_eye(3 * f));
                    ++loops;
                }
            }
        }
    }
    EXPECT_GT(loops, 10u);
}

/// Every crossing is the end of one arc, and points of arcs lie on the contour.
TEST(ContourCells, JoinAllCrossings)
{
    std::size_t arcs = 0, many = 0;
    for (const auto& [name, mesh] : {NamedMesh{"crumpled", shaken(torus(6, 8), 0.7)}, NamedMesh{"bent-cylinder", make_control_sample("bent-cylinder")},
                                     NamedMesh{"bracket", make_control_sample("bracket")}}) {
        const ExactSubject subject(mesh);
        for (int number = 0; number < 6; ++number) {
            const Camera camera = any_view(subject.bounds(), number);
            const SilhouetteView view{subject.pose(), PicturePlane(camera), searched_eye(camera, dvec3(0)), 0.25, 0, 0};
            for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
                const std::vector<BoundaryCrossing> crossings = crossings_of(view, f);
                if (crossings.empty())
                    continue;
                std::size_t ends = 0;
                for (const ContourArc& arc : trace_contour(contour_cell(subject.pose().shape, view.eye, f), crossings, halved(2))) {
                    ++arcs;
                    if (arc.front() == arc.back())
                        continue;
                    for (const dvec2& end : {arc.front(), arc.back()})
                        ends += std::size_t(std::count_if(crossings.begin(), crossings.end(), [&](const BoundaryCrossing& c) { return c.at == end; }));
                }
                EXPECT_EQ(ends, crossings.size()) << name << ", view " << number << ", face " << f;
                many += crossings.size() > 2;
            }
        }
    }
    EXPECT_GT(arcs, 500u);
    EXPECT_GT(many, 5u);
}

} // namespace
} // namespace limn::test
