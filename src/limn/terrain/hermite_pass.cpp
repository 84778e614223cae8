#include "limn/terrain/hermite_pass.h"

#include <atomic>
#include <limits>

#include "limn/base/parallel.h"

namespace limn {
namespace {

constexpr std::size_t grain = 2048;
/// Sides of a triangle as bits: apex-a, b-apex, and a-b, which is split where any other is.
constexpr unsigned first_leg = 1, second_leg = 2, hypotenuse = 4;
/// Of a triangle that stays flat: all sides of its parts are straight.
constexpr unsigned flat = 8;

/// A triangle and what its parts get from it.
struct Part {
    uvec3 triangle;
    unsigned straight;
};

/// The parts that a triangle is split into: the templates of the thesis, as bisections.
/// @param middles  the vertices in the middles of those sides that are split
int split_parts(const Part& t, unsigned sides, const uvec3& middles, Part (&out)[4])
{
    const std::uint32_t c = t.triangle.x, a = t.triangle.y, b = t.triangle.z, p = middles.x, q = middles.y, m = middles.z;
    const unsigned f0 = t.straight & first_leg ? 1u : 0u, f1 = t.straight & second_leg ? 1u : 0u, f2 = t.straight & hypotenuse ? 1u : 0u;
    const unsigned all = t.straight & flat ? flat | first_leg | second_leg | hypotenuse : 0u;
    const auto flags = [&](unsigned g0, unsigned g1, unsigned g2) { return g0 * first_leg | g1 * second_leg | g2 * hypotenuse | all; };
    if (sides == 0) {
        out[0] = t;
        return 1;
    }
    int count = 0;
    if ((sides & first_leg) != 0) {
        out[count++] = {{p, m, c}, flags(0, f0, 0)};
        out[count++] = {{p, a, m}, flags(f0, 0, f2)};
    } else {
        out[count++] = {{m, c, a}, flags(0, f2, f0)};
    }
    if ((sides & second_leg) != 0) {
        out[count++] = {{q, m, b}, flags(0, f1, f2)};
        out[count++] = {{q, c, m}, flags(f1, 0, 0)};
    } else {
        out[count++] = {{m, b, c}, flags(f2, 0, f1)};
    }
    return count;
}

/// Where an edge's curve is, as far as it may go.
class Curves {
public:
    Curves(const HermiteMesh& mesh, double weight) : mesh_(mesh), weight_(weight) {}

