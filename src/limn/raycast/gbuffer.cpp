#include "limn/raycast/gbuffer.h"

#include <limits>

#include "limn/base/parallel.h"

namespace limn {

GBuffer trace_gbuffer(const SeenScene& scene, const Camera& camera)
{
    const FragmentTracer tracer(scene, camera);
    GBuffer buffer;
    buffer.size = camera.size;
    const std::size_t count = std::size_t(camera.size.x) * std::size_t(camera.size.y);
    buffer.positions.resize(count);
    buffer.normals.resize(count);
    buffer.depths.resize(count);
    buffer.objects.resize(count);
    buffer.triangles.resize(count);
    parallel_each(std::size_t(camera.size.y), 4, [&](std::size_t y) {
        for (int x = 0; x < camera.size.x; ++x) {
            const std::size_t i = buffer.index(x, int(y));
            const Fragment fragment = tracer.at({x + 0.5, double(y) + 0.5});
            buffer.positions[i] = fragment.position;
            buffer.normals[i] = fragment.normal;
            buffer.depths[i] = fragment.hit() ? fragment.depth : std::numeric_limits<float>::infinity();
            buffer.objects[i] = fragment.object;
            buffer.triangles[i] = fragment.triangle;
        }
    });
    return buffer;
}

} // namespace limn
