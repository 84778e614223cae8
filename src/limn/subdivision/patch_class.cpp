#include "limn/subdivision/patch_class.h"

#include <algorithm>

#include "limn/subdivision/loop_limit.h"
#include "limn/subdivision/loop_refine.h"
#include "limn/subdivision/patch_neighbourhood.h"

namespace limn {
namespace {

/// The vertices of a piece of a refined mesh as weights of the root's vertices, three of these to each list: impulses[i][v] has the weights
/// of the root's 3i, 3i + 1 and 3i + 2 for vertex v, as if they were a position.
using Impulses = std::vector<std::vector<dvec3>>;

Impulses unit_impulses(std::size_t vertices)
{
    Impulses impulses((vertices + 2) / 3, std::vector<dvec3>(vertices, dvec3(0)));
    for (std::size_t v = 0; v < vertices; ++v)
        impulses[v / 3][v][int(v % 3)] = 1;
    return impulses;
}

class ClassMaker {
public:
    explicit ClassMaker(const LoopTopology& root) : root_vertices_(root.vertex_count())
    {
        patches_.nodes.emplace_back();
        Impulses impulses = unit_impulses(root_vertices_);
        patches_.anchored = regular_points(root).empty();
        patches_.fades = std::any_of(root.sharpness.begin(), root.sharpness.end(), [](float s) { return s > 0 && s < infinitely_sharp; });
        if (patches_.anchored)
            add_corner(root, impulses);
        fill(0, root, std::move(impulses), 0);
    }
    /// Leaves out the vertices that nothing depends on, such as those beyond creases.
    NewClass finish()
    {
        NewClass out;
        for (std::size_t v = 0; v < root_vertices_; ++v)
            if (std::any_of(rows_.begin(), rows_.end(), [&](const std::vector<double>& row) { return row[v] != 0; }))
                out.support.push_back(std::uint32_t(v));
        patches_.support = out.support.size();
        for (const std::vector<double>& row : rows_)
            for (const std::uint32_t v : out.support)
                patches_.weights.push_back(row[v]);
        out.patches = std::move(patches_);
        return out;
    }

private:
    void add_corner(const LoopTopology& root, Impulses& impulses)
    {
        rows_.resize(3, std::vector<double>(root_vertices_));
        for (std::size_t r = 0; r < root_vertices_; ++r) {
            const LimitPoint limit = limit_point(root, impulses[r / 3], 0);
            const int i = int(r % 3);
            rows_[0][r] = limit.position[i], rows_[1][r] = limit.u[i], rows_[2][r] = limit.v[i];
        }
        see_from_corner(root, impulses);
    }
    /// Subtracts what the first corner tends to. Repeated at every level, since its rounding errors would not shrink while all else does.
    static void see_from_corner(const LoopTopology& t, Impulses& impulses)
    {
        for (std::vector<dvec3>& impulse : impulses) {
            const dvec3 limit = limit_point(t, impulse, 0).position;
            for (dvec3& value : impulse)
                value -= limit;
        }
    }
    /// @param at_corner  the first corner of the triangle is that of the root
    void fill(std::size_t node, const LoopTopology& t, Impulses impulses, int depth, bool at_corner = true)
    {
        const std::vector<std::vector<double>> points = regular_points(t);
        if (!points.empty())
            add_patch(node, points, impulses);
        else if (depth == PatchClass::deepest)
            patches_.nodes[node].kind = PatchClass::Kind::corner;
        else
            add_children(node, t, impulses, depth, at_corner);
    }
    void add_patch(std::size_t node, const std::vector<std::vector<double>>& points, const Impulses& impulses)
    {
        patches_.nodes[node] = {PatchClass::Kind::patch, 0, std::uint32_t(rows_.size())};
        for (const std::array<double, regular_support>& weights : box_spline_weights()) {
            std::vector<double> of_vertices(impulses[0].size(), 0);
            for (std::size_t p = 0; p < regular_support; ++p)
                for (std::size_t v = 0; v < of_vertices.size(); ++v)
                    of_vertices[v] += weights[p] * points[p][v];
            rows_.push_back(of_root(of_vertices, impulses));
        }
    }
    std::vector<double> of_root(const std::vector<double>& of_vertices, const Impulses& impulses) const
    {
        std::vector<double> row(root_vertices_);
        for (std::size_t r = 0; r < root_vertices_; ++r)
            for (std::size_t v = 0; v < of_vertices.size(); ++v)
                row[r] += of_vertices[v] * impulses[r / 3][v][int(r % 3)];
        return row;
    }
    void add_children(std::size_t node, const LoopTopology& t, const Impulses& impulses, int depth, bool at_corner)
    {
        const std::size_t first = patches_.nodes.size();
        patches_.nodes[node] = {PatchClass::Kind::inner, std::uint32_t(first), 0};
        patches_.nodes.resize(first + 4);
        Impulses refined;
        for (const std::vector<dvec3>& impulse : impulses)
            refined.push_back(refine_positions(t, impulse));
        const LoopTopology fine = refine(t);
        for (std::uint32_t k = 0; k < 4; ++k) {
            const Neighbourhood child = neighbourhood_of(fine, k);
            Impulses of_child(refined.size());
            for (std::size_t i = 0; i < refined.size(); ++i)
                for (const std::uint32_t v : child.vertices)
                    of_child[i].push_back(refined[i][v]);
            const bool still = at_corner && k == 0;
            if (still)
                see_from_corner(child.topology, of_child);
            fill(first + k, child.topology, std::move(of_child), depth + 1, still);
        }
    }

    std::size_t root_vertices_;
    PatchClass patches_;
    std::vector<std::vector<double>> rows_; ///< of the root's vertices
};

} // namespace

NewClass make_patch_class(const LoopTopology& neighbourhood) { return ClassMaker(neighbourhood).finish(); }

} // namespace limn
