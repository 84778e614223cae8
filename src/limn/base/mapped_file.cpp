#include "limn/base/mapped_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* what) { throw Error::Read(fmt::format("{}: {}", path.string(), what)); }

} // namespace

MappedFile::MappedFile(const std::filesystem::path& path)
{
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0)
        throw Error::Read(fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(errno)));
    struct stat info = {};
    const bool known = ::fstat(fd, &info) == 0;
    if (known && S_ISREG(info.st_mode) && info.st_size > 0) { // an empty file cannot be mapped, and need not be
        start_ = ::mmap(nullptr, std::size_t(info.st_size), PROT_READ, MAP_SHARED, fd, 0);
        size_ = std::size_t(info.st_size);
    }
    const int failure = errno;
    ::close(fd);
    if (known && S_ISDIR(info.st_mode))
        fail(path, "is a directory, not a file");
    if (known && !S_ISREG(info.st_mode))
        fail(path, "is no regular file, so that it cannot be mapped");
    if (!known || start_ == MAP_FAILED) {
        start_ = nullptr, size_ = 0;
        throw Error::Read(fmt::format("{}: cannot be mapped: {}", path.string(), std::strerror(failure)));
    }
}

MappedFile::~MappedFile()
{
    if (start_)
        ::munmap(start_, size_);
}

} // namespace limn
