#include "limn/lines/cluster_extract.h"

#include <algorithm>
#include <bit>

#include <tbb/parallel_invoke.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/geometry/radix_sort.h"
#include "limn/lines/cluster_kernel.h"
#include "limn/lines/contour.h"
#include "limn/lines/contour_face.h"
#include "limn/lines/suggestive_face.h"

namespace limn {
namespace {

constexpr std::size_t group_grain = 8; ///< groups of clusters in a task

/// Lines in the order in which they are found.
struct Part {
    std::vector<Segment> contours, suggestive, highlights;
    std::size_t survivors = 0;
};

/// Faces of a cluster, one bit each.
using FaceSet = std::uint64_t;
static_assert(cluster_faces <= 64);

constexpr FaceSet first_faces(std::uint32_t count) { return count >= 64 ? ~FaceSet(0) : (FaceSet(1) << count) - 1; }

/// Calls `f(place)` for each of the faces, in ascending order.
template <class F> void for_faces(FaceSet faces, F&& f)
{
    for (; faces != 0; faces &= faces - 1)
        f(std::size_t(std::countr_zero(faces)));
}

/// One view of all clusters.
class Extraction {
public:
    Extraction(const LineClusters& clusters, const View& view, const ClusterRequest& request)
        : clusters_(clusters), view_(view), request_(request), radial_(request.suggestive || request.highlights)
    {
        bounded_view_.eye = view.eye;
        bounded_view_.orthographic = view.orthographic;
        bounded_view_.contour = request.contours;
        bounded_view_.suggestive = radial_;
        if (request.suggestive && !request.highlights) {
            bounded_view_.limited = true;
            bounded_view_.size2 = request.suggestive->feature_size * request.suggestive->feature_size;
            bounded_view_.limit = request.suggestive->limit;
        }
    }

    std::vector<Part> run(bool bounded) const
    {
        const std::size_t groups = clusters_.bounds.groups();
        std::vector<Part> parts((groups + group_grain - 1) / group_grain);
        parallel_blocks(groups, group_grain, [&](std::size_t begin, std::size_t end) {
            Part& part = parts[begin / group_grain];
            Survivors survivors;
            ClusterVisit visit(*this);
            for (std::size_t g = begin; g < end; ++g)
                list_survivors(g, bounded, survivors);
            part.survivors = survivors.count;
            for (std::size_t i = 0; i < survivors.count; ++i) {
                if (bounded && i + 1 < survivors.count)
                    fetch(survivors.items[i + 1]);
                visit.run(survivors.items[i], part);
            }
        });
        return parts;
    }

private:
    /// A cluster to look into, and what for.
    struct Survivor {
        const Cluster* cluster;
        bool contour, radial;
    };
    struct Survivors {
        std::size_t count = 0;
        std::array<Survivor, group_grain * bound_lanes> items;
    };

    void list_survivors(std::size_t group, bool bounded, Survivors& survivors) const
    {
        ClusterSurvivors wanted = {std::uint8_t(request_.contours ? 0xFF : 0), std::uint8_t(radial_ ? 0xFF : 0)};
        if (bounded)
            wanted = test_clusters(clusters_.bounds, group, bounded_view_);
        const std::size_t first = group * bound_lanes, count = std::min(bound_lanes, clusters_.clusters.size() - first);
        for (std::size_t k = 0; k < count; ++k) {
            const Cluster& c = clusters_.clusters[first + k];
            const bool contour = wanted.contour >> k & 1, radial = (wanted.suggestive >> k & 1) && c.candidates > 0;
            survivors.items[survivors.count] = {&c, contour, radial};
            survivors.count += contour || radial;
        }
    }

    template <class T> static void fetch(const T* begin, std::size_t count)
    {
        for (std::size_t i = 0; i < count; i += 64 / sizeof(T)) // cache lines
            __builtin_prefetch(begin + i);
    }

    /// Asks for the vertices of a cluster before they are needed: survivors lie apart in memory.
    void fetch(const Survivor& survivor) const
    {
        const ClusterRows rows = clusters_.rows_of(*survivor.cluster);
        fetch(rows.facing, rows.blocks * facing_rows * cluster_lanes);
        if (survivor.radial)
            fetch(rows.curvature, rows.blocks * curvature_rows * cluster_lanes);
        fetch(clusters_.corners_of(*survivor.cluster), 3 * cluster_faces);
    }

