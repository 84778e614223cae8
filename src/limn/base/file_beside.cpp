#include "limn/base/file_beside.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

[[noreturn]] void fail_to_write(const std::string& name)
{
    throw Error::Write(fmt::format("{}: cannot be written: {}", name, std::strerror(errno)));
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
bool link_beside(const std::filesystem::path& open_file, const std::filesystem::path& target, std::filesystem::path& beside)
{
    for (int attempt = 0; attempt < 100; ++attempt) {
        beside = fmt::format("{}.{}-{}", target.string(), ::getpid(), attempt);
        if (::linkat(AT_FDCWD, open_file.c_str(), AT_FDCWD, beside.c_str(), AT_SYMLINK_FOLLOW) == 0)
            return true;
        if (errno != EEXIST)
            return false;
    }
    return false;
}

std::filesystem::path followed(const std::filesystem::path& path)
{
    std::error_code ignored;
    return std::filesystem::is_symlink(path, ignored) ? std::filesystem::weakly_canonical(path) : path;
}

} // namespace

FileBeside::FileBeside(const std::filesystem::path& target) : name_(target.string()), target_(followed(target))
{
    const std::filesystem::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
    fd_ = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    path_ = fmt::format("/proc/self/fd/{}", fd_);
    if (fd_ < 0)
        open_named();
}

FileBeside::~FileBeside()
{
    if (fd_ >= 0)
        ::close(fd_);
    if (named_)
        ::unlink(path_.c_str());
}

void FileBeside::open_named()
{
    std::string beside = target_.string() + ".XXXXXX";
    fd_ = ::mkostemp(beside.data(), O_CLOEXEC);
    if (fd_ < 0)
        fail_to_write(name_);
    path_ = beside;
    named_ = true;
}

void FileBeside::append(std::string_view bytes) { write_all(fd_, bytes, name_); }

/// Gives the file a name, or where that cannot be done here its content a file with a name.
void FileBeside::link()
{
    std::filesystem::path beside;
    if (link_beside(path_, target_, beside)) {
        path_ = beside;
        named_ = true;
        return;
    }
    const int unnamed = std::exchange(fd_, -1);
    try {
        open_named();
        std::vector<char> bytes(1 << 20);
        ::lseek(unnamed, 0, SEEK_SET);
        ssize_t got = 0;
        while ((got = ::read(unnamed, bytes.data(), bytes.size())) > 0)
            append({bytes.data(), std::size_t(got)});
        if (got < 0)
            fail_to_write(name_);
    } catch (...) {
        ::close(unnamed);
        throw;
    }
    ::close(unnamed);
}

void FileBeside::commit()
{
    if (!named_)
        link();
    ::fchmod(fd_, permissions_for(target_));
    if (::close(std::exchange(fd_, -1)) != 0 || ::rename(path_.c_str(), target_.c_str()) != 0)
        fail_to_write(name_);
    named_ = false;
}

bool is_special_file(const std::filesystem::path& path)
{
    struct stat info = {};
    return ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode);
}

void write_all(int descriptor, std::string_view bytes, const std::string& name)
{
    while (!bytes.empty()) {
        const ssize_t put = ::write(descriptor, bytes.data(), bytes.size());
        if (put < 0 && errno == EINTR)
            continue;
        if (put < 0)
            fail_to_write(name);
        bytes.remove_prefix(std::size_t(put));
    }
}

} // namespace limn
