#include "limn/shadow/map_clusters.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "limn/base/parallel.h"
#include "limn/base/random.h"

namespace limn {
namespace {

constexpr std::size_t grain = 4;

float finite(float depth) { return depth == no_surface ? 1.0f : depth; }

double distance(const DepthLayers& a, const DepthLayers& b, double best)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.near.size() && sum < best; ++i) {
        const double near = double(finite(a.near[i])) - finite(b.near[i]), far = double(finite(a.far[i])) - finite(b.far[i]);
        sum += near * near + far * far;
    }
    return sum;
}

/// The mean of a cluster's maps; background where all of them have it.
DepthLayers mean_of(const std::vector<DepthLayers>& maps, const std::vector<std::uint32_t>& cluster, std::uint32_t number)
{
    const std::size_t texels = maps[0].near.size();
    std::vector<double> near(texels, 0), far(texels, 0);
    std::vector<char> hit(texels, 0);
    double count = 0;
    for (std::size_t map = 0; map < maps.size(); ++map) {
        if (cluster[map] != number)
            continue;
        ++count;
        for (std::size_t i = 0; i < texels; ++i) {
            near[i] += finite(maps[map].near[i]), far[i] += finite(maps[map].far[i]);
            hit[i] |= char(maps[map].near[i] != no_surface);
        }
    }
    DepthLayers mean = maps[0];
    for (std::size_t i = 0; i < texels; ++i) {
        mean.near[i] = hit[i] ? float(near[i] / count) : no_surface;
        mean.far[i] = hit[i] ? float(far[i] / count) : no_surface;
    }
    return mean;
}

/// `count` different numbers below `all`, in a random order.
std::vector<std::uint32_t> draw(std::size_t all, std::size_t count, std::uint64_t seed)
{
    std::vector<std::uint32_t> numbers(all);
    std::iota(numbers.begin(), numbers.end(), 0u);
    Random random(seed);
    for (std::size_t i = 0; i < count; ++i)
        std::swap(numbers[i], numbers[i + random.below(std::uint32_t(all - i))]);
    numbers.resize(count);
    return numbers;
}

bool is_right(float depth, float near, float far) { return near == no_surface ? depth == no_surface : near <= depth && depth < far; }

} // namespace

MapClusters cluster_maps(const std::vector<DepthLayers>& maps, std::size_t count, std::uint64_t seed, int rounds)
{
    MapClusters clusters;
    for (const std::uint32_t first : draw(maps.size(), count, seed))
        clusters.means.push_back(maps[first]);
    for (int round = 0; round < rounds; ++round) {
        std::vector<std::uint32_t> nearest(maps.size());
        parallel_each(maps.size(), grain, [&](std::size_t map) {
            double best = std::numeric_limits<double>::infinity();
            for (std::uint32_t k = 0; k < count; ++k)
                if (const double d = distance(maps[map], clusters.means[k], best); d < best)
                    best = d, nearest[map] = k;
        });
        if (nearest == clusters.cluster)
            break;
        clusters.cluster = nearest;
        std::vector<char> used(count, 0);
        for (const std::uint32_t k : nearest)
            used[k] = 1;
        parallel_each(count, 1, [&](std::size_t k) {
            if (used[k])
                clusters.means[k] = mean_of(maps, clusters.cluster, std::uint32_t(k));
        });
    }
    return clusters;
}

RepairedLists::RepairedLists(const std::vector<DepthLayers>& maps, const MapClusters& clusters)
{
    const std::size_t texels = maps[0].near.size();
    PixelCodec codec(texels);
    for (const std::uint32_t k : clusters.cluster)
        codec.add(clusters.means[k]);
    lists_ = codec.finish();
    repairs_.first.push_back(0);
    for (std::size_t texel = 0; texel < texels; ++texel) {
        for (std::uint32_t rank = 0; rank < maps.size(); ++rank) {
            const float near = maps[rank].near[texel], far = maps[rank].far[texel];
            if (!is_right(lists_.depth(texel, rank), near, far))
                repairs_.segments.push_back({DepthRun::from(near, far).depth(), rank});
        }
        repairs_.first.push_back(repairs_.segments.size());
    }
}

float RepairedLists::depth(std::size_t texel, std::uint32_t rank) const
{
    const std::span<const DepthSegment> list = repairs_.list(texel);
    const auto found = std::lower_bound(list.begin(), list.end(), rank, [](const DepthSegment& s, std::uint32_t r) { return s.last < r; });
    return found != list.end() && found->last == rank ? found->depth : lists_.depth(texel, rank);
}

} // namespace limn
