#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "limn/base/file_beside.h"

namespace limn {

/// A pyramid's file while it is made: tiles are appended and read again, its beginning is written last. It takes its place when it is whole.
class PyramidFile {
public:
    /// @param beginning  bytes to leave free for header and directory
    /// @throws Error::Write
    PyramidFile(const std::filesystem::path& path, std::size_t beginning);
    ~PyramidFile();
    PyramidFile(const PyramidFile&) = delete;
    PyramidFile& operator=(const PyramidFile&) = delete;

    std::uint64_t size() const { return size_; }
    /// @return where they are. @throws Error::Write
    std::uint64_t append(std::string_view bytes);
    /// From any thread. @throws Error::Read
    std::string read(std::uint64_t offset, std::size_t size) const;
    /// Writes the beginning and puts the file in its place. @throws Error::Write
    void finish(std::string_view beginning);

private:
    void write_at(std::uint64_t offset, std::string_view bytes);

    std::string name_;
    FileBeside beside_;
    int fd_ = -1;
    std::uint64_t size_;
};

} // namespace limn
