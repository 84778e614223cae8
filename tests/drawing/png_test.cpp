#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "limn/base/error.h"
#include "limn/drawing/png.h"
#include "support/image_compare.h"
#include "support/support.h"

namespace limn {
namespace {

Image random_image(ivec2 size, int channels, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> value(0, 1);
    Image image(size, channels);
    for (float& s : image.samples)
        s = value(random);
    return image;
}

TEST(Png, RoundTripsWithinHalfAStep)
{
    for (int channels = 1; channels <= 4; ++channels)
        for (const int bits : {8, 16}) {
            const Image image = random_image({37, 23}, channels, unsigned(channels));
            const Image read = decode_png(encode_png(image, {.bits = bits}), "a.png");
            ASSERT_EQ(read.channels, channels);
            EXPECT_LE(test::largest_difference(image, read), 0.5001 / (bits == 8 ? 255 : 65535));
        }
}

TEST(Png, RoundTripsEverySixteenBitValueExactly)
{
    Image image({256, 256}, 1);
    for (std::size_t i = 0; i < 65536; ++i)
        image.samples[i] = float(i) / 65535.0f;
    EXPECT_EQ(decode_png(encode_png(image, {.bits = 16}), "a.png").samples, image.samples);
}

TEST(Png, ClampsWhatIsOutsideItsRange)
{
    Image image({4, 1}, 1);
    image.samples = {-1, 2, NAN, INFINITY};
    EXPECT_EQ(decode_png(encode_png(image), "a.png").samples, (std::vector<float>{0, 1, 0, 1}));
}

TEST(Png, NamesTheByteWhereATruncatedFileEnds)
{
    const std::string whole = encode_png(random_image({40, 40}, 3, 5));
    for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 97) {
        try {
            decode_png(std::string_view(whole).substr(0, length), "cut.png");
            ADD_FAILURE() << "accepted " << length << " of " << whole.size() << " bytes";
        } catch (const Error::Read& error) {
            const std::string expected = fmt::format("cut.png: byte {}: ", length < 8 ? 0 : length);
            EXPECT_TRUE(std::string(error.what()).starts_with(expected)) << error.what() << " at " << length;
        }
    }
}

TEST(Png, RefusesFlippedBytesOrReadsThem)
{
    const std::string whole = encode_png(random_image({12, 12}, 3, 6));
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string flipped = whole;
        flipped[i] = char(flipped[i] ^ 0x20);
        try {
            decode_png(flipped, "a.png");
        } catch (const Error::Read& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with("a.png: "));
        }
    }
}

TEST(Png, RefusesAClaimThatItsBytesCannotHold)
{
    std::string whole = encode_png(Image({1, 1}, 3));
    // The width stands at byte 16, its chunk's checksum at byte 29 (of the 100000 x 100000 head, computed once).
    const unsigned char head[] = {0, 1, 0x86, 0xa0, 0, 1, 0x86, 0xa0};
    for (std::size_t i = 0; i < 8; ++i)
        whole[16 + i] = char(head[i]);
    std::uint32_t crc = 0xffffffffu;
    for (std::size_t i = 12; i < 29; ++i) {
        crc ^= std::uint8_t(whole[i]);
        for (int bit = 0; bit < 8; ++bit)
            crc = crc & 1 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
    }
    crc = ~crc;
    for (std::size_t i = 0; i < 4; ++i)
        whole[29 + i] = char(crc >> (24 - 8 * i));
    try {
        decode_png(whole, "a.png");
        FAIL();
    } catch (const Error::Read& error) {
        EXPECT_NE(std::string(error.what()).find("claims 100000 x 100000 pixels"), std::string::npos) << error.what();
    }
}

TEST(Png, IsReadFromAndWrittenToFiles)
{
    const test::TemporaryFolder folder;
    const Image image = random_image({5, 7}, 3, 8);
    write_png(image, folder / "a.png");
    EXPECT_LE(test::largest_difference(image, read_png(folder / "a.png")), 0.0021);
    EXPECT_THROW(write_png(image, "/dev/full"), Error::Write);
    EXPECT_THROW(read_png(folder / "b.png"), Error::Read);
    EXPECT_THROW(encode_png(Image()), Error::Input);
    EXPECT_THROW(encode_png(image, {.bits = 4}), Error::Input);
}

TEST(Ssim, IsOneForEqualPicturesAndLowForOthers)
{
    const Image a = random_image({64, 64}, 3, 1), b = random_image({64, 64}, 3, 2);
    EXPECT_DOUBLE_EQ(test::ssim(a, a), 1);
    EXPECT_LT(test::ssim(a, b), 0.2);
}

} // namespace
} // namespace limn
