#include "limn/gpu/vector_propagation.h"

#include <algorithm>
#include <utility>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/gpu/context.h"

namespace limn::gpu {
namespace {

constexpr int batch = 16; ///< passes between looks whether something still changes; a look waits for the device

void dispatch(ivec2 size) { glDispatchCompute(unsigned(size.x + 15) / 16, unsigned(size.y + 15) / 16, 1); }

} // namespace

VectorPropagator::VectorPropagator() : propagate_(load_program({"propagate_vectors.comp"})), look_up_(load_program({"dilate.comp"})) {}

Buffer VectorPropagator::propagate(std::span<const std::uint8_t> marked, ivec2 size, const PropagationOptions& options, int& passes) const
{
    check(options, size);
    if (marked.empty() || marked.size() != std::size_t(size.x) * std::size_t(size.y))
        throw Error::Input(fmt::format("{} marks are no picture of {} x {} pixels", marked.size(), size.x, size.y));
    Buffer held(first_vectors(marked)), next(held.bytes());
    const Buffer changed(batch * sizeof(unsigned));
    propagate_.set("size", size);
    propagate_.set("stride", options.neighbours == 4 ? 2 : 1);
    passes = 0;
    for (bool goes_on = true; goes_on && passes < options.most_passes;) {
        const int count = std::min(batch, options.most_passes - passes);
        changed.clear();
        changed.bind_storage(2);
        for (int pass = 0; pass < count; ++pass) {
            held.bind_storage(0);
            next.bind_storage(1);
            propagate_.set("pass", pass);
            propagate_.use();
            dispatch(size);
            glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
            std::swap(held, next);
        }
        const std::vector<unsigned> flags = changed.read<unsigned>(std::size_t(count));
        const std::ptrdiff_t useful = std::find(flags.begin(), flags.end(), 0u) - flags.begin();
        passes += int(useful);
        goes_on = useful == count;
    }
    return held;
}

VectorField VectorPropagator::run(std::span<const std::uint8_t> marked, ivec2 size, const PropagationOptions& options) const
{
    VectorField field = {size, 0, {}};
    const Buffer held = propagate(marked, size, options, field.passes);
    field.vectors = held.read<std::uint32_t>(marked.size());
    check_errors("propagating distances");
    return field;
}

Image VectorPropagator::dilated(const Image& picture, const PropagationOptions& options) const
{
    int passes = 0;
    const Buffer held = propagate(set_pixels(picture), picture.size(), options, passes);
    const Buffer from(picture.samples), to(from.bytes());
    held.bind_storage(0);
    from.bind_storage(1);
    to.bind_storage(2);
    look_up_.set("size", picture.size());
    look_up_.use();
    dispatch(picture.size());
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    Image result(picture.size(), 4);
    result.samples = to.read<float>(picture.samples.size());
    check_errors("dilating a picture");
    return result;
}

} // namespace limn::gpu
