#include "limn/gpu/terrain_lists.h"

#include <algorithm>

#include <epoxy/gl.h>

#include "limn/gpu/context.h"

namespace limn::gpu {
namespace {

constexpr std::size_t block = 256, most_arguments = 12, most_steps = 64;
constexpr std::size_t arguments_at = sizeof(ListState), steps_at = arguments_at + most_arguments * sizeof(uvec4),
                      state_bytes = steps_at + most_steps * sizeof(uvec4);

std::uint32_t pack(const ivec2& p) { return std::uint32_t(p.x) | std::uint32_t(p.y) << 16; }
ivec2 unpack(std::uint32_t p) { return {int(p & 0xffff), int(p >> 16)}; }

} // namespace

uvec4 entry_for(const BisectionTriangle& t, unsigned bits) { return {pack(t.apex), pack(t.a), pack(t.b), bits}; }
BisectionTriangle triangle_of(const uvec4& entry) { return {unpack(entry.x), unpack(entry.y), unpack(entry.z)}; }

TerrainLists::TerrainLists(std::size_t capacity) : state_(state_bytes), report_(sizeof(ListState))
{
    state_.clear();
    grow(capacity);
}

void TerrainLists::grow(std::size_t capacity)
{
    GLint64 most = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    const std::size_t wanted = std::min(std::max(capacity, block), std::max(capacity / 2, std::size_t(most) / sizeof(uvec4)));
    const std::size_t bytes = storage_bytes(wanted, sizeof(uvec4), "triangles");
    for (Buffer* list : {&first_, &second_}) {
        Buffer larger(bytes);
        if (const std::size_t held = std::min(list->bytes(), bytes); held > 0)
            glCopyNamedBufferSubData(list->id(), larger.id(), 0, 0, GLsizeiptr(held));
        *list = std::move(larger);
    }
    sums_ = Buffer((wanted + block - 1) / block * sizeof(unsigned));
    capacity_ = wanted;
    const auto value = std::uint32_t(wanted);
    state_.write(offsetof(ListState, capacity), sizeof(value), &value);
}

void TerrainLists::set_pieces_capacity(std::size_t capacity) const
{
    const auto value = std::uint32_t(capacity);
    state_.write(offsetof(ListState, pieces_capacity), sizeof(value), &value);
}

void TerrainLists::start(const Buffer& triangles, std::size_t count, std::initializer_list<unsigned> passes) const
{
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyNamedBufferSubData(triangles.id(), first_.id(), 0, 0, GLsizeiptr(count * sizeof(uvec4)));
    ListState state = {};
    state.count = std::uint32_t(count);
    state_.write(0, offsetof(ListState, capacity), &state);
    state_.write(offsetof(ListState, total), offsetof(ListState, pieces) - offsetof(ListState, total), &state.total);
    state_.write(offsetof(ListState, pieces_needed), sizeof(state.pieces_needed), &state.pieces_needed);
    std::vector<uvec4> arguments(most_arguments, uvec4(0));
    for (const unsigned pass : passes)
        arguments[pass] = {unsigned((count + block - 1) / block), 1, 1, 0};
    state_.write(arguments_at, most_arguments * sizeof(uvec4), arguments.data());
}

void TerrainLists::bind() const
{
    unsigned binding = 0;
    for (const Buffer* buffer : {&state_, &first_, &second_, &sums_})
        buffer->bind_storage(binding++);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, state_.id());
}

void TerrainLists::dispatch(const Program& program, unsigned argument) const
{
    program.use();
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    glDispatchComputeIndirect(GLintptr(arguments_at + argument * sizeof(uvec4)));
}

void TerrainLists::ask()
{
    if (fence_.is_set())
        return; // the last question has no answer yet
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyNamedBufferSubData(state_.id(), report_.id(), 0, 0, sizeof(ListState));
    fence_.set();
}

std::optional<ListState> TerrainLists::answer()
{
    if (!fence_.is_set() || !fence_.has_passed())
        return std::nullopt;
    fence_.clear();
    return report_.read<ListState>(1)[0];
}

ListState TerrainLists::read() const
{
    check_errors("refining a terrain");
    return state_.read<ListState>(1)[0];
}

std::vector<uvec4> TerrainLists::read_steps() const
{
    const std::size_t number = std::min<std::size_t>(read().step_number, most_steps);
    return state_.read<uvec4>(number, steps_at / sizeof(uvec4));
}

std::vector<BisectionTriangle> TerrainLists::read_triangles() const
{
    const ListState state = read();
    std::vector<BisectionTriangle> out;
    out.reserve(state.count);
    for (const uvec4& entry : (state.side == 0 ? first_ : second_).read<uvec4>(state.count))
        out.push_back(triangle_of(entry));
    return out;
}

} // namespace limn::gpu
