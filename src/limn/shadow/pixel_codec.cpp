#include "limn/shadow/pixel_codec.h"

#include <algorithm>

#include "limn/base/parallel.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1024;

} // namespace

PixelCodec::PixelCodec(std::size_t texels, float margin) : margin_(margin), runs_(texels), lists_(texels) {}

void PixelCodec::add(const DepthLayers& layers)
{
    parallel_each(runs_.size(), grain, [&](std::size_t texel) {
        float near = layers.near[texel], far = layers.far[texel];
        if (near != no_surface && margin_ > 0) {
            const float away = margin_ * (far - near);
            near += away, far -= away;
        }
        if (maps_ > 0 && runs_[texel].extend(near, far))
            return;
        if (maps_ > 0)
            lists_[texel].push_back({runs_[texel].depth(), maps_ - 1});
        runs_[texel] = DepthRun::from(near, far);
    });
    ++maps_;
}

SegmentLists PixelCodec::finish()
{
    SegmentLists all;
    all.first.push_back(0);
    for (std::size_t texel = 0; texel < runs_.size(); ++texel) {
        if (maps_ > 0)
            lists_[texel].push_back({runs_[texel].depth(), maps_ - 1});
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
