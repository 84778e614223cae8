#include "limn/subdivision/seed_silhouette.h"

#include <algorithm>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/subdivision/pn_curve.h"
#include "limn/subdivision/sharp_outlines.h"

namespace limn {
namespace {

constexpr std::size_t grain = 2048;
constexpr int most_curve_points = 4096;

/// A corner of a triangle that is made: a vertex with what it has in one face.
struct Corner {
    std::uint32_t vertex = 0;
    dvec3 normal;
    dvec2 parameter;
};

constexpr dvec2 corner_parameters[3] = {{0, 0}, {1, 0}, {0, 1}};

/// What makes a face more than one triangle.
struct Cuts {
    std::size_t crossed = 0; ///< faces that the contour crosses
    std::size_t strips = 0;  ///< those of them with a strip
    std::size_t marks = 0;   ///< points on sharp edges of faces that are not the face's own crossings
    friend Cuts operator+(const Cuts& a, const Cuts& b) { return {a.crossed + b.crossed, a.strips + b.strips, a.marks + b.marks}; }
};

class Builder {
public:
    Builder(const SeedSurface& surface, const SeedPose& pose, const SeedCrossings& found, const SeedOptions& options)
        : s_(surface), pose_(pose), found_(found), pieces_(std::uint32_t(options.curve_points)), strip_(options.triangulation == SeedTriangulation::strip),
          first_crossing_(std::uint32_t(pose.positions.size())),
          outlines_(surface, found, options.curve_points, first_crossing_ + std::uint32_t(found.crossings.size()))
    {
        count_cuts();
        const Cuts& all = cuts_before_.back();
        const std::size_t triangles = triangles_before(s_.topology.triangles.size(), all);
        if (triangles >= none / 3)
            throw Error::Input(fmt::format("a silhouette of {} triangles: {} are the most there can be", triangles, none / 3));
        out_.mesh.positions = pose_.positions;
        for (const SeedCrossing& c : found_.crossings)
            out_.mesh.positions.push_back(c.position);
        out_.mesh.positions.resize(first_inner_vertex(all));
        outlines_.set_positions(pose_.fine, out_.mesh.positions);
        out_.mesh.triangles.resize(triangles);
        out_.mesh.corner_normals.resize(3 * triangles);
        out_.faces.resize(triangles);
        out_.parameters.resize(3 * triangles);
        out_.curves.resize(all.crossed);
    }

    SilhouetteMesh build()
    {
        parallel_blocks(s_.topology.triangles.size(), grain, [&](std::size_t begin, std::size_t end) {
            Working working;
            Cuts before = cuts_before_[begin / grain];
            for (std::uint32_t f = std::uint32_t(begin); f < end; ++f) {
                const Cuts own = cuts_of(f);
                working.first = working.next = triangles_before(f, before);
                if (own.crossed > 0)
                    cut(f, before, own.strips > 0, working);
                else
                    add(f, control_corner(f, 0), control_corner(f, 1), control_corner(f, 2), working);
                for (std::uint32_t k = 0; own.marks > 0 && k < 3; ++k)
                    if (outlines_.is_outline(s_.topology.edge[3 * f + k]))
                        insert_marks(f, k, working);
                before = before + own;
            }
        });
        return std::move(out_);
    }

private:
    /// What a thread works with, face by face.
    struct Working {
        std::size_t first = 0, next = 0; ///< the triangles of the face are made from `first` on
        std::vector<Corner> curve, base;
        std::vector<SharpOutlines::Mark> marks;
    };

    /// A crossed face without a strip is 2 M + 1 triangles and has M - 1 vertices within; a strip adds M - 1 of both, a mark one triangle.
    std::size_t triangles_before(std::size_t faces, const Cuts& cuts) const
    {
        return faces + cuts.crossed * 2 * pieces_ + cuts.strips * (pieces_ - 1) + cuts.marks;
    }
    std::size_t first_inner_vertex(const Cuts& before) const
    {
        return first_crossing_ + found_.crossings.size() + outlines_.vertex_count() + (before.crossed + before.strips) * (pieces_ - 1);
    }

    bool faces_eye(std::uint32_t f, std::uint32_t k) const { return found_.facing[s_.sector[3 * f + k]]; }
    /// The corner that differs from both others in facing the eye; only of crossed faces.
    std::uint32_t apex(std::uint32_t f) const { return faces_eye(f, 0) == faces_eye(f, 1) ? 2 : faces_eye(f, 0) == faces_eye(f, 2) ? 1 : 0; }
    bool is_forward(std::uint32_t h) const { return s_.topology.half_edge[s_.topology.edge[h]] == h; }

