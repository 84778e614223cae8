#include "console.h"

#include <chrono>
#include <csignal>
#include <memory>
#include <thread>

#include <fcntl.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "command/command.h"
#include "models.h"

namespace limn::test {
namespace {

using namespace std::chrono_literals;

/// A terminal, or a pipe, to tell things to; what was told is read at its other end.
class Listener {
public:
    explicit Listener(bool terminal)
    {
        int ends[2];
        if ((terminal ? ::openpty(&ends[0], &ends[1], nullptr, nullptr, nullptr) : ::pipe(ends)) != 0)
            throw std::runtime_error("no terminal and no pipe can be had");
        ear_ = ends[0];
        stream_ = ::fdopen(ends[1], "w");
        ::fcntl(ear_, F_SETFL, O_NONBLOCK);
    }
    ~Listener()
    {
        std::fclose(stream_);
        ::close(ear_);
    }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    std::FILE* stream() const { return stream_; }
    /// What was told since the last call.
    std::string heard() const
    {
        std::fflush(stream_);
        std::string text;
        char buffer[4096];
        for (ssize_t n; (n = ::read(ear_, buffer, sizeof buffer)) > 0;)
            text.append(buffer, std::size_t(n));
        return text;
    }
    /// Waits for a part of what is told, at most five seconds; returns all that was told.
    std::string wait_for(const std::string& part) const
    {
        std::string text = heard();
        for (const auto end = std::chrono::steady_clock::now() + 5s; text.find(part) == std::string::npos && std::chrono::steady_clock::now() < end;) {
            std::this_thread::sleep_for(2ms);
            text += heard();
        }
        return text;
    }

private:
    int ear_ = -1;
    std::FILE* stream_ = nullptr;
};

TEST(Console, ShowsABarInTheMiddleOfLongWorkOnATerminal)
{
    const Listener terminal(true);
    Console console(false, terminal.stream(), 0.3);
    console.progress("reading", 0.5);
    EXPECT_EQ(terminal.heard(), "");                                      // not yet
    EXPECT_NE(terminal.wait_for("reading").find("[###############...............] reading"), std::string::npos); // without another call
    console.progress("drawing", 1);
    EXPECT_NE(terminal.heard().find("[##############################] drawing"), std::string::npos);
    console.finish("done");
    EXPECT_EQ(terminal.heard(), "\r\x1b[Klimn: done\r\n"); // the bar is gone
}

TEST(Console, ShowsNoBarWhereWorkIsShort)
{
    const Listener terminal(true);
    {
        Console console(false, terminal.stream(), 60);
        console.progress("reading", 0.5);
        console.finish("done");
    }
    EXPECT_EQ(terminal.heard(), "limn: done\r\n");
}

TEST(Console, ShowsNoBarInAPipeAndNoneWhenQuiet)
{
    for (const bool terminal : {false, true}) {
        const Listener listener(terminal);
        Console console(terminal, listener.stream(), 0); // the terminal's is quiet
        console.progress("reading", 0.5);
        std::this_thread::sleep_for(20ms);
        console.progress("drawing", 0.6);
        EXPECT_EQ(listener.heard(), "") << terminal;
    }
}

TEST(Console, AWarningTakesTheBarAway)
{
    const Listener terminal(true);
    Console console(false, terminal.stream(), 0);
    console.progress("reading", 0);
    terminal.wait_for("reading");
    console.warn("odd");
    EXPECT_EQ(terminal.heard(), "\r\x1b[Klimn: warning: odd\r\n");
}

class Stages : public WithTorus {
};

TEST_F(Stages, OfPreparingAModelAreTold)
{
    const Listener terminal(true);
    Console console(false, terminal.stream(), 0);
    console.progress("starting", 0);
    terminal.wait_for("starting"); // from here on every stage is shown at once
    ModelOptions options;
    options.objects.emplace_back().file = torus();
    prepare_models(options, console);
    const std::string told = terminal.heard();
    for (const char* stage : {"reading torus.obj", "estimating the surface of torus.obj", "joining faces"})
        EXPECT_NE(told.find(stage), std::string::npos) << stage;
}

/// Runs the command with its standard error on a terminal or a pipe until a bar is seen or the time is over.
bool shows_a_bar(const std::string& model, const std::string& output, bool terminal, std::chrono::milliseconds time)
{
    const Listener listener(terminal);
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(::fileno(listener.stream()), STDERR_FILENO);
        ::execl(LIMN_COMMAND, LIMN_COMMAND, "draw", model.c_str(), "--turntable", "100000", "--size", "64x64", "-o", output.c_str(), nullptr);
        ::_exit(127);
    }
    bool seen = false;
    for (const auto end = std::chrono::steady_clock::now() + time; !seen && std::chrono::steady_clock::now() < end;) {
        std::this_thread::sleep_for(10ms);
        seen = listener.heard().find("] drawing view ") != std::string::npos;
    }
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    return seen;
}

TEST_F(Stages, OfALongRunAreShownOnATerminal) { EXPECT_TRUE(shows_a_bar(torus(), path("turn.png"), true, 60s)); } // a busy machine takes its time

TEST_F(Stages, OfALongRunAreNotShownInAPipe) { EXPECT_FALSE(shows_a_bar(torus(), path("turn.png"), false, 1500ms)); }

} // namespace
} // namespace limn::test
