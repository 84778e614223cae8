#include "limn/gpu/par_refiner.h"

#include <algorithm>
#include <utility>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/terrain/par_view.h"

namespace limn::gpu {
namespace {

constexpr unsigned fresh = 8; // as in par.glsl
enum Pass : unsigned { test, mark, scatter, count, scan, fill };

std::vector<uvec4> entries(const std::vector<BisectionTriangle>& triangles)
{
    std::vector<uvec4> out;
    out.reserve(triangles.size());
    for (const BisectionTriangle& t : triangles)
        out.push_back(entry_for(t, fresh));
    return out;
}

} // namespace

bool ParRefiner::View::operator==(const View& other) const
{
    const bool same_camera = camera && other.camera ? is_same_view(*camera, *other.camera) : camera.has_value() == other.camera.has_value();
    return same_camera && tolerance == other.tolerance && nearest == other.nearest;
}

ParRefiner::ParRefiner(const TerrainBuffers& terrain, const std::vector<BisectionTriangle>& start, const ParRefinerOptions& options)
    : terrain_(terrain), test_program_(load_program({"par_test.comp"})), mark_program_(load_program({"par_mark.comp"})),
      control_program_(load_program({"par_control.comp"})), scatter_program_(load_program({"par_scatter.comp"})),
      count_program_(load_program({"par_count.comp"})), scan_program_(load_program({"par_scan.comp"})),
      fill_program_(load_program({"par_fill.comp"})), start_(entries(start)),
      edge_error_map_((terrain.lattice().point_count() + 31) / 32 * sizeof(unsigned)), start_count_(start.size()),
      lists_(std::max(options.capacity, start.size())), pieces_(terrain, lists_.capacity())
{
    lists_.set_pieces_capacity(pieces_.capacity());
    terrain.set_map(test_program_);
    mark_program_.set("points", terrain.lattice().points());
    scatter_program_.set("points", terrain.lattice().points());
}

void ParRefiner::refine(double metres) { refine({std::nullopt, metres, 0}); }
void ParRefiner::refine(const Camera& camera, double pixels, double nearest) { refine({camera, pixels, nearest}); }

void ParRefiner::refine(const View& view)
{
    if (!(view.tolerance >= 0))
        throw Error::Input(fmt::format("a tolerance of {} {}: it has to be 0 or more", view.tolerance, view.camera ? "px" : "m"));
    const std::optional<ListState> report = lists_.answer();
    const bool was_short = report && (report->finished == 0 || report->pieces_needed > 0);
    if (view_ == view && !was_short)
        return;
    if (was_short)
        make_room(*report);
    view_ = view;
    test_program_.set("on_screen", unsigned(view.camera.has_value()));
    test_program_.set("tolerance", float(view.tolerance));
    if (view.camera) {
        terrain_.set_view(test_program_, *view.camera, view.nearest, true);
        pieces_.set_view(*view.camera, true);
    } else {
        test_program_.set("cull", 0u);
        pieces_.set_no_view();
    }
    ++refinements_;
    begin();
    run(passes_);
    if (!std::exchange(measured_, true))
        complete();
    lists_.ask();
}

void ParRefiner::begin()
{
    edge_error_map_.clear();
    lists_.start(start_, start_count_, {test, mark});
}

void ParRefiner::run(unsigned passes)
{
    lists_.bind();
    terrain_.bind();
    edge_error_map_.bind_storage(4);
    for (unsigned i = 0; i < passes; ++i) {
        lists_.dispatch(test_program_, test);
        lists_.dispatch(mark_program_, mark);
        control_program_.use();
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        glDispatchCompute(1, 1, 1);
        lists_.dispatch(scatter_program_, scatter);
        lists_.dispatch(count_program_, count);
        lists_.dispatch(scan_program_, scan);
        lists_.dispatch(fill_program_, fill);
    }
    pieces_.make(lists_);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void ParRefiner::make_room(const ListState& state)
{
    if (state.needed > 0)
        lists_.grow(2 * std::size_t(state.needed));
    else if (state.finished == 0)
        passes_ = 2 * std::max(passes_, unsigned(state.passes));
    if (state.pieces_needed > 0 || pieces_.capacity() < lists_.capacity()) {
        pieces_.grow(std::max<std::size_t>(2 * std::size_t(state.pieces_needed), lists_.capacity()));
        lists_.set_pieces_capacity(pieces_.capacity());
    }
}

void ParRefiner::complete()
{
    ListState state = lists_.read();
    for (; state.finished == 0 || state.pieces_needed > 0; state = lists_.read()) {
        lists_.forget();
        make_room(state);
        begin();
        run(passes_);
    }
    passes_ = std::max(passes_ / 2, 2 * unsigned(state.passes)); // twice what it took, and falling slowly
}

std::vector<BisectionTriangle> ParRefiner::triangles()
{
    complete();
    return lists_.read_triangles();
}

std::vector<ParStep> ParRefiner::steps()
{
    complete();
    std::vector<ParStep> out;
    for (const uvec4& step : lists_.read_steps())
        out.push_back({int(step.x), step.y, step.z, step.w});
    return out;
}

} // namespace limn::gpu
