#include "limn/gpu/block_scan.h"

#include <algorithm>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn::gpu {
namespace {

constexpr std::size_t group_size = 256, most = group_size * group_size * group_size;

} // namespace

void dispatch_groups(std::size_t groups)
{
    constexpr std::size_t row = 32768;
    if (groups > 0)
        glDispatchCompute(unsigned(std::min(groups, row)), unsigned((groups + row - 1) / row), 1);
}

BlockScan::BlockScan(std::size_t count) : program_(load_program({"scan_blocks.comp"}))
{
    if (count > most)
        throw Error::Input(fmt::format("prefix sums on the GPU: {} numbers are more than {}", count, most));
    first_[0] = 0;
    for (int level = 0; level < 3; ++level) {
        count_[level] = unsigned(count);
        first_[level + 1] = first_[level] + unsigned(count);
        count = std::max<std::size_t>((count + group_size - 1) / group_size, 1);
    }
    sums_ = Buffer((std::size_t(first_[3]) + 1) * sizeof(uvec4));
    sums_.clear();
}

void BlockScan::run() const
{
    sums_.bind_storage(6);
    program_.use();
    for (int level = 0; level < 3; ++level) {
        program_.set("first", first_[level]);
        program_.set("count", count_[level]);
        program_.set("next", first_[level + 1]);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        dispatch_groups((count_[level] + group_size - 1) / group_size);
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

} // namespace limn::gpu
