#include "limn/shadow/pixel_codec.h"

#include <algorithm>

#include "limn/base/parallel.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1024;

} // namespace

PixelCodec::PixelCodec(std::size_t texels, float margin) : margin_(margin), runs_(texels), lists_(texels) {}

void PixelCodec::begin(std::size_t texel, float near, float far) { runs_[texel] = {near, far, near == no_surface}; }

DepthSegment PixelCodec::ended(const Run& run) const
{
    if (run.background)
        return {no_surface, maps_ - 1};
    const float middle = 0.5f * (run.low + run.high);
    return {middle < run.high ? middle : run.low, maps_ - 1};
}

void PixelCodec::add(const DepthLayers& layers)
{
    parallel_each(runs_.size(), grain, [&](std::size_t texel) {
        float near = layers.near[texel], far = layers.far[texel];
        const bool background = near == no_surface;
        if (!background && margin_ > 0) {
            const float away = margin_ * (far - near);
            near += away, far -= away;
        }
        if (maps_ == 0) {
            begin(texel, near, far);
            return;
        }
        Run& run = runs_[texel];
        const float low = std::max(run.low, near), high = std::min(run.high, far);
        if (background ? run.background : !run.background && low < high) {
            run.low = low, run.high = high;
            return;
        }
        lists_[texel].push_back(ended(run));
        begin(texel, near, far);
    });
    ++maps_;
}

SegmentLists PixelCodec::finish()
{
    SegmentLists all;
    all.first.push_back(0);
    for (std::size_t texel = 0; texel < runs_.size(); ++texel) {
        if (maps_ > 0)
            lists_[texel].push_back(ended(runs_[texel]));
        all.first.push_back(all.first.back() + lists_[texel].size());
    }
    all.segments.resize(all.first.back());
    parallel_each(runs_.size(), grain, [&](std::size_t texel) {
        std::copy(lists_[texel].begin(), lists_[texel].end(), all.segments.begin() + std::ptrdiff_t(all.first[texel]));
        lists_[texel] = {};
    });
    maps_ = 0;
    return all;
}

} // namespace limn
