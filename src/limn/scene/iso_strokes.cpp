#include "limn/scene/iso_strokes.h"

#include "limn/base/parallel.h"
#include "limn/drawing/simplify.h"
#include "limn/lines/contour.h"
#include "limn/lines/projector.h"
#include "limn/lines/strokes.h"
#include "limn/lines/visibility.h"

namespace limn {
namespace {

/// The mesh straight above or below a place.
struct Footing {
    std::uint32_t face = none;
    float z = 0; ///< in the model's frame
};

class Ground {
public:
    Ground(const LineModel& model, const RayScene& rays) : rays_(rays)
    {
        for (std::size_t i = 0; i < model.vertex_count(); ++i)
            top_ = std::max(top_, model.positions[i].z);
        top_ += 1;
    }
    /// The place itself, or where it is on the mesh's border and rounding moves it out, one a hair to the middle.
    Footing under(const vec3& p) const
    {
        for (const float inwards : {1.0f, 1 - 1e-5f, 1 - 1e-4f}) {
            const vec3 above(inwards * p.x, inwards * p.y, top_);
            if (const Hit hit = rays_.closest({above, vec3(0, 0, -1)}))
                return {hit.triangle, top_ - hit.distance};
        }
        return {};
    }

private:
    const RayScene& rays_;
    float top_ = 0;
};

/// Iso lines as segments of the mesh's faces, each line a chain.
struct IsoSegments {
    std::vector<Segment> on_mesh; ///< straight above or below
    std::vector<Segment> at_level;
    Chains chains;
};

IsoSegments segments_of(const IsoScene& scene, std::span<const IsoLine> lines)
{
    const Ground ground(scene.model, scene.rays);
    IsoSegments all;
    for (const IsoLine& line : lines) {
        const std::size_t n = line.points.size(), first = all.on_mesh.size(), count = line.closed ? n : n - 1;
        all.on_mesh.resize(first + count), all.at_level.resize(first + count);
        parallel_each(count, 256, [&](std::size_t i) {
            Segment at_level;
            at_level.a = scene.model.from_world(line.points[i]), at_level.b = scene.model.from_world(line.points[(i + 1) % n]);
            Segment on_mesh = at_level;
            const Footing a = ground.under(at_level.a), b = ground.under(at_level.b), middle = ground.under(0.5f * (at_level.a + at_level.b));
            if (a.face != none && b.face != none)
                on_mesh.a.z = a.z, on_mesh.b.z = b.z;
            at_level.face = on_mesh.face = middle.face != none ? middle.face : a.face != none ? a.face : b.face;
            all.on_mesh[first + i] = on_mesh, all.at_level[first + i] = at_level;
        });
        // What has no mesh under it all along is no line on it; else such a segment shares its neighbour's face.
        std::uint32_t known = none;
        for (int round = 0; round < 2; ++round)
            for (std::size_t i = first; i < first + count; ++i) {
                if (all.on_mesh[i].face == none)
                    all.on_mesh[i].face = all.at_level[i].face = known;
                known = all.on_mesh[i].face;
            }
        if (known == none) {
            all.on_mesh.resize(first), all.at_level.resize(first);
            continue;
        }
        for (std::size_t i = 0; i < count; ++i)
            all.chains.links.push_back({std::uint32_t(first + i), false});
        all.chains.start.push_back(std::uint32_t(all.chains.links.size()));
        all.chains.closed.push_back(line.closed);
    }
    return all;
}

} // namespace

std::vector<Stroke> iso_strokes(const IsoScene& scene, std::span<const IsoLine> lines, LineType type, const LineOptions& options)
{
    const IsoSegments segments = segments_of(scene, lines);
    const View view = scene.model.view(scene.camera);
    const Projector projector(scene.model, scene.camera);
    const std::vector<float> facing = facing_of_vertices(scene.model, view);
    const ViewContext context = {scene.model, scene.rays, view, projector, facing};
    const ChainElements decided = find_visibility(context, VisibilityRule::surface, segments.on_mesh, segments.chains, {}, OccluderGrid({}, scene.camera));
    StrokeOptions wanted;
    wanted.type = type;
    wanted.size = scene.camera.size;
    wanted.keep_hidden = options.hidden != Hidden::remove;
    std::vector<Stroke> strokes = make_strokes(context, segments.at_level, segments.chains, decided, wanted);
    parallel_each(strokes.size(), 16, [&](std::size_t i) { strokes[i] = simplify(strokes[i], {options.tolerance}); });
    return strokes;
}

} // namespace limn