    Cuts cuts_of(std::uint32_t f) const
    {
        Cuts cuts;
        cuts.crossed = faces_eye(f, 0) != faces_eye(f, 1) || faces_eye(f, 1) != faces_eye(f, 2);
        cuts.strips = cuts.crossed > 0 && strip_ && !outlines_.is_outline(s_.topology.edge[3 * f + (apex(f) + 1) % 3]);
        for (std::uint32_t h = 3 * f; h < 3 * f + 3; ++h)
            if (outlines_.is_outline(s_.topology.edge[h]))
                cuts.marks += outlines_.count(s_.topology.edge[h]) - (found_.of(s_.side[h]) != none);
        return cuts;
    }

    /// Per block of faces, the cuts of those before it; at the end, of all.
    void count_cuts()
    {
        const std::size_t faces = s_.topology.triangles.size();
        std::vector<Cuts> count((faces + grain - 1) / grain);
        parallel_blocks(faces, grain, [&](std::size_t begin, std::size_t end) {
            for (std::uint32_t f = std::uint32_t(begin); f < end; ++f)
                count[begin / grain] = count[begin / grain] + cuts_of(f);
        });
        cuts_before_.assign(1, {});
        for (const Cuts& c : count)
            cuts_before_.push_back(cuts_before_.back() + c);
    }

    Corner control_corner(std::uint32_t f, std::uint32_t k) const
    {
        return {s_.topology.triangles[f][int(k)], pose_.normals[s_.sector[3 * f + k]], corner_parameters[k]};
    }

    /// How far along a half-edge its own crossing counts as being.
    double place(std::uint32_t h, const SeedCrossing& c) const
    {
        const double t = outlines_.is_outline(s_.topology.edge[h]) ? c.along : c.chord;
        return is_forward(h) ? t : 1 - t;
    }

    /// The crossing on the edge from corner k of a face to the next.
    Corner crossing_corner(std::uint32_t f, std::uint32_t k) const
    {
        const std::uint32_t h = 3 * f + k, number = found_.of(s_.side[h]);
        const SeedCrossing& c = found_.crossings[number];
        return {first_crossing_ + number, c.normal, glm::mix(corner_parameters[k], corner_parameters[(k + 1) % 3], place(h, c))};
    }

    void set(std::size_t at, const Corner& corner)
    {
        out_.mesh.triangles[at / 3][int(at % 3)] = corner.vertex;
        out_.mesh.corner_normals[at] = vec3(corner.normal);
        out_.parameters[at] = corner.parameter;
    }
    void add(std::uint32_t face, const Corner& a, const Corner& b, const Corner& c, Working& working)
    {
        const std::size_t triangle = working.next++;
        out_.faces[triangle] = face;
        set(3 * triangle, a), set(3 * triangle + 1, b), set(3 * triangle + 2, c);
    }

    /// From a to b in pieces_ pieces, normals and parameters linear. @param vertex  the first of those between them @param at  gives their places
    template <class F> void trace(const Corner& a, const Corner& b, std::uint32_t vertex, F&& at, std::vector<Corner>& points)
    {
        points.clear();
        points.push_back(a);
        for (std::uint32_t i = 1; i < pieces_; ++i) {
            const double t = double(i) / double(pieces_);
            out_.mesh.positions[vertex] = at(t);
            points.push_back({vertex++, mixed_normal(a.normal, b.normal, t), glm::mix(a.parameter, b.parameter, t)});
        }
        points.push_back(b);
    }

    void cut(std::uint32_t f, const Cuts& before, bool with_strip, Working& working)
    {
        const std::uint32_t k = apex(f); // and the others, counter-clockwise:
        const Corner tip = control_corner(f, k), b = control_corner(f, (k + 1) % 3), c = control_corner(f, (k + 2) % 3);
        const Corner first = crossing_corner(f, k), last = crossing_corner(f, (k + 2) % 3);
        const std::vector<dvec3>& p = out_.mesh.positions;
        const std::uint32_t inner = std::uint32_t(first_inner_vertex(before));
        const PnCurve pn(p[first.vertex], first.normal, p[last.vertex], last.normal);
        const std::vector<Corner>& curve = working.curve;
        trace(first, last, inner, [&](double t) { return pn.at(t); }, working.curve);
        for (std::uint32_t i = 0; i < pieces_; ++i)
            add(f, tip, curve[i], curve[i + 1], working);
        if (with_strip) {
            trace(b, c, inner + pieces_ - 1, [&](double t) { return glm::mix(p[b.vertex], p[c.vertex], t); }, working.base);
            add_strip(f, working);
        } else {
            add_slivers(f, b, c, working);
        }
        keep_curve(before.crossed, curve, faces_eye(f, k));
    }

