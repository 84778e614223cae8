#include "limn/base/file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file_beside.h"

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
    if (is_special_file(path)) {
        const Descriptor fd(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
        if (fd.get() < 0)
            throw Error::Write(fmt::format("{}: cannot be written: {}", name, std::strerror(errno)));
        return write_all(fd.get(), bytes, name);
    }
    FileBeside file(path);
    file.append(bytes);
    file.commit();
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
