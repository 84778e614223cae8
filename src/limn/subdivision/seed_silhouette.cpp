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

class Builder {
public:
    Builder(const SeedSurface& surface, const SeedPose& pose, const SeedCrossings& found, const SeedOptions& options)
        : s_(surface), pose_(pose), found_(found), pieces_(std::uint32_t(options.curve_points)), strip_(options.triangulation == SeedTriangulation::strip)
    {
        count_crossed();
        const std::size_t faces = s_.topology.triangles.size(), crossed = crossed_before_.back();
        const std::size_t triangles = faces + crossed * (triangles_each() - 1);
        if (triangles >= none / 3)
            throw Error::Input(fmt::format("a silhouette of {} triangles: {} are the most there can be", triangles, none / 3));
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
            std::vector<Corner> curve, base;
            std::uint32_t crossed = crossed_before_[begin / grain];
            for (std::uint32_t f = std::uint32_t(begin); f < end; ++f) {
                const std::size_t first = f + crossed * (triangles_each() - 1);
                if (is_crossed(f))
                    cut(f, crossed++, first, curve, base);
                else
                    add(first, f, control_corner(f, 0), control_corner(f, 1), control_corner(f, 2));
            }
        });
        return std::move(out_);
    }

private:
    std::size_t triangles_each() const { return strip_ ? 3 * pieces_ : 2 * pieces_ + 1; }
    std::size_t vertices_each() const { return (strip_ ? 2 : 1) * (pieces_ - 1); }
    bool faces_eye(std::uint32_t f, std::uint32_t k) const { return found_.facing[s_.sector[3 * f + k]]; }
    bool is_crossed(std::uint32_t f) const { return faces_eye(f, 0) != faces_eye(f, 1) || faces_eye(f, 1) != faces_eye(f, 2); }

    /// Per block of faces, how many crossed ones come before it; at the end, how many there are.
    void count_crossed()
    {
        const std::size_t faces = s_.topology.triangles.size();
        std::vector<std::uint32_t> count((faces + grain - 1) / grain);
        parallel_blocks(faces, grain, [&](std::size_t begin, std::size_t end) {
            std::uint32_t crossed = 0;
            for (std::uint32_t f = std::uint32_t(begin); f < end; ++f)
                crossed += is_crossed(f);
            count[begin / grain] = crossed;
        });
        crossed_before_.assign(1, 0);
        for (const std::uint32_t c : count)
            crossed_before_.push_back(crossed_before_.back() + c);
    }

    Corner control_corner(std::uint32_t f, std::uint32_t k) const
    {
        return {s_.topology.triangles[f][int(k)], pose_.normals[s_.sector[3 * f + k]], corner_parameters[k]};
    }

    /// The crossing on the edge from corner k of a face to the next.
    Corner crossing_corner(std::uint32_t f, std::uint32_t k) const
    {
        const std::uint32_t h = 3 * f + k, number = found_.of(s_.side[h]);
        const Crossing& c = found_.crossings[number];
        const bool forward = s_.topology.half_edge[s_.topology.edge[h]] == h;
        const dvec2 &from = corner_parameters[k], &to = corner_parameters[(k + 1) % 3];
        return {std::uint32_t(pose_.positions.size()) + number, c.normal, forward ? glm::mix(from, to, c.chord) : glm::mix(to, from, c.chord)};
    }

    void add(std::size_t triangle, std::uint32_t face, const Corner& a, const Corner& b, const Corner& c)
    {
        out_.mesh.triangles[triangle] = {a.vertex, b.vertex, c.vertex};
        out_.faces[triangle] = face;
        std::size_t at = 3 * triangle;
        for (const Corner* corner : {&a, &b, &c}) {
            out_.mesh.corner_normals[at] = vec3(corner->normal);
            out_.parameters[at++] = corner->parameter;
        }
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

    /// @param rank      how many crossed faces come before
    /// @param triangle  the first that is made
    void cut(std::uint32_t f, std::uint32_t rank, std::size_t triangle, std::vector<Corner>& curve, std::vector<Corner>& base)
    {
        // The corner that differs from both others, and these, counter-clockwise.
        const std::uint32_t k = faces_eye(f, 0) == faces_eye(f, 1) ? 2 : faces_eye(f, 0) == faces_eye(f, 2) ? 1 : 0;
        const Corner apex = control_corner(f, k), b = control_corner(f, (k + 1) % 3), c = control_corner(f, (k + 2) % 3);
        const Corner first = crossing_corner(f, k), last = crossing_corner(f, (k + 2) % 3);
        const std::vector<dvec3>& p = out_.mesh.positions;
        const std::uint32_t inner = std::uint32_t(pose_.positions.size() + found_.crossings.size() + rank * vertices_each());
        const PnCurve pn(p[first.vertex], first.normal, p[last.vertex], last.normal);
        trace(first, last, inner, [&](double t) { return pn.at(t); }, curve);
        for (std::uint32_t i = 0; i < pieces_; ++i)
            add(triangle++, f, apex, curve[i], curve[i + 1]);
        if (strip_) {
            trace(b, c, inner + pieces_ - 1, [&](double t) { return glm::mix(p[b.vertex], p[c.vertex], t); }, base);
            add_strip(f, triangle, curve, base);
        } else {
            add_slivers(f, triangle, curve, b, c);
        }
        keep_curve(rank, curve, faces_eye(f, k));
    }

    void add_strip(std::uint32_t f, std::size_t triangle, const std::vector<Corner>& curve, const std::vector<Corner>& base)
    {
        for (std::uint32_t i = 0; i < pieces_; ++i) {
            add(triangle++, f, curve[i], base[i], base[i + 1]);
            add(triangle++, f, curve[i], base[i + 1], curve[i + 1]);
        }
    }

    /// The first half of the curve to b, the last to c, and a triangle between.
    void add_slivers(std::uint32_t f, std::size_t triangle, const std::vector<Corner>& curve, const Corner& b, const Corner& c)
    {
        const std::uint32_t middle = pieces_ / 2;
        for (std::uint32_t i = 0; i < middle; ++i)
            add(triangle++, f, curve[i], b, curve[i + 1]);
        add(triangle++, f, curve[middle], b, c);
        for (std::uint32_t i = middle; i < pieces_; ++i)
            add(triangle++, f, curve[i], c, curve[i + 1]);
    }

    /// @param apex_faces  the apex, on the left of the curve as it was traced, faces the eye
    void keep_curve(std::uint32_t rank, const std::vector<Corner>& curve, bool apex_faces)
    {
        std::vector<std::uint32_t>& line = out_.curves[rank];
        for (const Corner& c : curve)
            line.push_back(c.vertex);
        if (!apex_faces)
            std::reverse(line.begin(), line.end());
    }

    const SeedSurface& s_;
    const SeedPose& pose_;
    const SeedCrossings& found_;
    std::uint32_t pieces_;
    bool strip_;
    std::vector<std::uint32_t> crossed_before_;
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
