#include "limn/lines/feature_size.h"

#include <algorithm>
#include <cmath>

#include "limn/base/error.h"

namespace limn {
namespace {

/// Distance of the farthest vertex from the centre of the bounds.
float sphere_radius(const LineModel& model)
{
    float square = 0;
    for (const uvec3& t : model.faces)
        for (int k = 0; k < 3; ++k)
            square = std::max(square, glm::dot(model.positions[t[k]], model.positions[t[k]]));
    return std::sqrt(square);
}

float median_edge(const LineModel& model)
{
    std::vector<float> lengths;
    const std::vector<std::uint32_t>& twin = model.solid().twin;
    for (std::uint32_t h = 0; h < twin.size(); ++h)
        if (h < twin[h]) // `none` is above every half-edge: borders count once
            lengths.push_back(glm::distance(model.positions[model.faces[h / 3][int(h % 3)]], model.positions[model.faces[h / 3][int((h + 1) % 3)]]));
    if (lengths.empty())
        return 0;
    std::nth_element(lengths.begin(), lengths.begin() + std::ptrdiff_t(lengths.size() / 2), lengths.end());
    return lengths[lengths.size() / 2];
}

/// The 10th percentile of |k1| and |k2| over 500 vertices spread evenly over the model.
float low_curvature(const LineModel& model)
{
    if (!model.has_curvature())
        throw Error::Input("--feature-size: 'curvature' needs a surface with curvature");
    std::vector<float> values;
    const std::size_t samples = std::min<std::size_t>(500, model.vertex_count());
    for (std::size_t i = 0; i < samples; ++i) {
        const std::size_t v = i * model.vertex_count() / samples;
        values.push_back(std::abs(model.k1[v]));
        values.push_back(std::abs(model.k2[v]));
    }
    if (values.empty())
        return 0;
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 10), values.end());
    return values[values.size() / 10];
}

} // namespace

float model_feature_size(const LineModel& model, const FeatureSize& size)
{
    const float sphere = 0.05f * sphere_radius(model);
    switch (size.mode) {
    case FeatureSizeMode::edge_median:
        return median_edge(model);
    case FeatureSizeMode::curvature: {
        const float low = low_curvature(model);
        return low > 0 ? std::min(0.01f / low, sphere) : sphere;
    }
    case FeatureSizeMode::length:
        return float(size.length / model.scale);
    case FeatureSizeMode::bsphere:
        break;
    }
    return sphere;
}

} // namespace limn
