#include "limn/subdivision/seed_silhouette.h"

#include <algorithm>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/subdivision/pn_curve.h"

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
    std::uint32_t crossed = 0; ///< faces that the contour crosses
    std::uint32_t foreign = 0; ///< crossings on the other side of their creases
    friend Cuts operator+(const Cuts& a, const Cuts& b) { return {a.crossed + b.crossed, a.foreign + b.foreign}; }
};

class Builder {
public:
    Builder(const SeedSurface& surface, const SeedPose& pose, const SeedCrossings& found, const SeedOptions& options)
        : s_(surface), pose_(pose), found_(found), pieces_(std::uint32_t(options.curve_points)), strip_(options.triangulation == SeedTriangulation::strip)
    {
        count_cuts();
        const std::size_t triangles = triangles_before(s_.topology.triangles.size(), cuts_before_.back());
        if (triangles >= none / 3)
            throw Error::Input(fmt::format("a silhouette of {} triangles: {} are the most there can be", triangles, none / 3));
        const std::size_t crossed = cuts_before_.back().crossed;
        out_.mesh.positions = pose_.positions;
        for (const Crossing& c : found_.crossings)
            out_.mesh.positions.push_back(c.position);
        out_.mesh.positions.resize(out_.mesh.positions.size() + crossed * vertices_each());
        out_.mesh.triangles.resize(triangles);
        out_.mesh.corner_normals.resize(3 * triangles);
        out_.faces.resize(triangles);
        out_.parameters.resize(3 * triangles);
        out_.curves.resize(crossed);
    }

    SilhouetteMesh build()
    {
        parallel_blocks(s_.topology.triangles.size(), grain, [&](std::size_t begin, std::size_t end) {
            Working working;
            Cuts before = cuts_before_[begin / grain];
            for (std::uint32_t f = std::uint32_t(begin); f < end; ++f) {
                const Cuts own = cuts_of(f);
                working.first = working.next = triangles_before(f, before);
                working.splits.clear();
                if (own.crossed > 0)
                    cut(f, before.crossed, working);
                else
                    add(f, control_corner(f, 0), control_corner(f, 1), control_corner(f, 2), working);
                if (own.foreign > 0)
                    split(f, working);
                before = before + own;
            }
        });
        return std::move(out_);
    }

private:
    /// A crossing from across a crease, between two corners that the face has on this edge.
    struct Split {
        Corner from, at, to;
    };
    /// What a thread works with, face by face.
    struct Working {
        std::size_t first = 0, next = 0; ///< the triangles of the face are made from `first` on
        std::vector<Corner> curve, base;
        std::vector<Split> splits;
    };

    std::size_t triangles_each() const { return strip_ ? 3 * pieces_ : 2 * pieces_ + 1; }
    std::size_t vertices_each() const { return (strip_ ? 2 : 1) * (pieces_ - 1); }
    std::size_t triangles_before(std::size_t faces, const Cuts& cuts) const { return faces + cuts.crossed * (triangles_each() - 1) + cuts.foreign; }
    bool faces_eye(std::uint32_t f, std::uint32_t k) const { return found_.facing[s_.sector[3 * f + k]]; }

    /// The number of the crossing that the face across a half-edge has there for itself, or `none`.
    std::uint32_t foreign_crossing(std::uint32_t h) const
    {
        const std::uint32_t over = s_.topology.twin[h];
        return over == none || s_.side[over] == s_.side[h] ? none : found_.of(s_.side[over]);
    }

