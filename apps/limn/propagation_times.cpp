#include "propagation_times.h"


#include "bench_table.h"
#include "console.h"
#include "limn/base/distance_transform.h"
#include "limn/gpu/vector_propagation.h"

using namespace limn;

namespace {

template <class F> double median_of_runs(int runs, F&& f)
{
    std::vector<double> times;
    for (int run = 0; run < runs; ++run) {
        Stopwatch watch;
        f();
        times.push_back(1e3 * watch.lap());
    }
    return median(times);
}

} // namespace

PropagationTimes time_propagation(int size, int passes, int runs, bool on_device)
{
    std::vector<std::uint8_t> marked(std::size_t(size) * std::size_t(size), 0);
    marked[0] = 1;
    const ivec2 square(size, size);
    PropagationOptions options;
    options.most_passes = passes;
    PropagationTimes times{size, passes, 0, 0, 0};
    times.processor = median_of_runs(runs, [&] { propagate_vectors(marked, square, options); });
    times.reference = median_of_runs(runs, [&] { distance_transform(marked, square); });
    if (on_device) {
        const gpu::VectorPropagator propagator;
        times.device = median_of_runs(runs, [&] { propagator.run(marked, square, options); });
    }
    return times;
}
