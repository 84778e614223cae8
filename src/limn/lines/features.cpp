#include "limn/lines/features.h"

#include "limn/base/error.h"
#include "limn/lines/ridge.h"

namespace limn {
namespace {

bool wants_suggestive(const LineOptions& options) { return options.has(LineType::suggestive) || options.has(LineType::highlight); }

std::vector<Segment> ridges_of_kind(const LineModel& model, RidgeKind kind, float feature_size, const LineOptions& options)
{
    RidgeOptions ridge;
    ridge.kind = kind;
    ridge.feature_size = feature_size;
    ridge.limit = float(options.ridge_limit);
    ridge.fade = float(options.fade);
    return extract_ridges(model, ridge);
}

/// Segments along edges with their ends numbered past the ids of edges.
std::vector<Segment> as_nodes(const LineModel& model, std::vector<Segment> segments)
{
    for (Segment& s : segments) {
        s.edge_a = model.vertex_node(s.edge_a);
        s.edge_b = model.vertex_node(s.edge_b);
    }
    return segments;
}

} // namespace

LineFeatures find_line_features(const LineModel& model, const LineOptions& options, int views)
{
    LineFeatures features;
    features.feature_size = model_feature_size(model, options.feature_size);
    // Borders hide other lines whether they are drawn or not.
    features.borders = as_nodes(model, edge_segments(model, find_borders(model)));
    if (options.has(LineType::crease)) {
        CreaseOptions crease;
        crease.angle = options.crease_angle;
        features.creases = as_nodes(model, edge_segments(model, find_creases(model, crease)));
    }
    if (options.has(LineType::ridge))
        features.ridges = ridges_of_kind(model, RidgeKind::ridge, features.feature_size, options);
    if (options.has(LineType::valley))
        features.valleys = ridges_of_kind(model, RidgeKind::valley, features.feature_size, options);
    if (wants_suggestive(options) && !model.has_derivative())
        throw Error::Input("suggestive contours and highlights need the derivative of curvature, which this surface has not");
    if (wants_suggestive(options))
        features.suggestive = find_suggestive_faces(model);
    if (views >= views_worth_clusters)
        features.clusters = build_clusters(model);
    return features;
}

} // namespace limn
