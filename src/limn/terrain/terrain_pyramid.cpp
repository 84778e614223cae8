#include "limn/terrain/terrain_pyramid.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

/// An open file that is closed where what follows its opening throws.
struct OpenFile {
    explicit OpenFile(const std::string& name) : fd(::open(name.c_str(), O_RDONLY | O_CLOEXEC))
    {
        if (fd < 0)
            throw Error::Read(fmt::format("{}: cannot be opened: {}", name, std::strerror(errno)));
    }
    ~OpenFile()
    {
        if (fd >= 0)
            ::close(fd);
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    int fd;
};

/// Bytes of a file, fewer where it ends before. @return false where it cannot be read, errno says why
bool read_at(int fd, std::uint64_t offset, std::string& bytes)
{
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t got = ::pread(fd, bytes.data() + done, bytes.size() - done, off_t(offset + done));
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return false;
        if (got == 0)
            break;
        done += std::size_t(got);
    }
    bytes.resize(done);
    return true;
}

PyramidDirectory read_directory(int fd, const std::string& name)
{
    struct stat info = {};
    std::string bytes(pyramid_header_bytes, '\0');
    if (::fstat(fd, &info) != 0 || !read_at(fd, 0, bytes))
        throw Error::Read(fmt::format("{}: cannot be read: {}", name, std::strerror(errno)));
    bytes = std::string(check_pyramid_header(bytes, std::uint64_t(info.st_size), name), '\0');
    if (!read_at(fd, 0, bytes))
        throw Error::Read(fmt::format("{}: cannot be read: {}", name, std::strerror(errno)));
    return decode_directory(bytes, name);
}

std::string tile_name(const TileId& id) { return fmt::format("tile {},{} of level {}", id.at.x, id.at.y, id.level); }

} // namespace

TerrainPyramid::TerrainPyramid(const std::filesystem::path& file) : name_(file.string()), fd_(-1), layout_({2, 2, 0, {1, 1}})
{
    OpenFile open(name_);
    directory_ = read_directory(open.fd, name_);
    layout_ = PyramidLayout(make_lattice(frame().columns, frame().rows, directory_.lattice_level));
    fd_ = std::exchange(open.fd, -1);
}

TerrainPyramid::~TerrainPyramid() { ::close(fd_); }

std::string TerrainPyramid::read_bytes(std::uint64_t offset, std::size_t size, const std::string& what) const
{
    std::string bytes(size, '\0');
    if (!read_at(fd_, offset, bytes))
        throw Error::Read(fmt::format("{}: {} cannot be read: {}", name_, what, std::strerror(errno)));
    if (bytes.size() < size)
        throw Error::Read(fmt::format("{}: {} is truncated: the file ends {} bytes before its end", name_, what, size - bytes.size()));
    return bytes;
}

std::string TerrainPyramid::read_packed(const TileId& id) const
{
    const TileEntry& where = entry(id);
    std::string bytes = read_bytes(where.offset, where.size, tile_name(id));
    if (where.size > 0 && checksum_of(bytes) != where.checksum)
        throw Error::Read(fmt::format("{}: {} is damaged: its checksum does not match", name_, tile_name(id)));
    ++tiles_read_;
    return bytes;
}

void TerrainPyramid::check(const TileId& id, const std::string& fault) const
{
    if (!fault.empty())
        throw Error::Read(fmt::format("{}: {} is damaged: {}", name_, tile_name(id), fault));
}

TerrainTile TerrainPyramid::read(const TileId& id, TileParts parts) const
{
    TerrainTile tile;
    check(id, (parts == TileParts::all ? unpack_tile : unpack_heights)(layout_, id, read_packed(id), tile));
    return tile;
}

float TerrainPyramid::edge_height(const ivec2& sample) const
{
    return sample.x == frame().columns - 1 ? directory_.last_column[std::size_t(sample.y)] : directory_.last_row[std::size_t(sample.x)];
}

bool is_pyramid_file(const std::filesystem::path& file)
{
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored))
        return false;
    std::ifstream in(file, std::ios::binary);
    std::string bytes(8, '\0');
    return in.read(bytes.data(), 8) && is_pyramid(bytes);
}

} // namespace limn