    /// What is found in one cluster after the other.
    class ClusterVisit {
    public:
        explicit ClusterVisit(const Extraction& all) : all_(all) {}

        void run(const Survivor& survivor, Part& part)
        {
            c_ = survivor.cluster;
            rows_ = all_.clusters_.rows_of(*c_);
            corners_ = all_.clusters_.corners_of(*c_);
            const CodeSummary summary = find_cluster_codes(rows_, survivor.radial, all_.view_, codes_, facing_);
            const bool contour = survivor.contour && (summary.mixed() & facing_away), radial = survivor.radial && (summary.mixed() & radially_concave);
            if (!contour && !radial)
                return;
            if (radial)
                fetch(rows_.derivative, rows_.blocks * derivative_rows * cluster_lanes);
            const MixedFaces mixed = find_mixed_faces(corners_, codes_, rows_.blocks);
            if (contour)
                emit_contours(mixed.facing & first_faces(c_->faces), part.contours);
            const FaceSet candidates = mixed.radial & first_faces(c_->candidates);
            if (radial && all_.request_.suggestive)
                emit_suggestive(candidates, *all_.request_.suggestive, part.suggestive);
            if (radial && all_.request_.highlights)
                emit_suggestive(candidates, *all_.request_.highlights, part.highlights);
        }

    private:
        /// The vertex at a corner of a face.
        std::uint32_t vertex(std::size_t place, std::size_t corner) const { return corners_[corner * cluster_faces + place]; }

        /// The first of three rows, in a vertex's column.
        template <std::size_t Count> static const float* column(const float* rows, std::uint32_t vertex)
        {
            return rows + vertex / cluster_lanes * Count * cluster_lanes + vertex % cluster_lanes;
        }
        static vec3 vector_at(const float* row) { return {row[0], row[cluster_lanes], row[2 * cluster_lanes]}; }
        vec3 position(std::uint32_t vertex) const { return vector_at(column<facing_rows>(rows_.facing, vertex)); }

        void emit_contours(FaceSet faces, std::vector<Segment>& out) const
        {
            for_faces(faces, [&](std::size_t i) {
                const std::uint32_t t[3] = {vertex(i, 0), vertex(i, 1), vertex(i, 2)};
                const vec3 positions[3] = {position(t[0]), position(t[1]), position(t[2])};
                const float facing[3] = {facing_[t[0]], facing_[t[1]], facing_[t[2]]};
                out.push_back(contour_in_face(t, positions, facing, face(i)));
            });
        }

        /// @param candidates  whose corners differ in the sign of the radial curvature
        void emit_suggestive(FaceSet candidates, const SuggestiveOptions& options, std::vector<Segment>& out)
        {
            if (candidates == 0 || !find_cluster_strengths(rows_, all_.view_, options, kr_, strength_, strong_))
                return;
            for_faces(candidates & find_flagged_faces(corners_, strong_, rows_.blocks), [&](std::size_t i) {
                const std::uint32_t t[3] = {vertex(i, 0), vertex(i, 1), vertex(i, 2)};
                const vec3 positions[3] = {position(t[0]), position(t[1]), position(t[2])};
                if (!faces_eye(positions[0], positions[1], positions[2], all_.view_))
                    return;
                const SuggestiveCorner corners[3] = {corner(t[0], options), corner(t[1], options), corner(t[2], options)};
                const std::uint32_t f = face(i), half_edges[3] = {3 * f, 3 * f + 1, 3 * f + 2};
                Segment segment;
                if (trim_suggestive(corners, positions, half_edges, f, options, segment))
                    out.push_back(segment);
            });
        }

        SuggestiveCorner corner(std::uint32_t vertex, const SuggestiveOptions& options) const
        {
            if (!(options.speed_limit > 0))
                return {vertex, kr_[vertex], strength_[vertex], 0, 0};
            const float* facing = column<facing_rows>(rows_.facing, vertex);
            const float* curvature = column<curvature_rows>(rows_.curvature, vertex);
            const float* derivative = column<derivative_rows>(rows_.derivative, vertex);
            const float k1 = curvature[6 * cluster_lanes], k2 = curvature[7 * cluster_lanes];
            const formulas::RadialTerms terms = formulas::radial_terms(all_.view_.to_eye(vector_at(facing)), vector_at(facing + 3 * cluster_lanes),
                                                                       vector_at(curvature), vector_at(curvature + 3 * cluster_lanes), k1, k2);
            return suggestive_corner(terms, vertex, k1, k2, vec4(vector_at(derivative), derivative[3 * cluster_lanes]), options, all_.view_.orthographic);
        }

