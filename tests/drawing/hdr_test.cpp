#include <gtest/gtest.h>

#include <cmath>

#include "limn/base/error.h"
#include "limn/base/random.h"
#include "limn/drawing/hdr.h"

namespace limn {
namespace {

Image some_light(ivec2 size)
{
    Image image(size, 3);
    Random random(1);
    for (float& sample : image.samples)
        sample = float(std::exp(random.uniform(-5, 8)));
    return image;
}

/// As other programs write it: channel by channel, in runs and pieces.
std::string run_length_coded(const std::string& plain, ivec2 size)
{
    const std::size_t begin = plain.size() - std::size_t(4 * size.x * size.y);
    std::string bytes = plain.substr(0, begin);
    for (int y = 0; y < size.y; ++y) {
        bytes += {char(2), char(2), char(size.x >> 8), char(size.x & 255)};
        for (int c = 0; c < 4; ++c)
            for (int x = 0; x < size.x;) {
                const auto at = [&](int column) { return plain[begin + std::size_t(4 * (y * size.x + column) + c)]; };
                int same = 1;
                while (x + same < size.x && same < 127 && at(x + same) == at(x))
                    ++same;
                if (same > 1) {
                    bytes += {char(std::uint8_t(128 + same)), at(x)};
                } else {
                    bytes += {char(1), at(x)};
                }
                x += same;
            }
    }
    return bytes;
}

std::string refusal(const std::string& bytes)
{
    try {
        decode_hdr(bytes, "sky.hdr");
    } catch (const Error::Read& error) {
        return error.what();
    }
    return "";
}

TEST(Hdr, SurvivesBeingWrittenAndRead)
{
    const Image first = some_light({40, 9});
    const std::string bytes = encode_hdr(first);
    for (const std::string& coding : {bytes, run_length_coded(bytes, first.size())}) {
        const Image second = decode_hdr(coding, "sky.hdr");
        ASSERT_EQ(second.size(), first.size());
        for (std::size_t i = 0; i < first.samples.size(); i += 3) {
            const float most = std::max({first.samples[i], first.samples[i + 1], first.samples[i + 2]});
            for (std::size_t c = 0; c < 3; ++c)
                ASSERT_NEAR(second.samples[i + c], first.samples[i + c], most / 250);
        }
    }
    Image dark({8, 1}, 3);
    EXPECT_EQ(decode_hdr(encode_hdr(dark), "sky.hdr").samples, dark.samples);
    // The oldest coding: (1, 1, 1, n) repeats the pixel before.
    const std::string old = "#?RGBE\nEXPOSURE=1\n\n-Y 1 +X 5\n" + std::string("\x80\x40\x20\x81\x01\x01\x01\x04", 8);
    EXPECT_EQ(decode_hdr(old, "sky.hdr").at(4, 0)[0], decode_hdr(old, "sky.hdr").at(0, 0)[0]);
}

TEST(Hdr, RefusesWhatIsNone)
{
    const std::string good = encode_hdr(some_light({16, 4})), coded = run_length_coded(good, {16, 4});
    EXPECT_EQ(refusal(good), "");
    for (const std::string& bytes : {good, coded})
        for (std::size_t cut = 0; cut < bytes.size(); ++cut)
            ASSERT_NE(refusal(bytes.substr(0, cut)), "") << cut;
    EXPECT_EQ(refusal("hello"), "sky.hdr: byte 0: no Radiance picture: it does not begin with '#?RADIANCE'");
    EXPECT_EQ(refusal("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd"), "sky.hdr: byte 34: 'FORMAT=32-bit_rle_xyze' is not read; 32-bit_rle_rgbe is");
    EXPECT_EQ(refusal("#?RADIANCE\n\n+X 4 -Y 4\n"), "sky.hdr: byte 12: '+X 4 -Y 4' is not '-Y HEIGHT +X WIDTH', the one way round that is read");
    EXPECT_EQ(refusal("#?RADIANCE\n\n-Y 0 +X 4\n"), "sky.hdr: byte 12: a Radiance picture of 4 x 0 pixels is too large or has none");
    EXPECT_EQ(refusal("#?RADIANCE\n\n-Y 60000 +X 4000\nabc"), "sky.hdr: byte 29: the file ends within the picture");
    std::string off = coded;
    off[off.size() - 2] = char(200); // a run that leaves the row
    EXPECT_NE(refusal(off), "");
    EXPECT_THROW(encode_hdr(Image({2, 2}, 4)), Error::Input);
    EXPECT_THROW(encode_hdr(Image()), Error::Input);
}

} // namespace
} // namespace limn
