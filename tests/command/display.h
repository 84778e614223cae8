#pragma once

#include <csignal>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

namespace limn::test {

/// A display of its own for windows (Xvfb), or none where that is not installed.
class Display {
public:
    Display()
    {
        int ends[2];
        if (pipe(ends) != 0)
            return;
        process_ = fork();
        if (process_ == 0) {
            dup2(ends[1], 3);
            execlp("Xvfb", "Xvfb", "-displayfd", "3", "-screen", "0", "1024x768x24", "-nolisten", "tcp", static_cast<char*>(nullptr));
            _exit(127);
        }
        close(ends[1]);
        for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';)
            number_ += c;
        close(ends[0]);
    }
    ~Display()
    {
        if (process_ > 0) {
            kill(process_, SIGTERM);
            waitpid(process_, nullptr, 0);
        }
    }
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;
    bool is_there() const { return !number_.empty(); }
    std::string name() const { return ":" + number_; }

private:
    pid_t process_ = -1;
    std::string number_;
};

} // namespace limn::test
