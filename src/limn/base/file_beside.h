#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace limn {

/// A file that is written piece by piece, or by a library that wants a name, and that takes its place when it is whole. Where the file system
/// can, it has no name in its folder until then, so that a process that is stopped or killed meanwhile leaves nothing.
class FileBeside {
public:
    /// @param target  a regular file that is replaced, or a new one; a link is followed, so that the file it names is replaced
    /// @throws Error::Write where nothing can be written there.
    explicit FileBeside(const std::filesystem::path& target);
    ~FileBeside();
    FileBeside(const FileBeside&) = delete;
    FileBeside& operator=(const FileBeside&) = delete;

    /// Where to write meanwhile: an empty file.
    const std::filesystem::path& path() const { return path_; }
    /// Appends to it. @throws Error::Write
    void append(std::string_view bytes);
    /// Puts the file in its place, with the permissions of the one that it replaces. @throws Error::Write; an older file is then still there.
    void commit();

private:
    void open_named();
    void link();

    std::string name_; ///< in messages
    std::filesystem::path target_, path_;
    int fd_ = -1;
    bool named_ = false; ///< `path_` stands in the folder and must not stay there
};

/// True for what must be written in place: devices and pipes such as /dev/full or /dev/stdout.
bool is_special_file(const std::filesystem::path& path);

/// Writes all bytes to a descriptor. @throws Error::Write naming `name` and the cause.
void write_all(int descriptor, std::string_view bytes, const std::string& name);

} // namespace limn
