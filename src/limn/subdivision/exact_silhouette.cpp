#include "limn/subdivision/exact_silhouette.h"

#include <algorithm>
#include <array>

#include "limn/base/parallel.h"
#include "limn/subdivision/acute_corners.h"
#include "limn/subdivision/silhouette_face.h"
#include "limn/subdivision/turned_triangle.h"

namespace limn {
namespace {

constexpr std::size_t grain = 256, cut_grain = 8, fill_grain = 512; ///< faces

/// A control face that is drawn as more than one triangle.
struct DrawnFace {
    CutFace cut;
    FaceTriangles made;
    bool changed = true; ///< since it was triangulated
};

bool is_plain(const CutFace& face) { return face.leaves.size() == 1 && face.leaves[0].arcs.empty(); }

bool has_edge_points(const LoopTopology& t, std::uint32_t face, const EdgePoints& edges)
{
    return edges.has_points(t.edge[3 * face]) || edges.has_points(t.edge[3 * face + 1]) || edges.has_points(t.edge[3 * face + 2]);
}

/// A face, drawn as one triangle.
struct WholeFace {
    bool is_good = true; ///< whether it shows the side that it should, or nearly so, and is near enough to the surface
    bool turned = false; ///< whether it sticks out beyond the surface, if by no more than it may
};

WholeFace whole_face(const SilhouetteView& view, std::uint32_t face, bool front)
{
    const uvec3& t = view.topology().triangles[face];
    const std::vector<dvec3>& p = view.pose.corners.positions;
    const DrawnTriangle whole{face, {dvec2(0, 0), dvec2(1, 0), dvec2(0, 1)}, {p[t.x], p[t.y], p[t.z]}, {}};
    const double turned = turned_beyond(view, whole, front);
    if (turned > 0 && turned > pixels_around(view, whole))
        return {false, true};
    for (int k = 0; k < 3 && front && view.surface_pixels > 0; ++k) {
        const dvec3& middle = view.pose.middles[view.topology().edge[3 * face + std::uint32_t(k)]];
        if (middle_error(view.plane, p[t[k]], middle, p[t[(k + 1) % 3]]) > view.surface_pixels)
            return {false, turned > 0};
    }
    return {true, turned > 0};
}

/// A face that is not known to be drawn as one triangle.
struct FaceToCut {
    std::uint32_t face;
    bool whole; ///< nothing asks for a cut but a contour
    bool holds; ///< a contour may be in it
    bool turned; ///< WholeFace::turned
};

/// How much of a mesh the faces before one have.
struct MeshCounts {
    std::size_t triangles = 0, own = 0, curves = 0;
};

class Maker {
public:
    Maker(SilhouetteView view, const Camera& camera, int deepest) : camera_(camera), view_(std::move(view)), deepest_(deepest), edges_(cut_edges(view_)), numbers_(view_.topology().triangles.size(), none) {}

