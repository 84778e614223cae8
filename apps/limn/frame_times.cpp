#include "frame_times.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench_table.h"
#include "console.h"

using namespace limn;

namespace {

void add_frame(FrameTimes& times, const FrameMethod& method, const Camera& camera)
{
    Stopwatch watch;
    const StageTimes stages = method.frame(camera);
    times.frames.push_back(1e3 * watch.lap());
    times.stages.resize(stages.size());
    for (std::size_t k = 0; k < stages.size(); ++k)
        times.stages[k].push_back(stages[k]);
}

constexpr int steps_of_full_turn = 3600;
constexpr int seconds_of_turn = 10, repetitions = 10;

/// One turn about one axis.
void turn_by_clock(FrameTimes& times, const FrameMethod& method, const std::vector<Camera>& cameras, int axis)
{
    const Stopwatch watch;
    std::vector<double> counted(seconds_of_turn, 0);
    for (double now = 0; now < seconds_of_turn; now = watch.total()) {
        const int step = std::min(int(now / seconds_of_turn * steps_of_full_turn), steps_of_full_turn - 1);
        add_frame(times, method, cameras[std::size_t(axis * steps_of_full_turn + step)]);
        counted[std::size_t(now)] += 1;
    }
    times.per_second.insert(times.per_second.end(), counted.begin(), counted.end());
}

} // namespace

double FrameTimes::mean_fps() const { return 1e3 * double(frames.size()) / std::accumulate(frames.begin(), frames.end(), 0.0); }
double FrameTimes::median() const { return ::median(frames); }

double FrameTimes::p95() const
{
    std::vector<double> sorted = frames;
    std::sort(sorted.begin(), sorted.end());
    return sorted[std::size_t(std::ceil(0.95 * double(sorted.size()))) - 1];
}

std::vector<double> FrameTimes::stage_medians() const
{
    std::vector<double> medians;
    for (const std::vector<double>& stage : stages)
        medians.push_back(::median(stage));
    return medians;
}

FrameTimes time_frames(const FrameMethod& method, const std::vector<Camera>& cameras)
{
    method.frame(cameras.front());
    FrameTimes times;
    for (const Camera& camera : cameras)
        add_frame(times, method, camera);
    return times;
}

FrameTimes time_full_turns(const FrameMethod& method, const Bounds& bounds, int pixels)
{
    const std::vector<Camera> cameras = turning_cameras(bounds, pixels, steps_of_full_turn);
    method.frame(cameras.front());
    FrameTimes times;
    for (int repetition = 0; repetition < repetitions; ++repetition)
        for (int axis = 0; axis < 3; ++axis)
            turn_by_clock(times, method, cameras, axis);
    return times;
}
