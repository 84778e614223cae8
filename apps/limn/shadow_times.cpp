#include "shadow_times.h"

#include <ctime>

#include "bench_table.h"
#include "limn/base/parallel.h"
#include "limn/base/random.h"
#include "limn/shadow/shadow_error.h"

using namespace limn;

namespace {

constexpr int runs = 5;

double processor_seconds()
{
    timespec time = {};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

template <class F> double nanoseconds(std::size_t count, F&& f)
{
    std::vector<double> times;
    for (int run = 0; run < runs; ++run) {
        const double start = processor_seconds();
        f();
        times.push_back(1e9 * (processor_seconds() - start) / double(count));
    }
    return median(times);
}

} // namespace

std::vector<ShadowQuery> shuffled_queries(const CasterRays& rays)
{
    std::vector<ShadowQuery> all;
    const auto collect = [&](std::span<const ShadowQuery> queries, std::span<Verdict> verdicts) {
        all.insert(all.end(), queries.begin(), queries.end());
        std::fill(verdicts.begin(), verdicts.end(), Verdict::lit);
    };
    with_threads(1, [&] { object_shadow_error(rays, collect); });
    Random random(1);
    for (std::size_t i = all.size(); i-- > 1;)
        std::swap(all[i], all[random.below(std::uint32_t(i + 1))]);
    return all;
}

LookUpTimes time_look_ups(const CasterRays& rays, const ShadowMaps& seed, const ShadowMaps& bricks, const std::vector<ShadowQuery>& queries)
{
    std::vector<Verdict> verdicts(queries.size());
    const LookUp<StoredSegments> in_seed(seed.layout(), *seed.segments());
    const LookUp<StoredBricks> in_bricks(bricks.layout(), *bricks.bricks());
    const auto one_by_one = [&](const auto& source) {
        for (std::size_t i = 0; i < queries.size(); ++i)
            verdicts[i] = source.at(queries[i]);
    };
    LookUpTimes times;
    times.rays = nanoseconds(queries.size(), [&] { one_by_one(rays); });
    times.seed = nanoseconds(queries.size(), [&] { in_seed.at(queries, verdicts); });
    times.bricks = nanoseconds(queries.size(), [&] { in_bricks.at(queries, verdicts); });
    times.bricks_alone = nanoseconds(queries.size(), [&] { one_by_one(in_bricks); });
    return times;
}
