#pragma once

#include <chrono>
#include <string>
#include <string_view>

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
    explicit Console(bool quiet);
    ~Console();
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    /// "limn: warning: …"; said even when quiet.
    void warn(std::string_view line);
    /// A bar for long work, only on a terminal and only from the second second on. `part` in [0,1].
    void progress(std::string_view what, double part);
    /// The last line of a run.
    void finish(std::string_view line);

private:
    void clear_bar();
    bool quiet_, terminal_, bar_shown_ = false;
    Stopwatch since_start_;
};

/// "1,234,567".
std::string with_thousands(std::size_t n);
/// "1 stroke", "1,234 strokes".
std::string counted(std::size_t n, std::string_view noun);
/// "0.31 s".
std::string seconds_text(double seconds);
