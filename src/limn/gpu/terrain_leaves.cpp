#include "limn/gpu/terrain_leaves.h"

#include <algorithm>
#include <utility>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/terrain/par_view.h"

namespace limn::gpu {
namespace {

constexpr int most_level = 14;        // paths are numbers of 30 bits
enum Pass : unsigned { count, fill }; // as in leaves.glsl

const TerrainBuffers& checked(const TerrainBuffers& terrain)
{
    if (!terrain.has_ranges())
        throw Error::Input("a strict mesh on the GPU needs the terrain's errors");
    if (terrain.lattice().level > most_level)
        throw Error::Input(fmt::format("root squares of 2^{} cells: the GPU path takes at most 2^{}", terrain.lattice().level, most_level));
    return terrain;
}

std::vector<uvec4> roots(const Lattice& lattice)
{
    std::vector<uvec4> out;
    for (const BisectionTriangle& t : root_triangles(lattice))
        out.push_back(entry_for(t, 1));
    return out;
}

bool is_same(const ViewTolerance& a, const ViewTolerance& b) { return a.pixels == b.pixels && a.nearest == b.nearest && a.cull == b.cull; }

} // namespace

TerrainLeaves::TerrainLeaves(const TerrainBuffers& terrain, std::size_t capacity)
    : terrain_(checked(terrain)), begin_program_(load_program({"leaves_begin.comp"})), count_program_(load_program({"leaves_count.comp"})),
      scan_program_(load_program({"leaves_scan.comp"})), fill_program_(load_program({"leaves_fill.comp"})),
      roots_(roots(terrain.lattice())),
      lists_(std::max(capacity, 2 * std::size_t(terrain.lattice().roots.x) * std::size_t(terrain.lattice().roots.y))),
      pieces_(terrain, lists_.capacity())
{
    start_over();
    lists_.set_pieces_capacity(pieces_.capacity());
    terrain.set_map(count_program_);
    for (int level = 0; level <= 2 * most_level; ++level)
        count_program_.set(fmt::format("reaches[{}]", level).c_str(), float(reach_of_point(1 << (level / 2), level % 2 == 1)));
}

void TerrainLeaves::update(const Camera& camera, const ViewTolerance& tolerance)
{
    if (!(tolerance.pixels >= 0))
        throw Error::Input(fmt::format("a tolerance of {} px: it has to be 0 or more", tolerance.pixels));
    const std::optional<ListState> report = lists_.answer();
    const bool was_short = report && (report->needed > 0 || report->pieces_needed > 0);
    if (camera_ && is_same_view(*camera_, camera) && is_same(tolerance_, tolerance) && !was_short)
        return;
    if (was_short)
        make_room(*report);
    camera_ = camera, tolerance_ = tolerance;
    count_program_.set("tolerance", float(tolerance.pixels));
    terrain_.set_view(count_program_, camera, tolerance.nearest, tolerance.cull);
    pieces_.set_view(camera, tolerance.cull);
    ++updates_;
    run();
    if (!std::exchange(measured_, true))
        complete();
    lists_.ask();
}

void TerrainLeaves::start_over() const { lists_.start(roots_, roots_.bytes() / sizeof(uvec4), {}); }

void TerrainLeaves::run()
{
    const int passes = 2 * terrain_.lattice().level + 2; // each splits what the one before made; the last one finds nothing
    const auto alone = [](const Program& program) {
        program.use();
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        glDispatchCompute(1, 1, 1);
    };
    lists_.bind();
    terrain_.bounds().bind_storage(4);
    alone(begin_program_);
    for (int i = 0; i < passes; ++i) {
        lists_.dispatch(count_program_, count);
        alone(scan_program_);
        lists_.dispatch(fill_program_, fill);
    }
    pieces_.make(lists_);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void TerrainLeaves::make_room(const ListState& state)
{
    if (state.needed > 0) {
        lists_.grow(2 * std::size_t(state.needed));
        start_over(); // the pass that found no room has left its leaves half changed
    }
    if (state.pieces_needed > 0 || pieces_.capacity() < lists_.capacity()) {
        pieces_.grow(std::max<std::size_t>(2 * std::size_t(state.pieces_needed), lists_.capacity()));
        lists_.set_pieces_capacity(pieces_.capacity());
    }
}

void TerrainLeaves::complete()
{
    for (ListState state = lists_.read(); state.needed > 0 || state.pieces_needed > 0; state = lists_.read()) {
        lists_.forget();
        make_room(state);
        run();
    }
}

std::vector<BisectionTriangle> TerrainLeaves::triangles()
{
    complete();
    return lists_.read_triangles();
}

} // namespace limn::gpu