    struct Curve {
        dvec3 p1, p2, n1, n2;
        formulas::EdgeTangents tangents;
        double most = 0; ///< how far the curve may go up and down
    };
    Curve of(const glm::uvec2& ends, double most) const
    {
        const dvec3 &p1 = mesh_.positions[ends.x], &p2 = mesh_.positions[ends.y], &n1 = mesh_.normals[ends.x], &n2 = mesh_.normals[ends.y];
        Curve curve = {p1, p2, n1, n2, {}, most};
        if (n1 != dvec3(0) && n2 != dvec3(0))
            curve.tangents = formulas::edge_tangents(p1, p2, n1, n2);
        return curve;
    }
    /// Its middle as published, which normals are made from.
    dvec3 free_middle(const Curve& c) const { return formulas::edge_middle(c.p1, c.p2, c.tangents, weight_); }
    dvec3 middle(const Curve& c) const
    {
        if (mesh_.vertical.empty())
            return free_middle(c);
        const dvec3 straight = 0.5 * (c.p1 + c.p2);
        return straight + allowed(c, (c.tangents.begin - c.tangents.end) * (weight_ * 0.125));
    }
    /// Whether it is too far from the straight edge somewhere that is looked at.
    bool is_far(const Curve& c, const HermiteMeasure& measure, bool quarters) const
    {
        const auto far_at = [&](const dvec3& foot, const dvec3& off) { return measure.is_over(measure.apart(foot, foot + allowed(c, off))); };
        const dvec3 across = formulas::across_edge(c.p1, c.p2, (c.tangents.begin - c.tangents.end) * (weight_ * 0.125));
        if (far_at(free_middle(c) - across, across))
            return true;
        if (!quarters)
            return false;
        const auto far_off = [&](double along, const dvec3& off) { return far_at(glm::mix(c.p1, c.p2, along), formulas::across_edge(c.p1, c.p2, off)); };
        return far_off(0.25, formulas::edge_quarter(c.tangents, weight_)) || far_off(0.75, formulas::edge_three_quarters(c.tangents, weight_));
    }

private:
    /// Free, or as far up or down as brings a surface to the same place, within the limit.
    dvec3 allowed(const Curve& c, const dvec3& off) const
    {
        if (mesh_.vertical.empty())
            return off;
        const dvec3 normal = c.n1 + c.n2;
        const double up = normal.z > 0.1 * glm::length(normal) ? glm::dot(off, normal) / normal.z : 0;
        return {0, 0, std::clamp(up, -c.most, c.most)};
    }
    const HermiteMesh& mesh_;
    double weight_;
};

/// One pass over all triangles: which edges are split, where, and into which triangles.
class Pass {
public:
    Pass(HermiteMesh& mesh, const HermiteMeasure& measure, const HermiteOptions& options)
        : mesh_(mesh), measure_(measure), options_(options), curves_(mesh, options.tangents), edges_(number_edges(mesh.triangles, mesh.positions.size())),
          split_(edges_.size(), 0), straight_(edges_.size(), 0)
    {
    }
    /// @return whether some edge has to be split
    bool find_far_edges()
    {
        std::vector<std::uint8_t> seen(mesh_.triangles.size());
        parallel_each(seen.size(), grain, [&](std::size_t i) {
            const uvec3& t = mesh_.triangles[i];
            seen[i] = measure_.may_be_seen(mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z]);
        });
        std::atomic<bool> any = false;
        parallel_each(edges_.size(), grain, [&](std::size_t e) {
            bool visible = false;
            for (const std::uint32_t side : edges_.sides_of(e)) {
                visible = visible || seen[side / 3] != 0;
                if ((mesh_.straight[side / 3] >> (side % 3) & 1) != 0)
                    straight_[e] = 1;
            }
            split_[e] = visible && straight_[e] == 0 && curves_.is_far(curve(e), measure_, options_.rule == HermiteRule::repaired);
            if (split_[e] != 0)
                any.store(true, std::memory_order_relaxed);
        });
        return any;
    }
    /// Splits hypotenuses with legs in all their triangles.
    void close_marks()
    {
        for (std::atomic<bool> more = true; more;) {
            more = false;
            parallel_each(mesh_.triangles.size(), grain, [&](std::size_t t) {
                std::atomic_ref<std::uint8_t> mark(split_[edges_.of_side[3 * t + 2]]);
                const auto is_split = [&](std::size_t side) { return std::atomic_ref<std::uint8_t>(split_[edges_.of_side[3 * t + side]]).load(std::memory_order_relaxed) != 0; };
                if (mark.load(std::memory_order_relaxed) == 0 && (is_split(0) || is_split(1))) {
                    mark.store(1, std::memory_order_relaxed);
                    more.store(true, std::memory_order_relaxed);
                }
            });
        }
    }
    /// Makes the vertices and triangles. @param mirrors  whether S-shaped edges are looked for
    void refine(bool mirrors)
    {
        number_vertices();
        std::vector<double> moved(mesh_.vertical.empty() ? 0 : edges_.size());
        parallel_each(edges_.size(), grain, [&](std::size_t e) {
            if (vertex_[e] == none)
                return;
            if (!moved.empty())
                moved[e] = make_vertex(e, mirrors);
            else
                make_vertex(e, mirrors);
        });
        make_triangles(moved);
    }

private:
    /// How far up and down all triangles of an edge let it go.
    double most(std::size_t e) const
    {
        double least = std::numeric_limits<double>::infinity();
        if (!mesh_.vertical.empty())
            for (const std::uint32_t side : edges_.sides_of(e))
                least = std::min(least, mesh_.vertical[side / 3]);
        return least;
    }
    Curves::Curve curve(std::size_t e) const { return curves_.of(edges_.ends[e], most(e)); }
    unsigned split_sides(std::size_t t) const
    {
        unsigned sides = 0;
        for (unsigned k = 0; k < 3; ++k)
            if (split_[edges_.of_side[3 * t + k]] != 0)
                sides |= 1u << k;
        return sides;
    }
    /// Whether a triangle alone splits its hypotenuse, for the sake of its legs.
    static bool is_forced(unsigned sides) { return sides != 0 && sides < hypotenuse; }

