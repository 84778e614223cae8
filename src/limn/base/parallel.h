#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace limn {

/// Runs `f()` with at most `threads` threads (0: all of the machine) for every parallel loop inside it.
template <class F> auto with_threads(int threads, F&& f)
{
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    return arena.execute(std::forward<F>(f));
}

/// Calls `f(begin, end)` for the blocks [k*grain, (k+1)*grain) of [0, n), in parallel and in no order. The blocks do not
/// depend on the number of threads, so a result that is a function of its block is the same for any number of them.
template <class F> void parallel_blocks(std::size_t n, std::size_t grain, F&& f)
{
    const std::size_t blocks = (n + grain - 1) / grain;
    if (blocks <= 1) {
        if (n > 0)
            f(std::size_t(0), n);
        return;
    }
    tbb::parallel_for(std::size_t(0), blocks,
                      [&](std::size_t b) { f(b * grain, std::min(n, (b + 1) * grain)); });
}

/// Calls `f(i)` for every i in [0, n), in parallel.
template <class F> void parallel_each(std::size_t n, std::size_t grain, F&& f)
{
    parallel_blocks(n, grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            f(i);
    });
}

/// Calls `f(begin, end, out)` for the blocks of [0, n) in parallel, where each call appends to its own `out`, and joins
/// the outputs in the order of the blocks: the result does not depend on the number of threads.
template <class T, class F> std::vector<T> parallel_collect(std::size_t n, std::size_t grain, F&& f)
{
    const std::size_t blocks = (n + grain - 1) / grain;
    std::vector<std::vector<T>> parts(blocks);
    parallel_blocks(n, grain, [&](std::size_t begin, std::size_t end) { f(begin, end, parts[begin / grain]); });
    std::vector<std::size_t> offset(blocks + 1, 0);
    for (std::size_t b = 0; b < blocks; ++b)
        offset[b + 1] = offset[b] + parts[b].size();
    std::vector<T> all(offset[blocks]);
    parallel_each(blocks, 1, [&](std::size_t b) { std::copy(parts[b].begin(), parts[b].end(), all.begin() + std::ptrdiff_t(offset[b])); });
    return all;
}

} // namespace limn
