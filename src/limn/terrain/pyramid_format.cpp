#include "limn/terrain/pyramid_format.h"

#include <bit>
#include <concepts>
#include <cstring>

#include <fmt/format.h>
#include <zlib.h>

#include "limn/base/error.h"

namespace limn {
namespace {

constexpr std::string_view magic = "LIMNPYR\n";
constexpr std::uint32_t version = 1;
constexpr std::size_t entry_bytes = 32, checked_from = 16;

class Writer {
public:
    template <std::unsigned_integral T> void put(T value)
    {
        for (std::size_t byte = 0; byte < sizeof(T); ++byte)
            bytes_ += char(value >> (8 * byte) & 0xff);
    }
    void put(float value) { put(std::bit_cast<std::uint32_t>(value)); }
    void put(double value) { put(std::bit_cast<std::uint64_t>(value)); }
    void put(std::string_view text) { bytes_ += text; }
    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

class Reader {
public:
    explicit Reader(std::string_view bytes, std::size_t at = 0) : bytes_(bytes), at_(at) {}
    template <std::unsigned_integral T> T take()
    {
        T value = 0;
        for (std::size_t byte = 0; byte < sizeof(T); ++byte)
            value |= T(T(static_cast<unsigned char>(bytes_[at_ + byte])) << (8 * byte));
        at_ += sizeof(T);
        return value;
    }
    float take_float() { return std::bit_cast<float>(take<std::uint32_t>()); }
    double take_double() { return std::bit_cast<double>(take<std::uint64_t>()); }
    std::vector<float> take_floats(std::size_t count)
    {
        std::vector<float> out(count);
        for (float& value : out)
            value = take_float();
        return out;
    }
    std::string_view rest() const { return bytes_.substr(at_); }

private:
    std::string_view bytes_;
    std::size_t at_;
};

[[noreturn]] void fail(const std::string& name, const std::string& fault) { throw Error::Read(fmt::format("{}: {}", name, fault)); }

void put_tiles(const PyramidDirectory& directory, Writer& out)
{
    for (const TileEntry& tile : directory.tiles) {
        out.put(tile.offset);
        out.put(tile.size);
        out.put(tile.checksum);
        out.put(tile.bounds.error);
        out.put(tile.bounds.low);
        out.put(tile.bounds.high);
        out.put(std::uint32_t(0));
    }
}

/// The header from the byte on that the checksum covers, and the directory.
std::string checked_part(const PyramidDirectory& directory)
{
    const HeightMap& frame = directory.frame;
    Writer out;
    out.put(directory.file_bytes);
    for (const int number : {frame.columns, frame.rows, directory.lattice_level, directory.tile_level})
        out.put(std::uint32_t(number));
    for (const double number : {frame.spacing.x, frame.spacing.y, frame.origin.x, frame.origin.y})
        out.put(number);
    out.put(directory.low);
    out.put(directory.high);
    out.put(directory.samples);
    out.put(std::uint32_t(frame.system.size()));
    out.put(std::uint32_t(!directory.last_row.empty()));
    out.put(std::uint64_t(directory_bytes(directory) - pyramid_header_bytes));
    out.put(std::uint64_t(0));
    put_tiles(directory, out);
    for (const std::vector<float>* line : {&directory.last_column, &directory.last_row})
        for (const float height : *line)
            out.put(height);
    out.put(frame.system);
    return out.take();
}

} // namespace

std::size_t directory_bytes(const PyramidDirectory& directory)
{
    return pyramid_header_bytes + directory.tiles.size() * entry_bytes + 4 * (directory.last_column.size() + directory.last_row.size()) +
           directory.frame.system.size();
}

std::string encode_directory(const PyramidDirectory& directory)
{
    const std::string checked = checked_part(directory);
    Writer out;
    out.put(magic);
    out.put(version);
    out.put(checksum_of(checked));
    return out.take() + checked;
}

std::size_t check_pyramid_header(std::string_view header, std::uint64_t file_bytes, const std::string& name)
{
    if (!is_pyramid(header))
        fail(name, "is no pyramid of 'limn terrain build'");
    if (header.size() < pyramid_header_bytes)
        fail(name, fmt::format("is truncated: has {} bytes, and its header alone {}", file_bytes, pyramid_header_bytes));
    if (const auto found = Reader(header, magic.size()).take<std::uint32_t>(); found != version)
        fail(name, fmt::format("is a pyramid of version {}; this program reads version {}", found, version));
    if (const auto wanted = Reader(header, 16).take<std::uint64_t>(); file_bytes < wanted)
        fail(name, fmt::format("is truncated: has {} bytes of {}", file_bytes, wanted));
    const auto directory = Reader(header, 96).take<std::uint64_t>();
    if (directory > file_bytes - pyramid_header_bytes)
        fail(name, fmt::format("its header is damaged: a directory of {} bytes in a file of {}", directory, file_bytes));
    return pyramid_header_bytes + std::size_t(directory);
}

PyramidDirectory decode_directory(std::string_view bytes, const std::string& name)
{
    if (Reader(bytes, 12).take<std::uint32_t>() != checksum_of(bytes.substr(checked_from)))
        fail(name, "its header or directory is damaged (their checksum does not match)");
    Reader in(bytes, checked_from);
    PyramidDirectory out;
    out.file_bytes = in.take<std::uint64_t>();
    for (int* number : {&out.frame.columns, &out.frame.rows, &out.lattice_level, &out.tile_level})
        *number = int(in.take<std::uint32_t>());
    for (double* number : {&out.frame.spacing.x, &out.frame.spacing.y, &out.frame.origin.x, &out.frame.origin.y})
        *number = in.take_double();
    out.low = in.take_float(), out.high = in.take_float();
    out.samples = in.take<std::uint64_t>();
    const std::size_t name_bytes = in.take<std::uint32_t>(), lines = in.take<std::uint32_t>();
    in.take<std::uint64_t>();
    in.take<std::uint64_t>();
    const PyramidLayout layout(make_lattice(out.frame.columns, out.frame.rows, out.lattice_level));
    if (layout.tile_count() > bytes.size() / entry_bytes || name_bytes > bytes.size())
        fail(name, "its header contradicts itself");
    out.tiles.resize(layout.tile_count());
    if (lines != 0)
        out.last_column.resize(std::size_t(out.frame.rows)), out.last_row.resize(std::size_t(out.frame.columns));
    out.frame.system.resize(name_bytes);
    if (layout.tile_level != out.tile_level || directory_bytes(out) != bytes.size())
        fail(name, "its header contradicts itself");
    for (TileEntry& tile : out.tiles) {
        tile.offset = in.take<std::uint64_t>();
        tile.size = in.take<std::uint32_t>(), tile.checksum = in.take<std::uint32_t>();
        const float error = in.take_float(), low = in.take_float();
        tile.bounds = {error, low, in.take_float()};
        in.take<std::uint32_t>();
    }
    out.last_column = in.take_floats(out.last_column.size());
    out.last_row = in.take_floats(out.last_row.size());
    out.frame.system = in.rest();
    return out;
}

bool is_pyramid(std::string_view bytes) { return bytes.starts_with(magic); }

std::uint32_t checksum_of(std::string_view bytes)
{
    return std::uint32_t(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

} // namespace limn
