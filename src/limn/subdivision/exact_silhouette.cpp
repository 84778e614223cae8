#include "limn/subdivision/exact_silhouette.h"

#include <algorithm>
#include <optional>

#include "limn/base/parallel.h"
#include "limn/subdivision/acute_corners.h"
#include "limn/subdivision/silhouette_face.h"
#include "limn/subdivision/turned_triangle.h"

namespace limn {
namespace {

constexpr std::size_t grain = 64;

/// A control face as it is drawn; a single triangle where it is not cut.
struct DrawnFace {
    std::optional<CutFace> cut;
    FaceTriangles made;
};

bool is_plain(const CutFace& face) { return face.leaves.size() == 1 && face.leaves[0].arcs.empty(); }

bool has_edge_points(const LoopTopology& t, std::uint32_t face, const EdgePoints& edges)
{
    return !edges[t.edge[3 * face]].empty() || !edges[t.edge[3 * face + 1]].empty() || !edges[t.edge[3 * face + 2]].empty();
}

/// Whether a face drawn as one triangle shows the side that it should.
bool is_good_triangle(const SilhouetteView& view, std::uint32_t face, bool front)
{
    const uvec3& t = view.topology().triangles[face];
    const std::vector<dvec3>& p = view.pose.corners.positions;
    const DrawnTriangle whole{face, {dvec2(0, 0), dvec2(1, 0), dvec2(0, 1)}, {p[t.x], p[t.y], p[t.z]}, {}};
    const double turned = turned_beyond(view, whole, front);
    if (turned > 0 && turned > pixels_around(view, whole))
        return false;
    for (int k = 0; k < 3 && front && view.surface_pixels > 0; ++k) {
        const dvec3& middle = view.pose.middles[view.topology().edge[3 * face + std::uint32_t(k)]];
        if (middle_error(view.plane, p[t[k]], middle, p[t[(k + 1) % 3]]) > view.surface_pixels)
            return false;
    }
    return true;
}

class Maker {
public:
    Maker(SilhouetteView view, const Camera& camera, int deepest) : camera_(camera), view_(std::move(view)), deepest_(deepest), edges_(cut_edges(view_)), faces_(view_.topology().triangles.size()) {}

