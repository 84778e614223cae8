#include "console.h"

#include <unistd.h>

#include <fmt/format.h>

double Stopwatch::lap()
{
    const Clock::time_point now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
}

double Stopwatch::total() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

Console::Console(bool quiet, std::FILE* stream, double patience) : quiet_(quiet), stream_(stream)
{
    if (quiet || ::isatty(::fileno(stream)) != 1)
        return;
    waiting_ = std::jthread([this, patience](std::stop_token stop) {
        std::unique_lock lock(lock_);
        stopped_.wait_for(lock, stop, std::chrono::duration<double>(patience), [] { return false; });
        patient_ = false;
        if (!stop.stop_requested())
            show_bar();
    });
}

Console::~Console()
{
    const std::lock_guard guard(lock_);
    clear_bar();
    doing_.clear();
}

void Console::clear_bar()
{
    if (bar_shown_)
        fmt::print(stream_, "\r\x1b[K");
    bar_shown_ = false;
}

void Console::show_bar()
{
    constexpr int cells = 30;
    if (patient_ || doing_.empty())
        return;
    const int full = int(part_ * cells);
    fmt::print(stream_, "\r\x1b[K[{:#<{}}{:.<{}}] {}", "", full, "", cells - full, doing_);
    std::fflush(stream_);
    bar_shown_ = true;
}

void Console::warn(std::string_view line)
{
    const std::lock_guard guard(lock_);
    clear_bar();
    fmt::print(stream_, "limn: warning: {}\n", line);
}

void Console::progress(std::string_view what, double part)
{
    const std::lock_guard guard(lock_);
    doing_ = what;
    part_ = part;
    show_bar();
}

void Console::finish(std::string_view line)
{
    const std::lock_guard guard(lock_);
    clear_bar();
    doing_.clear();
    if (!quiet_)
        fmt::print(stream_, "limn: {}\n", line);
}

std::string with_thousands(std::size_t n)
{
    std::string digits = std::to_string(n);
    for (std::size_t at = digits.size(); at > 3; at -= 3)
        digits.insert(at - 3, ",");
    return digits;
}

std::string counted(std::size_t n, std::string_view noun) { return fmt::format("{} {}{}", with_thousands(n), noun, n == 1 ? "" : "s"); }

std::string seconds_text(double seconds) { return fmt::format("{:.2f} s", seconds); }
