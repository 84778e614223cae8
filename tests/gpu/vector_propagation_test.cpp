#include "limn/gpu/vector_propagation.h"

#include "gpu/gpu.h"
#include "limn/base/distance_transform.h"
#include "limn/base/random.h"
#include "subdivision/marks.h"

namespace limn::test {
namespace {

class GpuVectorPropagation : public Gpu {};

// Checklist 28.
TEST_F(GpuVectorPropagation, IsTheProcessors)
{
    const gpu::VectorPropagator device;
    for (const ivec2& size : {ivec2(1, 1), ivec2(33, 17), ivec2(200, 130), ivec2(5, 300)})
        for (const double share : {0.0005, 0.01, 0.3})
            for (const int neighbours : {8, 4})
                for (const int passes : {0, 5, 16, 65536}) {
                    const std::vector<std::uint8_t> marks = random_marks(size, share, 11);
                    const PropagationOptions options = {.neighbours = neighbours, .most_passes = passes};
                    const VectorField expected = propagate_vectors(marks, size, options), found = device.run(marks, size, options);
                    EXPECT_EQ(found.vectors, expected.vectors) << size.x << " x " << size.y << ", " << share << ", " << neighbours << ", " << passes;
                    EXPECT_EQ(found.passes, expected.passes);
                }
}

TEST_F(GpuVectorPropagation, AmongEightNeighboursIsTheExactTransform)
{
    const ivec2 size(300, 220);
    const std::vector<std::uint8_t> marks = random_marks(size, 0.001, 4);
    const VectorField found = gpu::VectorPropagator().run(marks, size);
    const DistanceTransform exact = distance_transform(marks, size);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const ivec2 v = found.vector(x, y);
            ASSERT_EQ(std::int64_t(v.x) * v.x + std::int64_t(v.y) * v.y, exact.squared_distance(x, y)) << x << "," << y;
        }
}

TEST_F(GpuVectorPropagation, DilatesAsTheProcessor)
{
    Image picture({90, 70}, 4);
    Random random(2);
    for (float& sample : picture.samples)
        sample = float(random.uniform());
    const gpu::VectorPropagator device;
    for (const int passes : {0, 2, 65536}) {
        const PropagationOptions options = {.most_passes = passes};
        EXPECT_EQ(device.dilated(picture, options).samples, dilated(picture, options).samples) << passes;
    }
}

} // namespace
} // namespace limn::test
