#pragma once

#include <chrono>
#include <vector>

/// Milliseconds of each of so many calls of f(), after one that is not counted.
template <class F> std::vector<double> repeated(int runs, F&& f)
{
    std::vector<double> times;
    for (int run = 0; run <= runs; ++run) {
        const auto start = std::chrono::steady_clock::now();
        f();
        const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
        if (run > 0)
            times.push_back(time.count());
    }
    return times;
}
