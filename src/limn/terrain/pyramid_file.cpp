#include "limn/terrain/pyramid_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {

PyramidFile::PyramidFile(const std::filesystem::path& path, std::size_t beginning) : name_(path.string()), beside_(path), size_(beginning)
{
    fd_ = ::open(beside_.path().c_str(), O_RDWR | O_CLOEXEC);
    if (fd_ < 0)
        throw Error::Write(fmt::format("{}: cannot be written: {}", name_, std::strerror(errno)));
}

PyramidFile::~PyramidFile() { ::close(fd_); }

void PyramidFile::write_at(std::uint64_t offset, std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t written = ::pwrite(fd_, bytes.data(), bytes.size(), off_t(offset));
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            throw Error::Write(fmt::format("{}: cannot be written: {}", name_, std::strerror(errno)));
        offset += std::uint64_t(written);
        bytes.remove_prefix(std::size_t(written));
    }
}

std::uint64_t PyramidFile::append(std::string_view bytes)
{
    const std::uint64_t at = size_;
    write_at(at, bytes);
    size_ += bytes.size();
    return at;
}

std::string PyramidFile::read(std::uint64_t offset, std::size_t size) const
{
    std::string bytes(size, '\0');
    for (std::size_t done = 0; done < size;) {
        const ssize_t got = ::pread(fd_, bytes.data() + done, size - done, off_t(offset + done));
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            throw Error::Read(
                fmt::format("{}: what was written cannot be read again: {}", name_, got < 0 ? std::strerror(errno) : "it is gone"));
        done += std::size_t(got);
    }
    return bytes;
}

void PyramidFile::finish(std::string_view beginning)
{
    write_at(0, beginning);
    beside_.commit();
}

} // namespace limn
