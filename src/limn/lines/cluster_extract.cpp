#include "limn/lines/cluster_extract.h"

#include <algorithm>
#include <bitset>

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

/// Places of a cluster's faces, counted from its first.
struct FaceList {
    std::uint32_t count = 0;
    std::uint8_t place[cluster_faces];
};

/// One view of all clusters.
class Extraction {
public:
    Extraction(const LineModel& model, const LineClusters& clusters, const View& view, const ClusterRequest& request)
        : model_(model), clusters_(clusters), view_(view), request_(request), radial_(request.suggestive || request.highlights)
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

    /// Asks for the vertices of a cluster before they are needed: survivors lie apart in memory.
    void fetch(const Survivor& survivor) const
    {
        const float* begin = clusters_.block(survivor.cluster->first_block);
        const std::size_t block = clusters_.row_count * cluster_lanes, used = survivor.radial ? block : 6 * cluster_lanes;
        constexpr std::size_t cache_line = 64 / sizeof(float);
        for (std::size_t b = 0; b < survivor.cluster->blocks; ++b)
            for (std::size_t i = 0; i < used; i += cache_line)
                __builtin_prefetch(begin + b * block + i);
        for (std::size_t i = 0; i < cluster_faces; i += cache_line) {
            __builtin_prefetch(clusters_.corners.data() + survivor.cluster->first_face + i);
            __builtin_prefetch(clusters_.face.data() + survivor.cluster->first_face + i);
        }
    }

    /// What is found in one cluster after the other.
    class ClusterVisit {
    public:
        explicit ClusterVisit(const Extraction& all) : all_(all) {}

        void run(const Survivor& survivor, Part& part)
        {
            c_ = survivor.cluster;
            corners_ = all_.clusters_.corners.data() + c_->first_face;
            const CodeSummary summary = find_cluster_codes(all_.clusters_.block(c_->first_block), all_.clusters_.row_count, c_->blocks, survivor.radial,
                                                           all_.view_, codes_, facing_);
            if (survivor.contour && (summary.mixed() & facing_away))
                emit_contours(part);
            if (survivor.radial && (summary.mixed() & radially_concave))
                emit_suggestive(part);
        }

    private:
        /// The first `count` faces whose corners differ in a bit, without branches.
        void list_mixed(std::uint32_t count, std::uint8_t bit, FaceList& list) const
        {
            const unsigned shift = bit == facing_away ? 0 : 1;
            for (std::uint32_t i = 0; i < count; ++i) {
                const auto& t = corners_[i];
                const unsigned differ = unsigned(codes_[t[0]] ^ codes_[t[1]]) | unsigned(codes_[t[0]] ^ codes_[t[2]]);
                list.place[list.count] = std::uint8_t(i);
                list.count += differ >> shift & 1;
            }
            for (std::uint32_t i = 0; i < list.count; ++i) // the ids of their edges lie far apart
                __builtin_prefetch(all_.model_.adjacency.twin.data() + 3 * face(list.place[i]));
        }

        const float* row_of(std::uint8_t vertex) const
        {
            return all_.clusters_.block(c_->first_block + vertex / cluster_lanes) + vertex % cluster_lanes;
        }
        static vec3 vector_at(const float* row) { return {row[0], row[cluster_lanes], row[2 * cluster_lanes]}; }
        vec3 position(std::uint8_t vertex) const { return vector_at(row_of(vertex)); }

        void emit_contours(Part& part) const
        {
            FaceList list;
            list_mixed(c_->faces, facing_away, list);
            for (std::uint32_t i = 0; i < list.count; ++i) {
                const auto& t = corners_[list.place[i]];
                const std::uint32_t vertices[3] = {t[0], t[1], t[2]};
                const vec3 positions[3] = {position(t[0]), position(t[1]), position(t[2])};
                const float facing[3] = {facing_[t[0]], facing_[t[1]], facing_[t[2]]};
                part.contours.push_back(contour_in_face(vertices, positions, facing, all_.model_.adjacency, face(list.place[i])));
            }
        }

        void emit_suggestive(Part& part)
        {
            FaceList list;
            list_mixed(c_->candidates, radially_concave, list);
            known_[0].has.reset();
            known_[1].has.reset();
            for (std::uint32_t i = 0; i < list.count; ++i) {
                const auto& t = corners_[list.place[i]];
                const vec3 positions[3] = {position(t[0]), position(t[1]), position(t[2])};
                if (!faces_eye(positions[0], positions[1], positions[2], all_.view_))
                    continue;
                if (all_.request_.suggestive)
                    emit_face(list.place[i], positions, *all_.request_.suggestive, part.suggestive);
                if (all_.request_.highlights)
                    emit_face(list.place[i], positions, *all_.request_.highlights, part.highlights);
            }
        }

