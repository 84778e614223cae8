#include "console.h"

#include <cstdio>
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

Console::Console(bool quiet) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1) {}

Console::~Console() { clear_bar(); }

void Console::clear_bar()
{
    if (bar_shown_)
        fmt::print(stderr, "\r\x1b[K");
    bar_shown_ = false;
}

void Console::warn(std::string_view line)
{
    clear_bar();
    fmt::print(stderr, "limn: warning: {}\n", line);
}

void Console::progress(std::string_view what, double part)
{
    constexpr int cells = 30;
    if (quiet_ || !terminal_ || since_start_.total() < 1)
        return;
    const int full = int(part * cells);
    fmt::print(stderr, "\r\x1b[K[{:#<{}}{:.<{}}] {}", "", full, "", cells - full, what);
    std::fflush(stderr);
    bar_shown_ = true;
}

void Console::finish(std::string_view line)
{
    clear_bar();
    if (!quiet_)
        fmt::print(stderr, "limn: {}\n", line);
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
