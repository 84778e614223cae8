#include "limn/drawing/hdr.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"

namespace limn {
namespace {

constexpr int largest = 1 << 16; ///< pixels along an edge
constexpr double most_pixels = 1 << 28;

/// Reads from front to back; says where it fails.
struct Reader {
    std::string_view bytes;
    const std::string& name;
    std::size_t at = 0;

    [[noreturn]] void fail(const std::string& what) const { throw Error::Read(fmt::format("{}: byte {}: {}", name, at, what)); }
    std::string_view line()
    {
        const std::size_t end = bytes.find('\n', at);
        if (end == std::string_view::npos)
            fail("the header of the Radiance picture has no end");
        const std::string_view found = bytes.substr(at, end - at);
        at = end + 1;
        return found;
    }
    std::uint8_t byte()
    {
        if (at >= bytes.size())
            fail("the file ends within the picture");
        return std::uint8_t(bytes[at++]);
    }
};

using Pixel = std::array<std::uint8_t, 4>;

void store(Image& image, int x, int y, const Pixel& pixel)
{
    const float scale = pixel[3] == 0 ? 0 : std::ldexp(1.0f, int(pixel[3]) - (128 + 8));
    for (std::size_t c = 0; c < 3; ++c)
        image.at(x, y)[c] = scale * (float(pixel[c]) + (pixel[3] == 0 ? 0.0f : 0.5f));
}

/// Channel by channel, in runs and pieces.
void read_coded_row(Reader& in, std::vector<Pixel>& row)
{
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t x = 0; x < row.size();) {
            const std::uint8_t count = in.byte();
            const std::size_t length = count > 128 ? count - 128u : count;
            if (length == 0 || x + length > row.size())
                in.fail("a run of the Radiance picture leaves its row");
            const std::uint8_t same = count > 128 ? in.byte() : 0;
            for (std::size_t k = 0; k < length; ++k)
                row[x++][c] = count > 128 ? same : in.byte();
        }
}

/// Pixel by pixel; (1, 1, 1, n) repeats the pixel before it.
void read_plain_row(Reader& in, const Pixel& first, std::vector<Pixel>& row)
{
    Pixel pixel = first;
    int shift = 0;
    for (std::size_t x = 0; x < row.size();) {
        if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
            const std::size_t length = std::size_t(pixel[3]) << shift;
            if (x == 0 || shift > 16 || x + length > row.size())
                in.fail("a run of the Radiance picture leaves its row");
            std::fill_n(row.begin() + std::ptrdiff_t(x), length, row[x - 1]);
            x += length, shift += 8;
        } else {
            row[x++] = pixel, shift = 0;
        }
        if (x < row.size())
            for (std::uint8_t& value : pixel)
                value = in.byte();
    }
}

void read_row(Reader& in, std::vector<Pixel>& row)
{
    Pixel first;
    for (std::uint8_t& value : first)
        value = in.byte();
    const bool is_coded = first[0] == 2 && first[1] == 2 && first[2] < 128 && row.size() >= 8 && row.size() < 32768;
    if (!is_coded)
        read_plain_row(in, first, row);
    else if (std::size_t(first[2]) * 256 + first[3] != row.size())
        in.fail("a row of the Radiance picture has another length than its header says");
    else
        read_coded_row(in, row);
}

/// "-Y 512 +X 1024".
ivec2 read_size(Reader& in)
{
    const std::size_t begin = in.at;
    const std::string_view line = in.line();
    ivec2 size(0);
    const auto number = [&](std::size_t from, int& value) {
        const auto [end, failure] = std::from_chars(line.data() + std::min(from, line.size()), line.data() + line.size(), value);
        return failure == std::errc() ? std::size_t(end - line.data()) : std::string_view::npos;
    };
    const std::size_t middle = line.starts_with("-Y ") ? number(3, size.y) : std::string_view::npos;
    const bool is_upright = middle != std::string_view::npos && line.substr(middle, 4) == " +X " && number(middle + 4, size.x) == line.size();
    in.at = begin;
    if (!is_upright)
        in.fail(fmt::format("'{}' is not '-Y HEIGHT +X WIDTH', the one way round that is read", line.substr(0, 40)));
    if (size.x < 1 || size.y < 1 || size.x > largest || size.y > largest || double(size.x) * size.y > most_pixels)
        in.fail(fmt::format("a Radiance picture of {} x {} pixels is too large or has none", size.x, size.y));
    in.line();
    return size;
}

} // namespace

Image decode_hdr(std::string_view bytes, const std::string& name)
{
    Reader in = {bytes, name};
    if (!bytes.starts_with("#?RADIANCE") && !bytes.starts_with("#?RGBE"))
        in.fail("no Radiance picture: it does not begin with '#?RADIANCE'");
    for (std::string_view line = in.line(); !line.empty(); line = in.line())
        if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
            in.fail(fmt::format("'{}' is not read; 32-bit_rle_rgbe is", line.substr(0, 40)));
    const ivec2 size = read_size(in);
    if (std::size_t(size.y) * 4 > bytes.size() - in.at) // before so much memory is taken
        in.fail("the file ends within the picture");
    Image image(size, 3);
    std::vector<Pixel> row(std::size_t(size.x));
    for (int y = 0; y < size.y; ++y) {
        read_row(in, row);
        for (int x = 0; x < size.x; ++x)
            store(image, x, y, row[std::size_t(x)]);
    }
    return image;
}

Image read_hdr(const std::filesystem::path& path) { return decode_hdr(read_file(path), path == "-" ? "standard input" : path.string()); }

std::string encode_hdr(const Image& image)
{
    if (image.empty() || image.channels != 3)
        throw Error::Input(fmt::format("a Radiance picture has three channels, not {}", image.channels));
    std::string bytes = fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height, image.width);
    for (std::size_t i = 0; i < image.samples.size(); i += 3) {
        const float* rgb = image.samples.data() + i;
        int exponent = 0;
        const float most = std::max({rgb[0], rgb[1], rgb[2]});
        if (most > 1e-32f)
            std::frexp(most, &exponent);
        for (int c = 0; c < 3; ++c)
            bytes += char(std::uint8_t(most > 1e-32f ? std::clamp(std::ldexp(rgb[c], 8 - exponent), 0.0f, 255.0f) : 0.0f));
        bytes += char(std::uint8_t(most > 1e-32f ? std::clamp(exponent + 128, 0, 255) : 0));
    }
    return bytes;
}

} // namespace limn
