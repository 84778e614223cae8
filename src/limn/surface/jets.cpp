#include "limn/surface/jets.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <tbb/enumerable_thread_specific.h>

#include "limn/base/parallel.h"
#include "limn/surface/tangent.h"

namespace limn {
namespace {

constexpr std::size_t chunk = 2048;

struct Attempt {
    JetModel model;
    RingSize size;
};

std::size_t least_points(int degree, int rings)
{
    if (degree == 4)
        return rings <= 2 ? 18 : rings == 3 ? 24 : 30;
    return degree == 3 ? 12 : 7;
}

/// The wanted fit, and what to try after it.
std::vector<Attempt> attempts(const JetSetting& setting)
{
    const auto attempt = [&](int degree, int rings) {
        return Attempt{{degree, setting.model.interpolating}, {rings, least_points(degree, rings)}};
    };
    const int degree = setting.model.degree, rings = setting.rings;
    std::vector<Attempt> list = {attempt(degree, rings), attempt(degree, rings + 1), attempt(degree, rings + 2)};
    if (degree > 3)
        list.push_back(attempt(3, rings + 1));
    // Near points count most in the last attempts, whatever the noise.
    list.push_back({{2, true}, {2, least_points(2, 2)}});
    list.push_back({{2, true}, {2, least_points(2, 2), -1}});
    return list;
}

/// Numbers that a thread reuses from chunk to chunk.
struct Scratch {
    RingCollector collector;
    Neighbourhoods hoods;
    std::vector<Jet> jets;
};

/// A fit whose normal is far from the faces' has found a slope between the points that nobody can see.
bool plausible(const Jet& jet, const dvec3& face_normal)
{
    const double most = std::numeric_limits<float>::max();
    const dvec4 size = glm::abs(jet.derivative);
    return jet.ok && glm::dot(jet.normal, face_normal) >= 0.8 && std::abs(jet.k1) < most &&
           std::max({size.x, size.y, size.z, size.w}) < most;
}

class SurfaceFit {
public:
    SurfaceFit(const JetContext& context, Need need, Surface& surface)
        : context_(context), derivative_(need == Need::derivative), surface_(surface),
          scratch_([&] { return Scratch{RingCollector(context.positions, context.normals, context.neighbours), {}, {}}; })
    {
    }

    /// Fits `count` vertices; vertex(i) is the i-th. Returns those without a fit, in order.
    template <class Vertex> std::vector<std::uint32_t> fit(std::size_t count, Vertex&& vertex, const Attempt& attempt)
    {
        return parallel_collect<std::uint32_t>(count, chunk, [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& failed) {
            Scratch& scratch = scratch_.local();
            scratch.hoods.clear();
            for (std::size_t i = begin; i < end; ++i)
                collect(vertex(i), attempt.size, scratch, failed);
            scratch.jets.resize(scratch.hoods.size());
            fit_jets({context_.positions, context_.normals, &scratch.hoods, false}, attempt.model, scratch.jets);
            for (std::size_t i = 0; i < scratch.jets.size(); ++i)
                if (plausible(scratch.jets[i], context_.normals[scratch.hoods.centre[i]]))
                    store(scratch.hoods.centre[i], scratch.jets[i]);
                else
                    failed.push_back(scratch.hoods.centre[i]);
            std::sort(failed.begin(), failed.end());
        });
    }

    void flag(std::uint32_t v)
    {
        const TangentFrame frame = any_frame(context_.normals[v]);
        surface_.normals[v] = vec3(frame.n);
        surface_.e1[v] = vec3(frame.u);
        surface_.e2[v] = vec3(frame.v);
        surface_.k1[v] = surface_.k2[v] = 0;
        if (derivative_)
            surface_.derivative[v] = vec4(0);
        surface_.unreliable[v] = 1;
    }

private:
    void collect(std::uint32_t v, const RingSize& size, Scratch& scratch, std::vector<std::uint32_t>& failed)
    {
        if (context_.normals[v] == dvec3(0)) {
            failed.push_back(v);
            return;
        }
        scratch.collector.collect(v, size, scratch.hoods.neighbour);
        scratch.hoods.close(v);
    }

    void store(std::uint32_t v, const Jet& jet)
    {
        surface_.normals[v] = vec3(jet.normal);
        surface_.e1[v] = vec3(jet.e1);
        surface_.e2[v] = vec3(glm::cross(jet.normal, jet.e1));
        surface_.k1[v] = float(jet.k1);
        surface_.k2[v] = float(jet.k2);
        if (derivative_)
            surface_.derivative[v] = vec4(jet.derivative);
    }

    const JetContext& context_;
    bool derivative_;
    Surface& surface_;
    tbb::enumerable_thread_specific<Scratch> scratch_;
};

void resize(Surface& surface, std::size_t vertices, Need need)
{
    surface.normals.resize(vertices);
    surface.e1.resize(vertices);
    surface.e2.resize(vertices);
    surface.k1.resize(vertices);
    surface.k2.resize(vertices);
    surface.derivative.resize(need == Need::derivative ? vertices : 0);
    surface.unreliable.assign(vertices, 0);
}

} // namespace

JetContext make_jet_context(const Mesh& mesh, const VertexFaces& faces)
{
    return {mesh.positions, build_neighbours(mesh.triangles, faces), area_normals(mesh.positions, mesh.triangles, faces)};
}

JetCounts fit_surface(const JetContext& context, const JetSetting& setting, Need need, Surface& surface)
{
    const std::size_t vertices = context.positions.size();
    resize(surface, vertices, need);
    const std::vector<Attempt> list = attempts(setting);
    SurfaceFit fit(context, need, surface);
    JetCounts counts;
    std::vector<std::uint32_t> left = fit.fit(vertices, [](std::size_t i) { return std::uint32_t(i); }, list.front());
    counts.refitted = left.size();
    for (std::size_t a = 1; a < list.size() && !left.empty(); ++a) {
        const std::vector<std::uint32_t> targets = std::move(left);
        left = fit.fit(targets.size(), [&](std::size_t i) { return targets[i]; }, list[a]);
    }
    for (const std::uint32_t v : left)
        fit.flag(v);
    counts.failed = left.size();
    return counts;
}

} // namespace limn
