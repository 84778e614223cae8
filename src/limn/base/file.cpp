#include "limn/base/file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

/// Closes a file descriptor when it leaves scope.
class Descriptor {
public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor()
    {
        if (fd_ > STDERR_FILENO)
            ::close(fd_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return fd_; }
    int release() { return std::exchange(fd_, -1); }

private:
    int fd_;
};

std::string read_all(int fd, std::size_t size_hint, const std::string& name)
{
    std::string bytes;
    bytes.resize(size_hint + 1); // one more, so that the end of a regular file is seen without growing
    std::size_t filled = 0;
    for (;;) {
        if (filled == bytes.size())
            bytes.resize(bytes.size() * 2);
        const ssize_t got = ::read(fd, bytes.data() + filled, bytes.size() - filled);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            throw Error::Read(fmt::format("{}: cannot be read: {}", name, std::strerror(errno)));
        if (got == 0)
            break;
        filled += std::size_t(got);
    }
    bytes.resize(filled);
    return bytes;
}

[[noreturn]] void fail_to_write(const std::string& name)
{
    throw Error::Write(fmt::format("{}: cannot be written: {}", name, std::strerror(errno)));
}

void write_all(int fd, std::string_view bytes, const std::string& name)
{
    while (!bytes.empty()) {
        const ssize_t put = ::write(fd, bytes.data(), bytes.size());
        if (put < 0 && errno == EINTR)
            continue;
        if (put < 0)
            fail_to_write(name);
        bytes.remove_prefix(std::size_t(put));
    }
}

/// True for what must be written in place: devices and pipes such as /dev/full or /dev/stdout.
bool is_special(const std::filesystem::path& path)
{
    struct stat info = {};
    return ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode);
}

/// The permissions of the file that is replaced, or those of a new file under the process's umask.
mode_t permissions_for(const std::filesystem::path& path)
{
    struct stat info = {};
    if (::stat(path.c_str(), &info) == 0)
        return info.st_mode & 07777;
    const mode_t mask = ::umask(0);
    ::umask(mask);
    return 0666 & ~mask;
}

/// Gives a file without a name one beside `target`. False when that cannot be done here.
bool link_beside(int fd, const std::filesystem::path& target, std::string& beside)
{
    const std::string open_file = fmt::format("/proc/self/fd/{}", fd);
    for (int attempt = 0; attempt < 100; ++attempt) {
        beside = fmt::format("{}.{}-{}", target.string(), ::getpid(), attempt);
        if (::linkat(AT_FDCWD, open_file.c_str(), AT_FDCWD, beside.c_str(), AT_SYMLINK_FOLLOW) == 0)
            return true;
        if (errno != EEXIST)
            return false;
    }
    return false;
}

/// Writes into a file that has no name until it is whole: a process that is stopped or killed meanwhile leaves nothing.
/// False, with nothing done, where the file system has no such files.
bool replace_by_unnamed_file(const std::filesystem::path& target, std::string_view bytes, const std::string& name)
{
    const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
    const Descriptor fd(::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600));
    if (fd.get() < 0)
        return false;
    write_all(fd.get(), bytes, name);
    ::fchmod(fd.get(), permissions_for(target));
    std::string beside;
    if (!link_beside(fd.get(), target, beside))
        return false;
    if (::rename(beside.c_str(), target.c_str()) == 0)
        return true;
    const int cause = errno;
    ::unlink(beside.c_str());
    errno = cause;
    fail_to_write(name);
}

void replace_by_file_beside(const std::filesystem::path& target, std::string_view bytes, const std::string& name)
{
    std::string beside = target.string() + ".XXXXXX";
    Descriptor fd(::mkostemp(beside.data(), O_CLOEXEC));
    if (fd.get() < 0)
        fail_to_write(name);
    try {
        write_all(fd.get(), bytes, name);
        ::fchmod(fd.get(), permissions_for(target));
        if (::close(fd.release()) != 0 || ::rename(beside.c_str(), target.c_str()) != 0)
            fail_to_write(name);
    } catch (...) {
        ::unlink(beside.c_str());
        throw;
    }
}

} // namespace

std::string read_file(const std::filesystem::path& path)
{
    if (path == "-")
        return read_all(STDIN_FILENO, 1 << 16, "standard input");
    const std::string name = path.string();
    const Descriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (fd.get() < 0)
        throw Error::Read(fmt::format("{}: cannot be opened: {}", name, std::strerror(errno)));
    struct stat info = {};
    if (::fstat(fd.get(), &info) == 0 && S_ISDIR(info.st_mode))
        throw Error::Read(fmt::format("{}: is a directory, not a file", name));
    return read_all(fd.get(), info.st_size > 0 ? std::size_t(info.st_size) : 1 << 16, name);
}

void write_file(const std::filesystem::path& path, std::string_view bytes)
{
    if (path == "-")
        return write_all(STDOUT_FILENO, bytes, "standard output");
    const std::string name = path.string();
    if (is_special(path)) {
        const Descriptor fd(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
        if (fd.get() < 0)
            fail_to_write(name);
        return write_all(fd.get(), bytes, name);
    }
    // A link is followed, so that the file it names is replaced and not the link itself.
    std::error_code ignored;
    const std::filesystem::path target = std::filesystem::is_symlink(path, ignored) ? std::filesystem::weakly_canonical(path) : path;
    if (!replace_by_unnamed_file(target, bytes, name))
        replace_by_file_beside(target, bytes, name);
}

std::string file_ending(const std::filesystem::path& path)
{
    std::string ending = path.extension().string();
    if (!ending.empty())
        ending.erase(0, 1);
    for (char& c : ending)
        c = char(std::tolower(static_cast<unsigned char>(c)));
    return ending;
}

} // namespace limn