    void add_strip(std::uint32_t f, Working& working)
    {
        const std::vector<Corner>& curve = working.curve;
        const std::vector<Corner>& base = working.base;
        for (std::uint32_t i = 0; i < pieces_; ++i) {
            add(f, curve[i], base[i], base[i + 1], working);
            add(f, curve[i], base[i + 1], curve[i + 1], working);
        }
    }

    /// The first half of the curve to b, the last to c, and a triangle between.
    void add_slivers(std::uint32_t f, const Corner& b, const Corner& c, Working& working)
    {
        const std::vector<Corner>& curve = working.curve;
        const std::uint32_t middle = pieces_ / 2;
        for (std::uint32_t i = 0; i < middle; ++i)
            add(f, curve[i], b, curve[i + 1], working);
        add(f, curve[middle], b, c, working);
        for (std::uint32_t i = middle; i < pieces_; ++i)
            add(f, curve[i], c, curve[i + 1], working);
    }

    /// @param apex_faces  the apex, on the left of the curve as it was traced, faces the eye
    void keep_curve(std::size_t rank, const std::vector<Corner>& curve, bool apex_faces)
    {
        std::vector<std::uint32_t>& line = out_.curves[rank];
        line.reserve(curve.size());
        for (const Corner& c : curve)
            line.push_back(c.vertex);
        if (!apex_faces)
            std::reverse(line.begin(), line.end());
    }

    /// Puts the points of a sharp edge that the face's triangles do not have yet into them.
    void insert_marks(std::uint32_t f, std::uint32_t k, Working& working)
    {
        const std::uint32_t h = 3 * f + k, e = s_.topology.edge[h];
        const bool forward = is_forward(h), is_crossed = found_.of(s_.side[h]) != none;
        outlines_.gather(e, first_crossing_, working.marks);
        if (!forward)
            std::reverse(working.marks.begin(), working.marks.end());
        const Corner last = control_corner(f, (k + 1) % 3), own = is_crossed ? crossing_corner(f, k) : last;
        Corner from = control_corner(f, k), to = own;
        for (const SharpOutlines::Mark& mark : working.marks) {
            if (is_crossed && mark.vertex == own.vertex) {
                from = own, to = last;
                continue;
            }
            const dvec2 parameter = glm::mix(corner_parameters[k], corner_parameters[(k + 1) % 3], forward ? mark.t : 1 - mark.t);
            const Corner at{mark.vertex, normal_at(e, mark, !forward, from, to, parameter), parameter};
            split(f, from, at, to, working);
            from = at;
        }
    }

    /// Of the surface on the face's own side; at the other side's crossing linear between its neighbours.
    dvec3 normal_at(std::uint32_t e, const SharpOutlines::Mark& mark, bool right, const Corner& from, const Corner& to, const dvec2& parameter) const
    {
        const double whole = glm::distance(from.parameter, to.parameter);
        const dvec3 linear = mixed_normal(from.normal, to.normal, whole > 0 ? glm::distance(from.parameter, parameter) / whole : 0);
        if (mark.row == none)
            return linear;
        const dvec3 normal = outlines_.point(e, mark.row, right, pose_.fine).normal;
        return normal == dvec3(0) ? linear : normal;
    }

    /// Cuts the face's triangle with the side from - to in two.
    void split(std::uint32_t f, const Corner& from, const Corner& at, const Corner& to, Working& working)
    {
        for (std::size_t h = 3 * working.first; h < 3 * working.next; ++h) {
            const std::size_t after = h % 3 == 2 ? h - 2 : h + 1, across = h % 3 == 0 ? h + 2 : h - 1;
            const auto vertex = [&](std::size_t corner) { return out_.mesh.triangles[corner / 3][int(corner % 3)]; };
            if (vertex(h) != from.vertex || vertex(after) != to.vertex)
                continue;
            const Corner tip{vertex(across), dvec3(out_.mesh.corner_normals[across]), out_.parameters[across]};
            set(after, at);
            add(f, at, to, tip, working);
            return;
        }
    }

    const SeedSurface& s_;
    const SeedPose& pose_;
    const SeedCrossings& found_;
    std::uint32_t pieces_;
    bool strip_;
    std::uint32_t first_crossing_; ///< the vertex of the first crossing
    SharpOutlines outlines_;
    std::vector<Cuts> cuts_before_;
    SilhouetteMesh out_;
};

} // namespace

SilhouetteMesh seed_silhouette(const SeedSurface& surface, const SeedPose& pose, const Eye& eye, const SeedOptions& options)
{
    if (options.curve_points < 1 || options.curve_points > most_curve_points)
        throw Error::Input(fmt::format("{} curve points: 1 to {} are possible", options.curve_points, most_curve_points));
    return Builder(surface, pose, find_seed_crossings(surface, pose, eye, options.depth), options).build();
}

} // namespace limn