        std::uint32_t face(std::size_t place) const { return all_.clusters_.face[c_->first_face + place]; }

        const Extraction& all_;
        const Cluster* c_ = nullptr;
        ClusterRows rows_ = {};
        const std::uint8_t* corners_ = nullptr; ///< of its faces
        // Of its vertices.
        std::uint8_t codes_[cluster_most_vertices] = {}, strong_[cluster_most_vertices] = {};
        float facing_[cluster_most_vertices], kr_[cluster_most_vertices], strength_[cluster_most_vertices];
    };

    const LineClusters& clusters_;
    const View& view_;
    const ClusterRequest& request_;
    bool radial_;
    ClusterView bounded_view_;
};

/// All segments of one kind, in the order of their faces and with the ids of edges.
std::vector<Segment> in_face_order(const std::vector<Part>& parts, std::vector<Segment> Part::*kind, const LineModel& model)
{
    std::vector<std::size_t> first(parts.size() + 1, 0);
    for (std::size_t p = 0; p < parts.size(); ++p)
        first[p + 1] = first[p] + (parts[p].*kind).size();
    std::vector<std::uint64_t> keys(first.back());
    std::vector<const Segment*> where(keys.size());
    parallel_each(parts.size(), 64, [&](std::size_t p) {
        std::size_t place = first[p];
        for (const Segment& s : parts[p].*kind) {
            keys[place] = keyed(s.face, std::uint32_t(place));
            where[place++] = &s;
        }
    });
    sort_by_key(keys, std::uint32_t(model.faces.size()));
    std::vector<Segment> sorted(keys.size());
    constexpr std::size_t ahead = 12; // so much earlier than it is needed is asked for what lies far apart
    parallel_each(keys.size(), 2048, [&](std::size_t i) {
        const std::uint64_t later = keys[std::min(i + ahead, keys.size() - 1)];
        __builtin_prefetch(where[item_of(later)]);
        __builtin_prefetch(model.adjacency.twin.data() + 3 * std::size_t(key_of(later)));
        sorted[i] = *where[item_of(keys[i])];
        number_edges(sorted[i], model.adjacency);
    });
    return sorted;
}

/// Whether to look at bounds: not where they rejected too little, but they are tried again from time to time.
bool choose_bounded(ClusterUse use, const ClusterHistory* history)
{
    constexpr double worthwhile = 0.5;
    constexpr int patience = 16;
    if (use != ClusterUse::automatic)
        return use == ClusterUse::bounded;
    return !history || history->survivors <= worthwhile || history->since_bounded >= patience;
}

void remember(ClusterHistory& history, const std::vector<Part>& parts, std::size_t clusters, bool bounded)
{
    if (!bounded) {
        ++history.since_bounded;
        return;
    }
    std::size_t survivors = 0;
    for (const Part& part : parts)
        survivors += part.survivors;
    history = {clusters > 0 ? double(survivors) / double(clusters) : 0, 0};
}

} // namespace

ClusterLines extract_from_clusters(const LineModel& model, const LineClusters& clusters, const View& view, const ClusterRequest& request,
                                   ClusterHistory* history)
{
    if ((request.suggestive || request.highlights) && !model.has_derivative())
        throw Error::Input("suggestive lines need the derivative of curvature, which the surface does not hold");
    const bool bounded = choose_bounded(request.use, history);
    const std::vector<Part> parts = Extraction(clusters, view, request).run(bounded);
    if (history)
        remember(*history, parts, clusters.clusters.size(), bounded);
    ClusterLines lines;
    tbb::parallel_invoke([&] { lines.contours = in_face_order(parts, &Part::contours, model); },
                         [&] { lines.suggestive = in_face_order(parts, &Part::suggestive, model); },
                         [&] { lines.highlights = in_face_order(parts, &Part::highlights, model); });
    if (request.contours)
        append_crease_outlines(model, view, lines.contours);
    return lines;
}

} // namespace limn
