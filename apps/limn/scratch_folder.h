#pragma once

#include <filesystem>

#include <fmt/format.h>
#include <unistd.h>

/// A folder of its own that goes with all it holds.
class ScratchFolder {
public:
    ScratchFolder() : path_(std::filesystem::temp_directory_path() / fmt::format("limn-bench-{}", getpid())) { std::filesystem::create_directory(path_); }
    ~ScratchFolder() { std::filesystem::remove_all(path_); }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    std::filesystem::path operator/(const char* name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};