    void make()
    {
        cut_faces();
        add_side_points();
        split_until_good();
        if (view_.curve_points == 0)
            sharpen_corners();
    }
    SilhouetteMesh finish() const;
    ExactSilhouetteReport report() const;

private:
    /// Triangulates changed faces, and cuts what is not good enough in four until nothing is left.
    void split_until_good()
    {
        for (;;) {
            parallel_each(drawn_.size(), cut_grain, [&](std::size_t i) {
                if (drawn_[i].changed)
                    drawn_[i].made = triangulate_face(view_, drawn_[i].cut, edges_);
            });
            parallel_each(drawn_.size(), cut_grain, [&](std::size_t i) { drawn_[i].changed = drawn_[i].changed && split_bad(drawn_[i]); });
            if (!is_any_changed())
                break;
            add_side_points();
        }
    }
    void cut_faces()
    {
        const std::vector<FaceToCut> to_cut = parallel_collect<FaceToCut>(numbers_.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<FaceToCut>& out) {
            for (std::uint32_t face = std::uint32_t(begin); face < end; ++face) {
                const WholeFace drawn = whole_face(view_, face, view_.faces_eye(3 * face));
                const bool whole = !has_edge_points(view_.topology(), face, edges_) && drawn.is_good;
                const bool holds = may_hold_contour(view_, face, edges_);
                if (!whole || holds || drawn.turned)
                    out.push_back({face, whole, holds, drawn.turned});
            }
        });
        drawn_.resize(to_cut.size());
        parallel_each(to_cut.size(), cut_grain, [&](std::size_t i) { drawn_[i].cut = cut_face(view_, to_cut[i].face, edges_, to_cut[i].holds); });
        std::size_t kept = 0;
        for (std::size_t i = 0; i < to_cut.size(); ++i) {
            if (to_cut[i].whole && is_plain(drawn_[i].cut)) {
                if (to_cut[i].turned)
                    turned_.push_back(to_cut[i].face);
                continue;
            }
            numbers_[to_cut[i].face] = std::uint32_t(kept);
            if (kept != i)
                drawn_[kept] = std::move(drawn_[i]);
            ++kept;
        }
        drawn_.resize(kept);
    }
    /// Adds points where outlines cross at acute angles. Once they are nearer, their crossings and angles are better known.
    void sharpen_corners()
    {
        constexpr int most_rounds = 3;
        constexpr double corner_share = 1.5, least_share = 0.05; // of what lines may be off elsewhere
        const std::vector<std::uint32_t> on_outline = outline_edges(view_, edges_);
        OutlineMask covered;
        std::vector<TightPlace> places;
        for (int round = 0; round < most_rounds; ++round) {
            const std::vector<AcuteCorner> corners = acute_corners(outlines(on_outline), corner_share * view_.pixels, least_share * view_.pixels);
            if (corners.empty())
                return;
            if (covered.bits.empty())
                covered = outline_mask(finish().mesh, camera_, 1, MaskFaces::front);
            const std::vector<TightPlace> found = beside_background(corners, covered);
            places.insert(places.end(), found.begin(), found.end());
            view_.tight = LocalTolerance(places);
            if (found.empty() || !refine_outlines(on_outline))
                return;
            split_until_good();
        }
    }
    /// Adds points where SilhouetteView::tight asks for them. @param on_outline  outline_edges @return whether faces changed
    bool refine_outlines(const std::vector<std::uint32_t>& on_outline)
    {
        parallel_each(drawn_.size(), cut_grain, [&](std::size_t i) { drawn_[i].changed = touches_tight_place(drawn_[i]) && refine_arcs(view_, drawn_[i].cut); });
        for (const std::uint32_t f : turned_)
            if (numbers_[f] == none && !whole_face(view_, f, view_.faces_eye(3 * f)).is_good)
                change(f);
        const LoopTopology& t = view_.topology();
        for (const std::uint32_t e : refine_edges(view_, on_outline, edges_))
            for (const std::uint32_t h : {t.half_edge[e], t.twin[t.half_edge[e]]})
                if (h != none)
                    change(h / 3);
        return is_any_changed();
    }
    bool touches_tight_place(const DrawnFace& face) const
    {
        const FaceTriangles& made = face.made;
        if (made.curves.empty())
            return false;
        const FaceEdges on_sides = face_edges(view_.topology(), face.cut.face, edges_);
        const auto at = [&](std::uint32_t p) { return position_of(view_, face.cut.face, made.points[p], on_sides, made.own); };
        for (const std::vector<std::uint32_t>& curve : made.curves)
            for (std::size_t i = 0; i + 1 < curve.size(); ++i)
                if (view_.pixels_along(at(curve[i]), at(curve[i + 1])) < view_.pixels)
                    return true;
        return false;
    }
    bool is_any_changed() const
    {
        return std::any_of(drawn_.begin(), drawn_.end(), [](const DrawnFace& face) { return face.changed; });
    }
    /// The contour, and the borders and sharp edges that are part of the outline, as they are drawn. @param on_outline  outline_edges
    std::vector<PictureLine> outlines(const std::vector<std::uint32_t>& on_outline) const
    {
        const LoopTopology& t = view_.topology();
        std::vector<PictureLine> lines;
        const bool closed = std::none_of(on_outline.begin(), on_outline.end(), [&](std::uint32_t e) { return t.is_border(e); }); // else a surface may be seen from either side
        const auto add = [&](const dvec3& a, const dvec3& b, const dvec3& outside) {
            const std::array<dvec2, 2> pixels = {view_.plane.pixel(a), view_.plane.pixel(b)};
            if (view_.plane.is_in_picture(pixels))
                lines.push_back({pixels[0], pixels[1], view_.tight.along(pixels[0], pixels[1], view_.pixels), view_.plane.across(outside)});
        };
        for (const DrawnFace& face : drawn_) {
            const std::uint32_t f = face.cut.face;
            const FaceTriangles& made = face.made;
            if (made.curves.empty())
                continue;
            const FaceEdges on_sides = face_edges(t, f, edges_);
            const auto at = [&](std::uint32_t p) { return position_of(view_, f, made.points[p], on_sides, made.own); };
            for (const std::vector<std::uint32_t>& curve : made.curves)
                for (std::size_t i = 0; i + 1 < curve.size(); ++i)
                    add(at(curve[i]), at(curve[i + 1]), closed ? normal_of(view_, f, made.points[curve[i]], on_sides, made.own) : dvec3(0));
        }
        for (const std::uint32_t e : on_outline) {
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
    /// Has a face triangulated again, or cut if it is not.
    void change(std::uint32_t f)
    {
        if (numbers_[f] == none) {
            numbers_[f] = std::uint32_t(drawn_.size());
            drawn_.emplace_back().cut = cut_face(view_, f, edges_, may_hold_contour(view_, f, edges_));
        }
        drawn_[numbers_[f]].changed = true;
    }
    /// Cuts the leaves in four that are not good enough. @return whether there were any
    bool split_bad(DrawnFace& face) const
    {
        std::vector<bool> which = face.made.to_split;
        for (std::size_t i = 0; i < which.size(); ++i)
            which[i] = which[i] && face.cut.leaves[i].level < deepest_;
        if (std::find(which.begin(), which.end(), true) == which.end())
            return false;
        face.cut = split_leaves(view_, face.cut, which);
        return true;
    }
    /// Cuts edges where leaves of changed faces have corners; the faces beside those edges change too.
    void add_side_points()
    {
        const LoopTopology& t = view_.topology();
        std::vector<std::uint32_t> beside;
        std::vector<EdgePlace> places;
        for (const DrawnFace& face : drawn_) {
            if (!face.changed)
                continue;
            for (const SidePoint& point : side_points(face.cut)) {
                const std::uint32_t h = 3 * face.cut.face + std::uint32_t(point.side), e = t.edge[h];
                const EdgePlace place = {e, t.half_edge[e] == h ? point.t : 1 - point.t};
                if (has_point(edges_[e], place.t))
                    continue;
                places.push_back(place);
                if (t.twin[h] != none)
                    beside.push_back(t.twin[h] / 3);
            }
        }
        add_edge_points(view_, std::move(places), edges_);
        for (const std::uint32_t f : beside)
            change(f);
    }
    std::vector<MeshCounts> counts() const
    {
        std::vector<MeshCounts> before(numbers_.size() + 1);
        for (std::size_t f = 0; f < numbers_.size(); ++f) {
            before[f + 1] = before[f];
            if (numbers_[f] == none) {
                ++before[f + 1].triangles;
                continue;
            }
            const FaceTriangles& made = drawn_[numbers_[f]].made;
            before[f + 1].triangles += made.triangles.size(), before[f + 1].own += made.own.size(), before[f + 1].curves += made.curves.size();
        }
        return before;
    }
    void fill_whole(std::uint32_t f, std::size_t at, SilhouetteMesh& out) const;
    void fill_cut(std::uint32_t f, const MeshCounts& at, SilhouetteMesh& out) const;
    void fill_corner(std::uint32_t f, const dvec3& normal, const dvec2& at, std::size_t corner, SilhouetteMesh& out) const
    {
        out.mesh.corner_normals[corner] = vec3(normal == dvec3(0) ? view_.pose.corners.normals[3 * f] : normal); // 0: no tangent plane
        out.parameters[corner] = at;
    }

    const Camera& camera_;
    SilhouetteView view_;
    int deepest_;
    EdgePoints edges_;
    std::vector<std::uint32_t> numbers_; ///< per face: its number among those drawn as more than one triangle, or `none`
    std::vector<DrawnFace> drawn_;
    std::vector<std::uint32_t> turned_; ///< faces drawn as one triangle that shows the wrong side, by less than it may
};

/// Vertices: the control mesh's, those on edges, then each face's own.
SilhouetteMesh Maker::finish() const
{
    const std::vector<MeshCounts> before = counts();
    const std::size_t triangles = before.back().triangles, vertices = view_.pose.corners.positions.size();
    SilhouetteMesh out;
    out.mesh.positions.reserve(vertices + edges_.all().size() + before.back().own);
    out.mesh.positions = view_.pose.corners.positions;
    for (const CutPoint& p : edges_.all())
        out.mesh.positions.push_back(p.position);
    out.mesh.positions.resize(vertices + edges_.all().size() + before.back().own);
    out.mesh.triangles.resize(triangles);
    out.mesh.corner_normals.resize(3 * triangles);
    out.faces.resize(triangles);
    out.parameters.resize(3 * triangles);
    out.curves.resize(before.back().curves);
    parallel_each(numbers_.size(), fill_grain, [&](std::size_t f) {
        if (numbers_[f] == none)
            fill_whole(std::uint32_t(f), before[f].triangles, out);
        else
            fill_cut(std::uint32_t(f), before[f], out);
    });
    return out;
}

void Maker::fill_whole(std::uint32_t f, std::size_t at, SilhouetteMesh& out) const
{
    constexpr dvec2 corners[3] = {{0, 0}, {1, 0}, {0, 1}};
    out.mesh.triangles[at] = view_.topology().triangles[f];
    out.faces[at] = f;
    for (std::uint32_t k = 0; k < 3; ++k)
        fill_corner(f, view_.pose.corners.normals[3 * f + k], corners[k], 3 * at + k, out);
}

void Maker::fill_cut(std::uint32_t f, const MeshCounts& at, SilhouetteMesh& out) const
{
    const LoopTopology& t = view_.topology();
    const FaceTriangles& made = drawn_[numbers_[f]].made;
    const std::size_t first_on_edges = view_.pose.corners.positions.size(), first_own = first_on_edges + edges_.all().size() + at.own;
    for (std::size_t i = 0; i < made.own.size(); ++i)
        out.mesh.positions[first_own + i] = made.own[i].position;
    const FaceEdges on_sides = face_edges(t, f, edges_);
    std::array<std::size_t, 3> first_on_side;
    for (std::uint32_t k = 0; k < 3; ++k)
        first_on_side[k] = on_sides[k].empty() ? 0 : first_on_edges + edges_.number(on_sides[k]);
    const auto vertex = [&](std::uint32_t p) {
        const FacePoint& point = made.points[p];
        return point.of == FacePoint::Of::corner ? t.triangles[f][int(point.side)]
               : point.of == FacePoint::Of::edge ? std::uint32_t(first_on_side[point.side]) + point.index
                                                 : std::uint32_t(first_own) + point.index;
    };
    for (std::size_t i = 0; i < made.triangles.size(); ++i) {
        const uvec3& triangle = made.triangles[i];
        const std::size_t number = at.triangles + i;
        out.mesh.triangles[number] = {vertex(triangle.x), vertex(triangle.y), vertex(triangle.z)};
        out.faces[number] = f;
        for (int k = 0; k < 3; ++k) {
            const FacePoint& point = made.points[triangle[k]];
            fill_corner(f, normal_of(view_, f, point, on_sides, made.own), point.at, 3 * number + std::size_t(k), out);
        }
    }
    for (std::size_t i = 0; i < made.curves.size(); ++i) {
        std::vector<std::uint32_t>& curve = out.curves[at.curves + i];
        curve.resize(made.curves[i].size());
        std::transform(made.curves[i].begin(), made.curves[i].end(), curve.begin(), vertex);
    }
}

ExactSilhouetteReport Maker::report() const
{
    ExactSilhouetteReport report;
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
        std::size_t crossings[2] = {0, 0};
        for (const CutPoint& p : edges_[e])
            for (std::size_t side = 0; side < 2; ++side)
                crossings[side] += p.crossing[side];
        report.crossed_edges += crossings[0] + crossings[1] > 0;
        report.even_edges += (crossings[0] > 0 && crossings[0] % 2 == 0) || (crossings[1] > 0 && crossings[1] % 2 == 0);
    }
    report.cut_faces = drawn_.size();
    for (const DrawnFace& face : drawn_) {
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