        void emit_face(std::uint8_t place, const vec3 (&positions)[3], const SuggestiveOptions& options, std::vector<Segment>& out)
        {
            const auto& t = corners_[place];
            const SuggestiveCorner corners[3] = {known_corner(t[0], options), known_corner(t[1], options), known_corner(t[2], options)};
            if (!(corners[0].strength > 0 || corners[1].strength > 0 || corners[2].strength > 0))
                return;
            const std::uint32_t f = face(place);
            const Adjacency& adjacency = all_.model_.adjacency;
            const std::uint32_t edges[3] = {adjacency.edge_id(3 * f), adjacency.edge_id(3 * f + 1), adjacency.edge_id(3 * f + 2)};
            Segment segment;
            if (trim_suggestive(corners, positions, edges, f, options, segment))
                out.push_back(segment);
        }

        /// Faces along a line share most of their corners: each is found once.
        const SuggestiveCorner& known_corner(std::uint8_t vertex, const SuggestiveOptions& options)
        {
            KnownCorners& known = known_[options.highlight];
            if (!known.has[vertex]) {
                known.has[vertex] = true;
                known.corners[vertex] = corner(vertex, options);
            }
            return known.corners[vertex];
        }

        SuggestiveCorner corner(std::uint8_t vertex, const SuggestiveOptions& options) const
        {
            const float* row = row_of(vertex);
            const auto vector = [&](std::size_t first) { return vector_at(row + first * cluster_lanes); };
            const float k1 = row[12 * cluster_lanes], k2 = row[13 * cluster_lanes];
            const formulas::RadialTerms terms = formulas::radial_terms(all_.view_.to_eye(vector(0)), vector(3), vector(6), vector(9), k1, k2);
            const vec4& derivative = all_.clusters_.derivative[c_->first_block * cluster_lanes + vertex];
            return suggestive_corner(terms, vertex, k1, k2, derivative, options, all_.view_.orthographic);
        }

        std::uint32_t face(std::size_t place) const { return all_.clusters_.face[c_->first_face + place]; }

        const Extraction& all_;
        const Cluster* c_ = nullptr;
        const std::array<std::uint8_t, 4>* corners_ = nullptr; ///< of its faces
        std::uint8_t codes_[cluster_most_vertices];
        float facing_[cluster_most_vertices];
        struct KnownCorners {
            std::bitset<cluster_most_vertices> has;
            std::array<SuggestiveCorner, cluster_most_vertices> corners;
        };
        KnownCorners known_[2];
    };

    const LineModel& model_;
    const LineClusters& clusters_;
    const View& view_;
    const ClusterRequest& request_;
    bool radial_;
    ClusterView bounded_view_;
};

/// All segments of one kind, in the order of their faces.
std::vector<Segment> in_face_order(const std::vector<Part>& parts, std::vector<Segment> Part::*kind, std::size_t faces)
{
    std::size_t count = 0;
    for (const Part& part : parts)
        count += (part.*kind).size();
    std::vector<std::uint64_t> keys;
    std::vector<const Segment*> where;
    keys.reserve(count);
    where.reserve(count);
    for (const Part& part : parts)
        for (const Segment& s : part.*kind) {
            keys.push_back(keyed(s.face, std::uint32_t(where.size())));
            where.push_back(&s);
        }
    sort_by_key(keys, std::uint32_t(faces));
    std::vector<Segment> sorted(keys.size());
    parallel_each(keys.size(), 4096, [&](std::size_t i) { sorted[i] = *where[item_of(keys[i])]; });
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
    const std::vector<Part> parts = Extraction(model, clusters, view, request).run(bounded);
    if (history)
        remember(*history, parts, clusters.clusters.size(), bounded);
    ClusterLines lines;
    lines.contours = in_face_order(parts, &Part::contours, model.faces.size());
    lines.suggestive = in_face_order(parts, &Part::suggestive, model.faces.size());
    lines.highlights = in_face_order(parts, &Part::highlights, model.faces.size());
    if (request.contours)
        append_crease_outlines(model, view, lines.contours);
    return lines;
}

} // namespace limn