    Cuts cuts_of(std::uint32_t f) const
    {
        Cuts cuts;
        cuts.crossed = faces_eye(f, 0) != faces_eye(f, 1) || faces_eye(f, 1) != faces_eye(f, 2);
        if (!s_.two_sided.empty())
            for (std::uint32_t k = 0; k < 3; ++k)
                cuts.foreign += foreign_crossing(3 * f + k) != none;
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

    /// How far along a half-edge a crossing of its edge is.
    double along(std::uint32_t h, const Crossing& c) const { return s_.topology.half_edge[s_.topology.edge[h]] == h ? c.chord : 1 - c.chord; }

    std::uint32_t crossing_vertex(std::uint32_t number) const { return std::uint32_t(pose_.positions.size()) + number; }

    /// The crossing on the edge from corner k of a face to the next.
    Corner crossing_corner(std::uint32_t f, std::uint32_t k) const
    {
        const std::uint32_t h = 3 * f + k, number = found_.of(s_.side[h]);
        const Crossing& c = found_.crossings[number];
        return {crossing_vertex(number), c.normal, glm::mix(corner_parameters[k], corner_parameters[(k + 1) % 3], along(h, c))};
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

    static Corner between(const Corner& a, const Corner& b, double t, std::uint32_t vertex)
    {
        return {vertex, mixed_normal(a.normal, b.normal, t), glm::mix(a.parameter, b.parameter, t)};
    }

    /// From a to b in pieces_ pieces, normals and parameters linear. @param vertex  the first of those between them @param at  gives their places
    template <class F> void trace(const Corner& a, const Corner& b, std::uint32_t vertex, F&& at, std::vector<Corner>& points)
    {
        points.clear();
        points.push_back(a);
        for (std::uint32_t i = 1; i < pieces_; ++i) {
            const double t = double(i) / double(pieces_);
            out_.mesh.positions[vertex] = at(t);
            points.push_back(between(a, b, t, vertex++));
        }
        points.push_back(b);
    }

    /// @param rank  how many crossed faces come before
    void cut(std::uint32_t f, std::uint32_t rank, Working& working)
    {
        // The corner that differs from both others, and these, counter-clockwise.
        const std::uint32_t k = faces_eye(f, 0) == faces_eye(f, 1) ? 2 : faces_eye(f, 0) == faces_eye(f, 2) ? 1 : 0;
        const Corner apex = control_corner(f, k), b = control_corner(f, (k + 1) % 3), c = control_corner(f, (k + 2) % 3);
        const Corner first = crossing_corner(f, k), last = crossing_corner(f, (k + 2) % 3);
        const std::vector<dvec3>& p = out_.mesh.positions;
        const std::uint32_t inner = crossing_vertex(std::uint32_t(found_.crossings.size() + rank * vertices_each()));
        const PnCurve pn(p[first.vertex], first.normal, p[last.vertex], last.normal);
        std::vector<Corner>& curve = working.curve;
        trace(first, last, inner, [&](double t) { return pn.at(t); }, curve);
        for (std::uint32_t i = 0; i < pieces_; ++i)
            add(f, apex, curve[i], curve[i + 1], working);
        if (strip_) {
            trace_base(b, c, 3 * f + (k + 1) % 3, inner + pieces_ - 1, working);
            add_strip(f, working);
        } else {
            add_slivers(f, b, c, working);
        }
        keep_curve(rank, curve, faces_eye(f, k));
    }

    /// The side across from the apex: straight, or by way of the crossing that the face across a crease has on it.
    void trace_base(const Corner& b, const Corner& c, std::uint32_t h, std::uint32_t inner, Working& working)
    {
        const std::vector<dvec3>& p = out_.mesh.positions;
        const std::uint32_t foreign = foreign_crossing(h);
        if (foreign == none) {
            trace(b, c, inner, [&](double t) { return glm::mix(p[b.vertex], p[c.vertex], t); }, working.base);
            return;
        }
        const dvec3& middle = found_.crossings[foreign].position;
        const double s = along(h, found_.crossings[foreign]);
        trace(b, c, inner, [&](double t) { return t <= s ? glm::mix(p[b.vertex], middle, t / s) : glm::mix(middle, p[c.vertex], (t - s) / (1 - s)); }, working.base);
        const std::uint32_t i = std::min(std::uint32_t(s * pieces_), pieces_ - 1);
        working.splits.push_back({working.base[i], between(b, c, s, crossing_vertex(foreign)), working.base[i + 1]});
    }

    void add_strip(std::uint32_t f, Working& working)
    {
        const std::vector<Corner>&curve = working.curve, &base = working.base;
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
    void keep_curve(std::uint32_t rank, const std::vector<Corner>& curve, bool apex_faces)
    {
        std::vector<std::uint32_t>& line = out_.curves[rank];
        line.reserve(curve.size());
        for (const Corner& c : curve)
            line.push_back(c.vertex);
        if (!apex_faces)
            std::reverse(line.begin(), line.end());
    }

    /// Puts the crossings from across the face's creases into its triangles.
    void split(std::uint32_t f, Working& working)
    {
        const bool has_base = !working.splits.empty();
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t h = 3 * f + k, foreign = foreign_crossing(h), own = found_.of(s_.side[h]);
            if (foreign == none || (own == none && has_base))
                continue;
            const double s = along(h, found_.crossings[foreign]);
            Split split{control_corner(f, k), {}, control_corner(f, (k + 1) % 3)};
            double from = 0, to = 1;
            if (own != none) {
                const double t = along(h, found_.crossings[own]);
                const bool is_before = s != t ? s < t : (foreign < own) == (s_.topology.half_edge[s_.topology.edge[h]] == h);
                (is_before ? split.to : split.from) = crossing_corner(f, k);
                (is_before ? to : from) = t;
            }
            split.at = between(split.from, split.to, to > from ? (s - from) / (to - from) : 0, crossing_vertex(foreign));
            working.splits.push_back(split);
        }
        for (const Split& one : working.splits)
            split_triangle(f, one, working);
    }

    /// Cuts the triangle with that side in two.
    void split_triangle(std::uint32_t f, const Split& split, Working& working)
    {
        for (std::size_t h = 3 * working.first; h < 3 * working.next; ++h) {
            const std::size_t after = h % 3 == 2 ? h - 2 : h + 1, across = h % 3 == 0 ? h + 2 : h - 1;
            const auto vertex = [&](std::size_t at) { return out_.mesh.triangles[at / 3][int(at % 3)]; };
            if (vertex(h) != split.from.vertex || vertex(after) != split.to.vertex)
                continue;
            const Corner tip{vertex(across), dvec3(out_.mesh.corner_normals[across]), out_.parameters[across]};
            set(after, split.at);
            add(f, split.at, split.to, tip, working);
            return;
        }
    }

    const SeedSurface& s_;
    const SeedPose& pose_;
    const SeedCrossings& found_;
    std::uint32_t pieces_;
    bool strip_;
    std::vector<Cuts> cuts_before_;
    SilhouetteMesh out_;
};

} // namespace

SilhouetteMesh seed_silhouette(const SeedSurface& surface, const SeedPose& pose, const Eye& eye, const SeedOptions& options)
{
    if (options.curve_points < 1 || options.curve_points > most_curve_points)
        throw Error::Input(fmt::format("{} curve points: 1 to {} are possible", options.curve_points, most_curve_points));
    return Builder(surface, pose, find_crossings(surface, pose, eye, options.depth), options).build();
}

} // namespace limn
