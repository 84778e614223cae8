#include "limn/gpu/shadow_look_up.h"

#include <algorithm>

#include <epoxy/gl.h>

#include "limn/gpu/context.h"

namespace limn::gpu {
namespace {

/// As in shadow_look_up.comp.
struct Query {
    vec4 from, to, among;
};

constexpr std::size_t most_at_once = 1 << 20; ///< queries in a dispatch

Buffer firsts_of(const SegmentLists& lists)
{
    storage_bytes(lists.first.size(), sizeof(std::uint32_t), "lists of segments");
    return Buffer(std::vector<std::uint32_t>(lists.first.begin(), lists.first.end()));
}

Buffer runs_of(const SegmentLists& lists)
{
    return Buffer(storage_bytes(lists.segments.size(), sizeof(DepthSegment), "segments of depth"), lists.segments.data());
}

} // namespace

ShadowLookUp::ShadowLookUp(const MapLayout& layout, const SegmentLists& lists)
    : layout_(layout), program_(load_program({"shadow_look_up.comp"})), firsts_(firsts_of(lists)), runs_(runs_of(lists))
{
}

std::vector<Verdict> ShadowLookUp::at(std::span<const ShadowQuery> queries) const
{
    std::vector<Verdict> verdicts;
    verdicts.reserve(queries.size());
    program_.set("spread", int(layout_.grid.spread));
    program_.set("order", int(layout_.order));
    program_.set("size", layout_.size);
    program_.set("cells", layout_.grid.cells);
    firsts_.bind_storage(0);
    runs_.bind_storage(1);
    for (std::size_t first = 0; first < queries.size(); first += most_at_once) {
        const std::span<const ShadowQuery> part = queries.subspan(first, std::min(most_at_once, queries.size() - first));
        std::vector<Query> packed;
        packed.reserve(part.size());
        for (const ShadowQuery& query : part)
            packed.push_back({vec4(query.from, 0), query.to, vec4(query.among, 0, 0)});
        const Buffer in(packed), out(part.size() * sizeof(int));
        in.bind_storage(2);
        out.bind_storage(3);
        program_.use();
        glDispatchCompute(unsigned(part.size() + 63) / 64, 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        for (const int verdict : out.read<int>(part.size()))
            verdicts.push_back(Verdict(verdict));
    }
    check_errors("looking up shadows");
    return verdicts;
}

} // namespace limn::gpu
