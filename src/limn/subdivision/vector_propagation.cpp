#include "limn/subdivision/vector_propagation.h"

#include <algorithm>
#include <atomic>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/formulas/formulas.h"

// The shared text needs the dialect's word once more, inside of a struct.
#define FORMULA inline

namespace limn {
namespace formulas {

/// The vectors of a picture as the formula asks for them.
struct HeldVectors {
    const std::uint32_t* vectors;
    ivec2 size;

    uint vector_at(const ivec2 p) const
    {
        if (p.x < 0 || p.y < 0 || p.x >= size.x || p.y >= size.y)
            return 0xFFFFFFFFu;
        return vectors[std::size_t(p.y) * std::size_t(size.x) + std::size_t(p.x)];
    }
#include "limn/formulas/vector_propagation.glsl"
};

} // namespace formulas

namespace {

constexpr float least_alpha = 0.98f;

std::size_t index_of(ivec2 size, int x, int y) { return std::size_t(y) * std::size_t(size.x) + std::size_t(x); }

/// One pass. @return whether a pixel changed
bool pass(const std::vector<std::uint32_t>& from, std::vector<std::uint32_t>& to, ivec2 size, int stride)
{
    std::atomic<bool> changed = false;
    parallel_blocks(std::size_t(size.y), 16, [&](std::size_t begin, std::size_t end) {
        formulas::HeldVectors held = {from.data(), size};
        bool any = false;
        for (int y = int(begin); y < int(end); ++y)
            for (int x = 0; x < size.x; ++x) {
                const std::size_t i = index_of(size, x, y);
                to[i] = held.nearest_vector({x, y}, stride);
                any = any || to[i] != from[i];
            }
        if (any)
            changed.store(true, std::memory_order_relaxed);
    });
    return changed;
}

} // namespace

bool VectorField::is_known(int x, int y) const
{
    return vectors[index_of(size, x, y)] != formulas::HeldVectors{}.no_vector();
}

ivec2 VectorField::vector(int x, int y) const { return formulas::HeldVectors{}.unpacked_vector(vectors[index_of(size, x, y)]); }

void check(const PropagationOptions& options, ivec2 size)
{
    if (options.neighbours != 8 && options.neighbours != 4)
        throw Error::Input(fmt::format("distances are propagated among 8 or 4 neighbours, not {}", options.neighbours));
    if (options.most_passes < 0)
        throw Error::Input(fmt::format("{} passes of propagation are fewer than 0", options.most_passes));
    if (size.x < 0 || size.y < 0 || std::max(size.x, size.y) > longest_propagation)
        throw Error::Input(fmt::format("distances are propagated in pictures of up to {} pixels a side, not {} x {}", longest_propagation, size.x, size.y));
}

std::vector<std::uint32_t> first_vectors(std::span<const std::uint8_t> marked)
{
    formulas::HeldVectors none_yet{};
    std::vector<std::uint32_t> vectors(marked.size(), none_yet.no_vector());
    for (std::size_t i = 0; i < marked.size(); ++i)
        if (marked[i] != 0)
            vectors[i] = none_yet.packed_vector(ivec2(0));
    return vectors;
}

VectorField propagate_vectors(std::span<const std::uint8_t> marked, ivec2 size, const PropagationOptions& options)
{
    check(options, size);
    if (marked.size() != std::size_t(size.x) * std::size_t(size.y))
        throw Error::Input(fmt::format("{} marks are no picture of {} x {} pixels", marked.size(), size.x, size.y));
    VectorField field = {size, 0, first_vectors(marked)};
    std::vector<std::uint32_t> next(field.vectors.size());
    while (field.passes < options.most_passes && pass(field.vectors, next, size, options.neighbours == 4 ? 2 : 1)) {
        std::swap(field.vectors, next);
        ++field.passes;
    }
    return field;
}

std::vector<std::uint8_t> set_pixels(const Image& picture)
{
    if (picture.channels != 4)
        throw Error::Input(fmt::format("a picture of {} channels has no fourth one that tells which pixels are set", picture.channels));
    std::vector<std::uint8_t> marked(picture.samples.size() / 4);
    for (std::size_t i = 0; i < marked.size(); ++i)
        marked[i] = picture.samples[4 * i + 3] > least_alpha;
    return marked;
}

Image dilated(const Image& picture, const PropagationOptions& options)
{
    const VectorField field = propagate_vectors(set_pixels(picture), picture.size(), options);
    Image result = picture;
    parallel_each(std::size_t(picture.height), 16, [&](std::size_t row) {
        const int y = int(row);
        for (int x = 0; x < picture.width; ++x)
            if (field.is_known(x, y)) {
                const ivec2 from = ivec2(x, y) + field.vector(x, y);
                std::copy_n(picture.at(from.x, from.y), 3, result.at(x, y));
            }
    });
    return result;
}

} // namespace limn
