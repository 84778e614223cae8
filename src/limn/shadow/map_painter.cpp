#include "limn/shadow/map_painter.h"

#include "limn/base/parallel.h"

namespace limn {
namespace {

class ProcessorPainter : public MapPainter {
public:
    ProcessorPainter(const ShadowCaster& caster, int size, OpenBack back) : caster_(caster), size_(size), back_(back) {}

    std::span<const DepthLayers> paint(std::span<const MapFrame> frames) override
    {
        while (painters_.size() < frames.size())
            painters_.push_back(std::make_unique<DepthPainter>(caster_, size_, back_));
        maps_.resize(std::max(maps_.size(), frames.size()));
        parallel_each(frames.size(), 1, [&](std::size_t k) { painters_[k]->paint(frames[k], maps_[k]); });
        return {maps_.data(), frames.size()};
    }

private:
    const ShadowCaster& caster_;
    int size_;
    OpenBack back_;
    std::vector<std::unique_ptr<DepthPainter>> painters_;
    std::vector<DepthLayers> maps_;
};

} // namespace

std::unique_ptr<MapPainter> processor_painter(const ShadowCaster& caster, int size, OpenBack back)
{
    return std::make_unique<ProcessorPainter>(caster, size, back);
}

} // namespace limn
