#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace limn {

/// A file whose bytes are read as they stand, when they are touched, and shared with every other process that maps it. Replacing the file (as
/// write_file does) leaves the mapped bytes as they were; one that is cut short in place must not be read any more.
class MappedFile {
public:
    /// @throws Error::Read when it is missing, a directory, no regular file or unreadable (the message names it and says which)
    explicit MappedFile(const std::filesystem::path& path);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    /// Begins at the start of a page.
    std::string_view bytes() const { return {static_cast<const char*>(start_), size_}; }

private:
    void* start_ = nullptr;
    std::size_t size_ = 0;
};

} // namespace limn
