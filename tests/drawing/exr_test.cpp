#include "limn/drawing/exr.h"

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "limn/base/error.h"
#include "support/support.h"

namespace limn {
namespace {

std::vector<float> channel(const std::filesystem::path& path, const char* name, int width, int height)
{
    Imf::InputFile file(path.c_str());
    EXPECT_NE(file.header().channels().findChannel(name), nullptr) << name;
    std::vector<float> samples(std::size_t(width) * std::size_t(height));
    Imf::FrameBuffer pixels;
    pixels.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(samples.data()), sizeof(float), sizeof(float) * std::size_t(width)));
    file.setFrameBuffer(pixels);
    file.readPixels(0, height - 1);
    return samples;
}

TEST(Exr, KeepsEverySampleAsItIs)
{
    const test::TemporaryFolder folder;
    Image grey({3, 2}, 1);
    grey.samples = {0, -1.5f, 1e20f, std::numeric_limits<float>::infinity(), 1e-30f, 7};
    write_exr(grey, folder / "grey.exr");
    EXPECT_EQ(channel(folder / "grey.exr", "Y", 3, 2), grey.samples);
    Image colour({2, 1}, 3);
    colour.samples = {1, 2, 3, 4, 5, 6};
    write_exr(colour, folder / "colour.exr");
    EXPECT_EQ(channel(folder / "colour.exr", "R", 2, 1), (std::vector<float>{1, 4}));
    EXPECT_EQ(channel(folder / "colour.exr", "B", 2, 1), (std::vector<float>{3, 6}));
}

TEST(Exr, RefusesWhatItCannotHold)
{
    EXPECT_THROW(encode_exr(Image()), Error::Input);
    EXPECT_THROW(encode_exr(Image({2, 2}, 2)), Error::Input);
}

} // namespace
} // namespace limn