    void make()
    {
        std::vector<std::uint8_t> changed(faces_.size(), 0);
        parallel_each(faces_.size(), grain, [&](std::size_t f) {
            const std::uint32_t face = std::uint32_t(f);
            const bool whole = !has_edge_points(view_.topology(), face, edges_) && is_good_triangle(view_, face, view_.faces_eye(3 * face));
            if (whole && !may_hold_contour(view_, face, edges_))
                return;
            CutFace cut = cut_face(view_, face, edges_);
            if (whole && is_plain(cut))
                return;
            faces_[f].cut = std::move(cut);
            changed[f] = 1;
        });
        add_side_points(changed, changed);
        split_until_good(std::move(changed));
        if (view_.curve_points == 0)
            sharpen_corners();
    }
    SilhouetteMesh finish() const;
    ExactSilhouetteReport report() const;

private:
    /// Triangulates faces, and cuts what is not good enough in four until nothing is left.
    void split_until_good(std::vector<std::uint8_t> changed)
    {
        for (;;) {
            parallel_each(faces_.size(), grain, [&](std::size_t f) {
                if (changed[f])
                    faces_[f].made = triangulate_face(view_, *faces_[f].cut, edges_);
            });
            std::vector<std::uint8_t> split(faces_.size(), 0);
            parallel_each(faces_.size(), grain, [&](std::size_t f) { split[f] = changed[f] && split_bad(faces_[f]); });
            if (std::find(split.begin(), split.end(), 1) == split.end())
                break;
            changed = split;
            add_side_points(split, changed);
        }
    }
    /// Adds points where outlines cross at acute angles. Once they are nearer, their crossings and angles are better known.
    void sharpen_corners()
    {
        constexpr int most_rounds = 3;
        const OutlineMask covered = outline_mask(finish().mesh, camera_, 1, MaskFaces::front);
        std::vector<TightPlace> places;
        for (int round = 0; round < most_rounds; ++round) {
            const std::vector<TightPlace> found = acute_corners(covered, outlines(), 1.5 * view_.pixels, 0.05 * view_.pixels);
            places.insert(places.end(), found.begin(), found.end());
            view_.tight = LocalTolerance(places);
            std::vector<std::uint8_t> changed(faces_.size(), 0);
            if (view_.tight.empty() || !refine_outlines(changed))
                return;
            split_until_good(std::move(changed));
        }
    }
    /// @param changed  gains the faces whose points changed. @return whether there are any
    bool refine_outlines(std::vector<std::uint8_t>& changed)
    {
        const LoopTopology& t = view_.topology();
        parallel_each(faces_.size(), grain, [&](std::size_t f) {
            const std::uint32_t face = std::uint32_t(f);
            if (faces_[f].cut)
                changed[f] = touches_tight_place(face) && refine_arcs(view_, *faces_[f].cut);
            else if (!is_good_triangle(view_, face, view_.faces_eye(3 * face)))
                faces_[f].cut = cut_face(view_, face, edges_), changed[f] = 1;
        });
        for (std::uint32_t e = 0; e < edges_.size(); ++e)
            if (is_outline(view_, e, edges_[e]) && refine_edge(view_, e, edges_[e]))
                for (const std::uint32_t h : {t.half_edge[e], t.twin[t.half_edge[e]]})
                    if (h != none)
                        change(h / 3, changed);
        return std::find(changed.begin(), changed.end(), 1) != changed.end();
    }
    bool touches_tight_place(std::uint32_t f) const
    {
        const FaceTriangles& made = faces_[f].made;
        const auto at = [&](std::uint32_t p) { return position_of(view_, f, made.points[p], edges_, made.own); };
        for (const std::vector<std::uint32_t>& curve : made.curves)
            for (std::size_t i = 0; i + 1 < curve.size(); ++i)
                if (view_.pixels_along(at(curve[i]), at(curve[i + 1])) < view_.pixels)
                    return true;
        return false;
    }
    /// The contour, and the borders and sharp edges that are part of the outline, as they are drawn.
    std::vector<PictureLine> outlines() const
    {
        const LoopTopology& t = view_.topology();
        std::vector<PictureLine> lines;
        const bool closed = std::find(t.twin.begin(), t.twin.end(), none) == t.twin.end(); // else a surface may be seen from either side
        const auto add = [&](const dvec3& a, const dvec3& b, const dvec3& outside) {
            const std::array<dvec2, 2> pixels = {view_.plane.pixel(a), view_.plane.pixel(b)};
            if (view_.plane.is_in_picture(pixels))
                lines.push_back({pixels[0], pixels[1], view_.tight.along(pixels[0], pixels[1], view_.pixels), view_.plane.across(outside)});
        };
        for (std::uint32_t f = 0; f < faces_.size(); ++f) {
            const FaceTriangles& made = faces_[f].made;
            const auto at = [&](std::uint32_t p) { return position_of(view_, f, made.points[p], edges_, made.own); };
            for (const std::vector<std::uint32_t>& curve : made.curves)
                for (std::size_t i = 0; i + 1 < curve.size(); ++i)
                    add(at(curve[i]), at(curve[i + 1]), closed ? normal_of(f, made, curve[i]) : dvec3(0));
        }
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            if (!is_outline(view_, e, edges_[e]))
                continue;
            const std::uint32_t h = t.half_edge[e];
            dvec3 before = view_.pose.corners.positions[t.start(h)];
            const auto add_to = [&](const dvec3& end) {
                add(before, end, t.twin[h] == none ? glm::cross(end - before, view_.pose.middle_normals[e][0]) : dvec3(0));
                before = end;
            };
            for (const CutPoint& p : edges_[e])
                add_to(p.position);
            add_to(view_.pose.corners.positions[t.end(h)]);
        }
        return lines;
    }
    dvec3 normal_of(std::uint32_t f, const FaceTriangles& made, std::uint32_t p) const
    {
        const FacePoint& point = made.points[p];
        const std::uint32_t h = 3 * f + point.side;
        switch (point.of) {
        case FacePoint::Of::corner: return view_.pose.corners.normals[h];
        case FacePoint::Of::edge: return edges_[view_.topology().edge[h]][point.index].normals[view_.side_of(h)];
        default: return made.own[point.index].normal;
        }
    }
    void change(std::uint32_t face, std::vector<std::uint8_t>& changed)
    {
        changed[face] = 1;
        if (!faces_[face].cut)
            faces_[face].cut = cut_face(view_, face, edges_);
    }
    /// Cuts the leaves in four that are not good enough. @return whether there were any
    bool split_bad(DrawnFace& face) const
    {
        std::vector<bool> which = face.made.to_split;
        for (std::size_t i = 0; i < which.size(); ++i)
            which[i] = which[i] && face.cut->leaves[i].level < deepest_;
        if (std::find(which.begin(), which.end(), true) == which.end())
            return false;
        face.cut = split_leaves(view_, *face.cut, which);
        return true;
    }
    /// Cuts edges where leaves of some faces have corners. @param changed  gains the faces beside edges that were cut
    void add_side_points(const std::vector<std::uint8_t>& of, std::vector<std::uint8_t>& changed)
    {
        const LoopTopology& t = view_.topology();
        std::vector<std::uint32_t> beside;
        for (std::uint32_t f = 0; f < faces_.size(); ++f) {
            if (!of[f])
                continue;
            for (const SidePoint& point : side_points(*faces_[f].cut)) {
                const std::uint32_t h = 3 * f + std::uint32_t(point.side), e = t.edge[h];
                const bool runs = t.half_edge[e] == h;
                if (add_edge_point(view_, e, runs ? point.t : 1 - point.t, edges_[e]) && t.twin[h] != none)
                    beside.push_back(t.twin[h] / 3);
            }
        }
        for (const std::uint32_t f : beside)
            change(f, changed);
    }

