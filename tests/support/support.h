#pragma once

#include <filesystem>
#include <string>

namespace limn::test {

/// A fresh folder that is removed with its content at the end of the test.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// What a program did.
struct ProgramResult {
    int exit_code = -1;  ///< 128 + signal when it was killed
    std::string output;  ///< standard output
    std::string errors;  ///< standard error
};

/// Runs a shell command and waits for it.
ProgramResult run_shell(const std::string& command);
/// Runs the built `limn` with arguments as a shell would split them.
ProgramResult run_limn(const std::string& command_program, const std::string& arguments);

std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);

} // namespace limn::test
