#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

/// Seconds since it was made, or since the last lap.
class Stopwatch {
public:
    /// Seconds since the last lap, which ends here.
    double lap();
    double total() const;

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now(), last_ = start_;
};

/// What a run tells a person, on standard error: warnings, progress and one last line.
class Console {
public:
    /// @param stream  where it is told; a bar is shown only where this is a terminal
    /// @param patience  seconds without a bar: short work needs none
    explicit Console(bool quiet, std::FILE* stream = stderr, double patience = 1);
    ~Console();
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    /// "limn: warning: …"; said even when quiet.
    void warn(std::string_view line);
    /// What the run does from now on. A bar shows it, once patience is over, even in the middle of long work. `part` in [0,1].
    void progress(std::string_view what, double part);
    /// The last line of a run.
    void finish(std::string_view line);

private:
    // Both need the lock.
    void clear_bar();
    void show_bar();

    const bool quiet_;
    std::FILE* const stream_;
    std::mutex lock_;
    std::condition_variable_any stopped_;
    std::string doing_; ///< "" before the first progress, and after the last line
    double part_ = 0;
    bool patient_ = true, bar_shown_ = false;
    std::jthread waiting_; ///< shows the first bar; only on a terminal. Last, so that it ends before what it reads goes
};

/// "1,234,567".
std::string with_thousands(std::size_t n);
/// "1 stroke", "1,234 strokes".
std::string counted(std::size_t n, std::string_view noun);
/// "0.31 s".
std::string seconds_text(double seconds);