    const Camera& camera_;
    SilhouetteView view_;
    int deepest_;
    EdgePoints edges_;
    std::vector<DrawnFace> faces_;
};

SilhouetteMesh Maker::finish() const
{
    const LoopTopology& t = view_.topology();
    SilhouetteMesh out;
    out.mesh.positions = view_.pose.corners.positions;
    std::vector<std::uint32_t> first_of_edge(edges_.size());
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        first_of_edge[e] = std::uint32_t(out.mesh.positions.size());
        for (const CutPoint& p : edges_[e])
            out.mesh.positions.push_back(p.position);
    }
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        const auto add_corner = [&](const dvec3& normal, const dvec2& at) {
            out.mesh.corner_normals.push_back(vec3(normal == dvec3(0) ? view_.pose.corners.normals[3 * f] : normal)); // 0: no tangent plane
            out.parameters.push_back(at);
        };
        if (!faces_[f].cut) {
            out.mesh.triangles.push_back(t.triangles[f]);
            out.faces.push_back(f);
            add_corner(view_.pose.corners.normals[3 * f], {0, 0});
            add_corner(view_.pose.corners.normals[3 * f + 1], {1, 0});
            add_corner(view_.pose.corners.normals[3 * f + 2], {0, 1});
            continue;
        }
        const FaceTriangles& made = faces_[f].made;
        const std::uint32_t first_own = std::uint32_t(out.mesh.positions.size());
        for (const SurfaceSample& sample : made.own)
            out.mesh.positions.push_back(sample.position);
        const auto vertex = [&](std::uint32_t p) {
            const FacePoint& point = made.points[p];
            return point.of == FacePoint::Of::corner ? t.triangles[f][int(point.side)]
                   : point.of == FacePoint::Of::edge ? first_of_edge[t.edge[3 * f + point.side]] + point.index
                                                     : first_own + point.index;
        };
        for (const uvec3& triangle : made.triangles) {
            out.mesh.triangles.push_back({vertex(triangle.x), vertex(triangle.y), vertex(triangle.z)});
            out.faces.push_back(f);
            for (int k = 0; k < 3; ++k) {
                const FacePoint& point = made.points[triangle[k]];
                const std::uint32_t h = 3 * f + point.side, e = t.edge[h];
                add_corner(point.of == FacePoint::Of::corner ? view_.pose.corners.normals[h]
                           : point.of == FacePoint::Of::edge ? edges_[e][point.index].normals[t.half_edge[e] == h ? 0 : 1]
                                                             : made.own[point.index].normal,
                           point.at);
            }
        }
        for (const std::vector<std::uint32_t>& curve : made.curves) {
            std::vector<std::uint32_t>& of_mesh = out.curves.emplace_back();
            for (const std::uint32_t p : curve)
                of_mesh.push_back(vertex(p));
        }
    }
    return out;
}

ExactSilhouetteReport Maker::report() const
{
    ExactSilhouetteReport report;
    for (const std::vector<CutPoint>& points : edges_) {
        std::size_t crossings[2] = {0, 0};
        for (const CutPoint& p : points)
            for (std::size_t side = 0; side < 2; ++side)
                crossings[side] += p.crossing[side];
        report.crossed_edges += crossings[0] + crossings[1] > 0;
        report.even_edges += (crossings[0] > 0 && crossings[0] % 2 == 0) || (crossings[1] > 0 && crossings[1] % 2 == 0);
    }
    for (const DrawnFace& face : faces_) {
        report.cut_faces += face.cut.has_value();
        report.curves += face.made.curves.size();
        report.turned_over = std::max(report.turned_over, face.made.most_turned);
    }
    return report;
}

/// The middle of a mesh's vertices.
dvec3 middle_of(std::span<const dvec3> positions)
{
    dvec3 sum(0);
    for (const dvec3& p : positions)
        sum += p;
    return positions.empty() ? sum : sum / double(positions.size());
}

} // namespace

SilhouetteMesh exact_silhouette(const SilhouettePose& pose, const Camera& camera, const ExactSilhouetteOptions& options, ExactSilhouetteReport* report)
{
    constexpr double share = 0.4; // of the error: for an arc, and again for triangles that show the wrong side beside it
    SilhouetteView view{pose, PicturePlane(camera), searched_eye(camera, middle_of(pose.corners.positions)), share * options.outline_error,
                              options.curve_points, options.surface_error};
    Maker maker(std::move(view), camera, options.deepest);
    maker.make();
    if (report)
        *report = maker.report();
    return maker.finish();
}

} // namespace limn
