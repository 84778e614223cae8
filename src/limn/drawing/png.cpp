#include "limn/drawing/png.h"

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <png.h>

#include "limn/base/error.h"
#include "limn/base/file.h"

namespace limn {
namespace {

/// What libpng said when it gave up.
struct Failure {
    std::string text;
};

void note_failure(png_structp png, png_const_charp text)
{
    static_cast<Failure*>(png_get_error_ptr(png))->text = text;
    longjmp(png_jmpbuf(png), 1);
}

void ignore_warning(png_structp, png_const_charp) {}

struct DeleteWriter {
    png_infop info = nullptr;
    void operator()(png_structp png) { png_destroy_write_struct(&png, &info); }
};

struct DeleteReader {
    png_infop info = nullptr;
    void operator()(png_structp png) { png_destroy_read_struct(&png, &info, nullptr); }
};

/// Rows of samples as they stand in the file (16-bit samples big-endian).
struct Rows {
    std::vector<std::uint8_t> bytes;
    std::vector<png_bytep> starts;

    Rows(std::size_t row_bytes, std::size_t rows) : bytes(row_bytes * rows), starts(rows)
    {
        for (std::size_t y = 0; y < rows; ++y)
            starts[y] = bytes.data() + y * row_bytes;
    }
};

Rows quantised(const Image& image, int bits)
{
    const std::size_t samples_in_row = std::size_t(image.width) * std::size_t(image.channels);
    Rows rows(samples_in_row * std::size_t(bits / 8), std::size_t(image.height));
    const float top = bits == 8 ? 255.0f : 65535.0f;
    for (std::size_t i = 0; i < image.samples.size(); ++i) {
        const float sample = image.samples[i];
        const auto value = std::uint32_t(sample > 0 ? std::lround(std::min(sample, 1.0f) * top) : 0);
        if (bits == 16)
            rows.bytes[2 * i] = std::uint8_t(value >> 8);
        rows.bytes[bits == 8 ? i : 2 * i + 1] = std::uint8_t(value);
    }
    return rows;
}

void append_bytes(png_structp png, png_bytep bytes, std::size_t count)
{
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), count);
}

void flush_nothing(png_structp) {}

/// The part under setjmp: no object with a destructor may be made in here.
bool write_rows(png_structp png, png_infop info, const Image& image, const PngOptions& options, png_bytepp rows)
{
    static constexpr int colour_types[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_set_IHDR(png, info, png_uint_32(image.width), png_uint_32(image.height), options.bits, colour_types[image.channels - 1], PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (options.pixels_per_mm > 0) {
        const auto per_metre = png_uint_32(std::lround(options.pixels_per_mm * 1000));
        png_set_pHYs(png, info, per_metre, per_metre, PNG_RESOLUTION_METER);
    }
    png_write_info(png, info);
    png_write_image(png, rows);
    png_write_end(png, info);
    return true;
}

struct Source {
    std::string_view bytes;
    std::size_t position = 0;
};

void take_bytes(png_structp png, png_bytep to, std::size_t count)
{
    auto* source = static_cast<Source*>(png_get_io_ptr(png));
    if (count > source->bytes.size() - source->position) {
        source->position = source->bytes.size();
        png_error(png, "the file ends too early");
    }
    std::memcpy(to, source->bytes.data() + source->position, count);
    source->position += count;
}

bool read_head(png_structp png, png_infop info)
{
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
    png_read_info(png, info);
    png_set_expand(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    return true;
}

bool read_rows(png_structp png, png_infop info, png_bytepp rows)
{
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_read_image(png, rows);
    png_read_end(png, info);
    return true;
}

/// A deflate stream cannot expand more than about 1032 times, so a small file with a huge claim lies.
void check_claim(const std::string& name, std::size_t width, std::size_t height, std::size_t row_bytes, std::size_t file_bytes)
{
    if (double(row_bytes) * double(height) > 1100.0 * double(file_bytes))
        throw Error::Read(fmt::format("{}: claims {} x {} pixels, more than its {} bytes can hold", name, width, height, file_bytes));
}

Image image_of(const Rows& rows, ivec2 size, int channels, int bits)
{
    Image image(size, channels);
    for (std::size_t i = 0; i < image.samples.size(); ++i)
        image.samples[i] = bits == 8 ? float(rows.bytes[i]) / 255.0f
                                     : float(rows.bytes[2 * i] << 8 | rows.bytes[2 * i + 1]) / 65535.0f;
    return image;
}

} // namespace

std::string encode_png(const Image& image, const PngOptions& options)
{
    if (image.empty() || image.channels < 1 || image.channels > 4)
        throw Error::Input(fmt::format("a PNG needs pixels of 1 to 4 channels; the picture is {} x {} of {}", image.width, image.height, image.channels));
    if (options.bits != 8 && options.bits != 16)
        throw Error::Input(fmt::format("a PNG of {} bits cannot be written; 8 or 16 can", options.bits));
    Rows rows = quantised(image, options.bits);
    std::string bytes;
    Failure failure;
    std::unique_ptr<png_struct, DeleteWriter> png(png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, note_failure, ignore_warning));
    png.get_deleter().info = png_create_info_struct(png.get());
    png_set_write_fn(png.get(), &bytes, append_bytes, flush_nothing);
    if (!write_rows(png.get(), png.get_deleter().info, image, options, rows.starts.data()))
        throw Error::Write(fmt::format("the picture of {} x {} cannot be written as PNG: {}", image.width, image.height, failure.text));
    return bytes;
}

void write_png(const Image& image, const std::filesystem::path& path, const PngOptions& options)
{
    write_file(path, encode_png(image, options));
}

Image decode_png(std::string_view bytes, const std::string& name)
{
    if (png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, std::min<std::size_t>(8, bytes.size())) != 0 || bytes.size() < 8)
        throw Error::Read(fmt::format("{}: byte 0: no PNG signature", name));
    Failure failure;
    Source source = {bytes};
    std::unique_ptr<png_struct, DeleteReader> reader(png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure, note_failure, ignore_warning));
    png_structp png = reader.get();
    png_infop info = reader.get_deleter().info = png_create_info_struct(png);
    png_set_read_fn(png, &source, take_bytes);
    const auto refuse = [&]() { throw Error::Read(fmt::format("{}: byte {}: {}", name, source.position, failure.text)); };
    if (!read_head(png, info))
        refuse();
    const std::size_t width = png_get_image_width(png, info), height = png_get_image_height(png, info), row_bytes = png_get_rowbytes(png, info);
    check_claim(name, width, height, row_bytes, bytes.size());
    Rows rows(row_bytes, height);
    if (!read_rows(png, info, rows.starts.data()))
        refuse();
    return image_of(rows, {int(width), int(height)}, png_get_channels(png, info), png_get_bit_depth(png, info));
}

Image read_png(const std::filesystem::path& path) { return decode_png(read_file(path), path == "-" ? "standard input" : path.string()); }

} // namespace limn
