// The colours of terrain: evaluated by the device and by the processor.

#include <cmath>

#include <epoxy/gl.h>

#include "gpu/gpu.h"
#include "limn/base/random.h"
#include "limn/formulas/formulas.h"
#include "limn/gpu/program.h"
#include "limn/gpu/resources.h"

namespace limn::test {
namespace {

constexpr const char* text = R"(#include "limn/formulas/terrain_colour.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };
layout(std430, binding = 1) writeonly buffer Results { vec4 results[]; };
void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (2u * i + 1u >= uint(points.length()))
        return;
    vec4 a = points[2u * i];
    vec4 b = points[2u * i + 1u];
    results[2u * i] = vec4(terrain_tint(a.w), terrain_light(a.xyz, b.xyz));
    results[2u * i + 1u] = unmet_mark();
}
)";

class TerrainFormulas : public Gpu {};

TEST_F(TerrainFormulas, GiveTheSameOnBothSides)
{
    constexpr std::size_t count = 20000;
    std::vector<vec4> points;
    for (std::size_t i = 0; i < count; ++i) {
        Random random(3, i);
        const auto direction = [&] {
            const double x = random.normal(), y = random.normal(), z = random.normal();
            return vec3(glm::normalize(dvec3(x, y, z)));
        };
        const vec3 n = direction(), sun = direction();
        points.emplace_back(n, float(1.4 * random.uniform() - 0.2));
        points.emplace_back(sun, 0);
    }
    const gpu::Program program({{gpu::Stage::compute, "terrain_colour.comp", text}});
    const gpu::Buffer in(points), out(points.size() * sizeof(vec4));
    in.bind_storage(0);
    out.bind_storage(1);
    program.use();
    glDispatchCompute(unsigned(count + 63) / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const std::vector<vec4> results = out.read<vec4>(points.size());
    float worst = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const vec4 here(formulas::terrain_tint(points[2 * i].w), formulas::terrain_light(vec3(points[2 * i]), vec3(points[2 * i + 1])));
        // The largest terms: tints of 1, and a light of up to 5 times the dot product before it is cut off.
        for (int k = 0; k < 4; ++k)
            worst = std::max(worst, std::abs(here[k] - results[2 * i][k]));
        EXPECT_EQ(results[2 * i + 1], formulas::unmet_mark());
    }
    EXPECT_LT(worst, 1e-5f * 5);
}

} // namespace
} // namespace limn::test
