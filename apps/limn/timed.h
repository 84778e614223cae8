#pragma once

#include <vector>

#include "bench_table.h"
#include "console.h"

/// Milliseconds that f() takes.
template <class F> double ms_of(F&& f)
{
    Stopwatch watch;
    f();
    return 1e3 * watch.lap();
}

/// The median of them over so many runs, after one that does not count.
template <class F> double median_ms(int runs, F&& f)
{
    f();
    std::vector<double> times;
    for (int run = 0; run < runs; ++run)
        times.push_back(ms_of(f));
    return median(times);
}
