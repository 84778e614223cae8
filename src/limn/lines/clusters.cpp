#include "limn/lines/clusters.h"

#include <algorithm>
#include <numeric>

#include <tbb/parallel_invoke.h>

#include "limn/base/parallel.h"
#include "limn/lines/suggestive.h"

namespace limn {
namespace {

constexpr std::size_t face_grain = 16384, cluster_grain = 64;

/// A face by its centroid (times 3).
struct Centroid {
    vec3 place;
    std::uint32_t face;
};

std::vector<Centroid> centroids(const LineModel& model)
{
    std::vector<Centroid> items(model.faces.size());
    parallel_each(items.size(), face_grain, [&](std::size_t f) {
        const uvec3& t = model.faces[f];
        items[f] = {model.positions[t.x] + model.positions[t.y] + model.positions[t.z], std::uint32_t(f)};
    });
    return items;
}

int longest_axis(std::span<const Centroid> items)
{
    vec3 low = items[0].place, high = low;
    for (const Centroid& item : items) {
        low = glm::min(low, item.place);
        high = glm::max(high, item.place);
    }
    const vec3 size = high - low;
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

/// Orders faces so that every run of `cluster_faces` is a cluster: halves at the median along the longest axis, at a
/// multiple of the run.
void split_by_medians(std::span<Centroid> items)
{
    const std::size_t leaves = (items.size() + cluster_faces - 1) / cluster_faces;
    if (leaves <= 1)
        return;
    const std::size_t half = leaves / 2 * cluster_faces;
    const int axis = longest_axis(items);
    std::nth_element(items.begin(), items.begin() + std::ptrdiff_t(half), items.end(), [axis](const Centroid& a, const Centroid& b) {
        return a.place[axis] < b.place[axis] || (a.place[axis] == b.place[axis] && a.face < b.face);
    });
    const auto first = [&] { split_by_medians(items.first(half)); };
    const auto second = [&] { split_by_medians(items.subspan(half)); };
    if (items.size() > face_grain) {
        tbb::parallel_invoke(first, second);
    } else {
        first();
        second();
    }
}

/// The vertices of some faces, ascending, each once.
class VertexSet {
public:
    VertexSet(const LineModel& model, std::span<const std::uint32_t> faces)
    {
        for (const std::uint32_t f : faces)
            for (int k = 0; k < 3; ++k)
                vertices_[count_++] = model.faces[f][k];
        std::sort(vertices_.begin(), vertices_.begin() + std::ptrdiff_t(count_));
        count_ = std::size_t(std::unique(vertices_.begin(), vertices_.begin() + std::ptrdiff_t(count_)) - vertices_.begin());
    }
    std::size_t blocks() const { return (count_ + cluster_lanes - 1) / cluster_lanes; }
    /// The vertex at a place of the blocks; the last one is repeated.
    std::uint32_t at(std::size_t place) const { return vertices_[std::min(place, count_ - 1)]; }
    std::uint8_t place_of(std::uint32_t vertex) const
    {
        return std::uint8_t(std::lower_bound(vertices_.begin(), vertices_.begin() + std::ptrdiff_t(count_), vertex) - vertices_.begin());
    }

private:
    std::array<std::uint32_t, cluster_most_vertices> vertices_;
    std::size_t count_ = 0;
};

/// Fills what belongs to one cluster, whose faces and first block are known.
class Packer {
public:
    Packer(const LineModel& model, LineClusters& out) : model_(model), out_(out) {}

    std::span<const std::uint32_t> faces(const Cluster& c) const { return {out_.face.data() + c.first_face, c.faces}; }

    void pack(const Cluster& c) const
    {
        const VertexSet vertices(model_, faces(c));
        for (std::size_t i = 0; i < c.faces; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                out_.corners[3 * c.first_face + k * cluster_faces + i] = vertices.place_of(model_.faces[out_.face[c.first_face + i]][int(k)]);
        for (std::size_t place = 0; place < c.blocks * cluster_lanes; ++place)
            pack_vertex(c, place, vertices.at(place));
    }

private:
    /// Writes one vertex's column of a block, from a row on.
    class Column {
    public:
        Column(HugePageVector<float>& rows, std::size_t row, std::size_t lane) : next_(rows.data() + row * cluster_lanes + lane) {}
        void put(float x)
        {
            *next_ = x;
            next_ += cluster_lanes;
        }
        void put(const vec3& x)
        {
            for (int k = 0; k < 3; ++k)
                put(x[k]);
        }

    private:
        float* next_;
    };

    void pack_vertex(const Cluster& c, std::size_t place, std::uint32_t v) const
    {
        const std::size_t block = place / cluster_lanes, lane = place % cluster_lanes, first_row = c.first_block * out_.row_count();
        Column facing(out_.rows, first_row + block * facing_rows, lane);
        facing.put(model_.positions[v]);
        facing.put(model_.normals[v]);
        if (!out_.has_curvature)
            return;
        Column curvature(out_.rows, first_row + c.blocks * facing_rows + block * curvature_rows, lane);
        curvature.put(model_.e1[v]);
        curvature.put(model_.e2[v]);
        curvature.put(model_.k1[v]);
        curvature.put(model_.k2[v]);
        if (out_.derivative.empty())
            return;
        Column derivative(out_.derivative, (c.first_block + block) * derivative_rows, lane);
        for (int k = 0; k < 4; ++k)
            derivative.put(model_.derivative[v][k]);
    }

    const LineModel& model_;
    LineClusters& out_;
};

/// Puts the faces of each run in ascending order, those that can carry suggestive lines first.
void order_faces(const LineModel& model, LineClusters& out)
{
    std::vector<std::uint8_t> is_candidate(model.has_derivative() ? model.faces.size() : 0, 0);
    if (model.has_derivative())
        for (const std::uint32_t f : find_suggestive_faces(model).candidates)
            is_candidate[f] = 1;
    parallel_each(out.clusters.size(), cluster_grain, [&](std::size_t i) {
        Cluster& c = out.clusters[i];
        c.first_face = std::uint32_t(i * cluster_faces);
        c.faces = std::uint32_t(std::min(cluster_faces, out.face.size() - c.first_face));
        const auto begin = out.face.begin() + c.first_face, end = begin + c.faces;
        std::sort(begin, end);
        if (!is_candidate.empty())
            c.candidates = std::uint32_t(std::stable_partition(begin, end, [&](std::uint32_t f) { return is_candidate[f] != 0; }) - begin);
        c.blocks = std::uint32_t(VertexSet(model, {&*begin, c.faces}).blocks());
    });
}

} // namespace

LineClusters build_clusters(const LineModel& model, const ClusterBoundOptions& options)
{
    LineClusters out;
    std::vector<Centroid> items = centroids(model);
    split_by_medians(items);
    out.face.resize(items.size());
    parallel_each(items.size(), face_grain, [&](std::size_t i) { out.face[i] = items[i].face; });
    out.clusters.resize((items.size() + cluster_faces - 1) / cluster_faces);
    order_faces(model, out);
    std::uint32_t blocks = 0;
    for (Cluster& c : out.clusters) {
        c.first_block = blocks;
        blocks += c.blocks;
    }
    out.has_curvature = model.has_curvature();
    out.rows.resize(blocks * out.row_count() * cluster_lanes);
    out.derivative.resize(model.has_derivative() ? blocks * derivative_rows * cluster_lanes : 0);
    out.corners.resize(3 * cluster_faces * out.clusters.size());
    out.bounds.clusters = out.clusters.size();
    out.bounds.values.assign(out.bounds.groups() * bound_rows * bound_lanes, 0.0f);
    const Packer packer(model, out);
    parallel_each(out.clusters.size(), cluster_grain, [&](std::size_t i) {
        const Cluster& c = out.clusters[i];
        packer.pack(c);
        write_cluster_bounds(out.bounds, i, model, packer.faces(c), c.candidates, options);
    });
    return out;
}

} // namespace limn
