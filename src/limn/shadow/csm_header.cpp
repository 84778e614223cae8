#include "limn/shadow/csm_header.h"

#include <bit>
#include <cstring>

#include <fmt/format.h>
#include <zlib.h>

#include "limn/base/error.h"

namespace limn {
namespace {

static_assert(std::endian::native == std::endian::little, "depths are looked up in the file as it stands");

constexpr std::string_view magic = "LIMNCSM\n";
constexpr std::uint32_t version = 1;

/// As it stands in the file.
struct Header {
    char magic[8];
    std::uint32_t version, header_checksum; ///< of what follows
    std::uint64_t file_bytes;
    std::uint32_t depths_checksum, codec;
    double centre[3], radius;
    std::uint64_t shape;
    std::uint32_t size, cells[2], spread, order, back;
    float margin;
    std::uint32_t zero[7];
};
static_assert(sizeof(Header) == csm_header_bytes);
constexpr std::size_t checked_from = 16;

std::uint32_t checksum_of(std::string_view bytes)
{
    return std::uint32_t(::crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

std::uint32_t checksum_of(const Header& header)
{
    return checksum_of({reinterpret_cast<const char*>(&header) + checked_from, csm_header_bytes - checked_from});
}

[[noreturn]] void fail(const std::string& name, const std::string& fault) { throw Error::Read(fmt::format("{}: {}", name, fault)); }

bool is_known(const Header& h)
{
    const auto within = [](std::uint32_t value, std::uint32_t low, std::uint32_t high) { return value >= low && value <= high; };
    return within(h.size, 1, largest_map) && within(h.cells[0], 1, most_cells) && within(h.cells[1], 1, most_cells) && h.cells[0] * h.cells[1] <= most_maps &&
           within(h.spread, 0, 2) && within(h.order, 0, 4) && within(h.back, 0, 1) && h.margin >= 0 && h.margin < 0.5f && h.radius > 0 && within(h.codec, 1, 2) &&
           (h.codec != std::uint32_t(ShadowCodec::bricks) || h.order == std::uint32_t(MapOrder::theta_linear));
}

Header checked_header(std::string_view bytes, const std::string& name)
{
    if (!bytes.starts_with(magic))
        fail(name, "is no file of 'limn shadow bake'");
    if (bytes.size() < csm_header_bytes)
        fail(name, fmt::format("is truncated: has {} bytes, and its header alone {}", bytes.size(), csm_header_bytes));
    Header header;
    std::memcpy(&header, bytes.data(), sizeof header);
    if (header.version != version)
        fail(name, fmt::format("is a shadow file of version {}; this program reads version {}", header.version, version));
    if (header.header_checksum != checksum_of(header))
        fail(name, "its header is damaged (its checksum does not match)");
    if (bytes.size() < header.file_bytes)
        fail(name, fmt::format("is truncated: has {} bytes of {}", bytes.size(), header.file_bytes));
    if (bytes.size() > header.file_bytes)
        fail(name, fmt::format("has {} bytes after its end", bytes.size() - header.file_bytes));
    if (header.depths_checksum != checksum_of(bytes.substr(csm_header_bytes)))
        fail(name, "its depths are damaged (their checksum does not match)");
    if (!is_known(header))
        fail(name, "its header tells what this program does not know");
    return header;
}

} // namespace

std::string encode_csm(const ShadowMapsInfo& info, std::string_view depths)
{
    Header header = {};
    std::memcpy(header.magic, magic.data(), magic.size());
    header.version = version;
    header.file_bytes = csm_header_bytes + depths.size();
    header.depths_checksum = checksum_of(depths);
    header.codec = std::uint32_t(info.codec);
    for (int axis = 0; axis < 3; ++axis)
        header.centre[axis] = info.sphere.centre[axis];
    header.radius = info.sphere.radius;
    header.shape = info.shape;
    header.size = std::uint32_t(info.size);
    header.cells[0] = std::uint32_t(info.grid.cells.x), header.cells[1] = std::uint32_t(info.grid.cells.y);
    header.spread = std::uint32_t(info.grid.spread);
    header.order = std::uint32_t(info.order);
    header.back = std::uint32_t(info.back);
    header.margin = info.margin;
    header.header_checksum = checksum_of(header);
    std::string bytes(reinterpret_cast<const char*>(&header), sizeof header);
    bytes += depths;
    return bytes;
}

ShadowMapsInfo decode_csm(std::string_view bytes, const std::string& name)
{
    const Header header = checked_header(bytes, name);
    ShadowMapsInfo info;
    info.grid = {DirectionSpread(header.spread), {int(header.cells[0]), int(header.cells[1])}};
    info.order = MapOrder(header.order);
    info.size = int(header.size);
    info.codec = ShadowCodec(header.codec);
    info.margin = header.margin;
    info.back = OpenBack(header.back);
    info.sphere = {{header.centre[0], header.centre[1], header.centre[2]}, header.radius};
    info.shape = header.shape;
    return info;
}

} // namespace limn
