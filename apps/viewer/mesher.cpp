#include "mesher.h"

#include <chrono>
#include <exception>

using namespace limn;

Mesher::Mesher(std::unique_ptr<MovingTerrain> terrain, const MeshRequest& first, std::function<void()> wake)
    : terrain_(std::move(terrain)), wake_(std::move(wake)), wanted_(first), last_(first),
      thread_([this](const std::stop_token& stop) { work(stop); })
{
}

void Mesher::ask(const MeshRequest& request)
{
    {
        const std::lock_guard guard(lock_);
        wanted_ = request;
    }
    changed_.notify_one();
}

std::optional<MeshAnswer> Mesher::take()
{
    std::optional<MeshAnswer> answer;
    {
        const std::lock_guard guard(lock_);
        if (fault_)
            std::rethrow_exception(std::exchange(fault_, nullptr));
        answer = std::exchange(answer_, std::nullopt);
    }
    changed_.notify_one();
    return answer;
}

void Mesher::work(const std::stop_token& stop)
{
    try {
        while (!stop.stop_requested()) {
            MeshRequest request = last_;
            {
                std::unique_lock lock(lock_);
                // What came since an answer that nobody took yet has time.
                if (!changed_.wait(lock, stop, [&] { return wanted_ || (!settled_ && !answer_); }))
                    return;
                if (wanted_)
                    request = *std::exchange(wanted_, std::nullopt);
            }
            make(request);
            if (!settled_)
                terrain_->wait();
        }
    } catch (...) {
        const std::lock_guard guard(lock_);
        fault_ = std::current_exception();
    }
    wake_();
}

void Mesher::make(const MeshRequest& request)
{
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    if (request.exaggerate != last_.exaggerate)
        terrain_->exaggerate(request.exaggerate);
    if (request.tries != last_.tries)
        terrain_->retry();
    last_ = request;
    MeshAnswer answer = {request, terrain_->step(request.camera, request.tolerance), 0};
    answer.milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    settled_ = answer.step.is_settled();
    {
        const std::lock_guard guard(lock_);
        if (answer_) // nobody took it
            answer.step = after_skipped(std::move(answer.step), std::move(answer_->step));
        answer_ = std::move(answer);
    }
    wake_();
}