    void number_vertices()
    {
        std::vector<std::uint8_t> needed = split_;
        parallel_each(mesh_.triangles.size(), grain, [&](std::size_t t) {
            if (is_forced(split_sides(t)))
                std::atomic_ref<std::uint8_t>(needed[edges_.of_side[3 * t + 2]]).store(1, std::memory_order_relaxed);
        });
        vertex_.assign(edges_.size(), none);
        std::uint32_t count = std::uint32_t(mesh_.positions.size());
        for (std::size_t e = 0; e < needed.size(); ++e)
            if (needed[e] != 0)
                vertex_[e] = count++;
        mesh_.positions.resize(count), mesh_.normals.resize(count), mesh_.parents.resize(count);
    }
    /// @return how far it is above or below the edge
    double make_vertex(std::size_t e, bool mirrors)
    {
        const glm::uvec2& ends = edges_.ends[e];
        const std::size_t v = vertex_[e];
        const Curves::Curve c = curve(e);
        const dvec3 straight = 0.5 * (c.p1 + c.p2);
        mesh_.parents[v] = ends;
        if (split_[e] == 0 || straight_[e] != 0) {
            mesh_.positions[v] = straight;
            mesh_.normals[v] = formulas::edge_normal(c.p1, c.p2, c.n1, c.n2, 0.5, false);
            return 0;
        }
        const bool mirrored = mirrors && formulas::is_serpentine(c.p1, c.p2, c.n1, c.n2);
        mesh_.positions[v] = curves_.middle(c);
        mesh_.normals[v] = formulas::edge_normal(c.p1, c.p2, c.n1, c.n2, formulas::along_edge(c.p1, c.p2, curves_.free_middle(c)), mirrored);
        return std::abs(mesh_.positions[v].z - straight.z);
    }

    struct Made {
        Part part;
        std::uint32_t from;
        double vertical;
    };
    /// What is left of a triangle's limit where its edges moved.
    double left_over(std::size_t t, const std::vector<double>& moved) const
    {
        if (moved.empty())
            return 0;
        double most = 0;
        for (std::size_t k = 0; k < 3; ++k)
            most = std::max(most, moved[edges_.of_side[3 * t + k]]);
        return std::max(0.0, mesh_.vertical[t] - most);
    }
    void append_made(std::size_t t, const std::vector<double>& moved, std::vector<Made>& out) const
    {
        const auto vertex = [&](std::size_t side) { return vertex_[edges_.of_side[3 * t + side]]; };
        unsigned sides = split_sides(t), straight = mesh_.straight[t];
        for (unsigned k = 0; k < 3; ++k)
            if (straight_[edges_.of_side[3 * t + k]] != 0)
                straight |= 1u << k;
        if (is_forced(sides)) {
            sides |= hypotenuse;
            straight |= hypotenuse;
        }
        Part parts[4];
        const int count = split_parts({mesh_.triangles[t], straight}, sides, {vertex(0), vertex(1), vertex(2)}, parts);
        for (int i = 0; i < count; ++i)
            out.push_back({parts[i], std::uint32_t(t), left_over(t, moved)});
    }
    void make_triangles(const std::vector<double>& moved)
    {
        const std::vector<Made> made = parallel_collect<Made>(mesh_.triangles.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<Made>& out) {
            for (std::size_t t = begin; t < end; ++t)
                append_made(t, moved, out);
        });
        const std::vector<std::uint32_t> faces = std::move(mesh_.faces);
        const bool limited = !mesh_.vertical.empty();
        mesh_.triangles.resize(made.size()), mesh_.faces.resize(made.size()), mesh_.straight.resize(made.size());
        mesh_.vertical.resize(limited ? made.size() : 0);
        parallel_each(made.size(), grain, [&](std::size_t i) {
            mesh_.triangles[i] = made[i].part.triangle;
            mesh_.straight[i] = std::uint8_t(made[i].part.straight);
            mesh_.faces[i] = faces[made[i].from];
            if (limited)
                mesh_.vertical[i] = made[i].vertical;
        });
    }

    HermiteMesh& mesh_;
    const HermiteMeasure& measure_;
    const HermiteOptions& options_;
    Curves curves_;
    EdgeTable edges_;
    std::vector<std::uint8_t> split_, straight_; ///< of each edge
    std::vector<std::uint32_t> vertex_;          ///< in the middle of each edge
};

} // namespace

bool split_once(HermiteMesh& mesh, const HermiteMeasure& measure, const HermiteOptions& options, const HermitePass& kind)
{
    Pass pass(mesh, measure, options);
    const bool far = pass.find_far_edges();
    if (!far || !kind.splits)
        return far;
    if (options.rule == HermiteRule::repaired)
        pass.close_marks();
    pass.refine(kind.mirrors);
    return true;
}

} // namespace limn
