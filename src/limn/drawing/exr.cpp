#include "limn/drawing/exr.h"

#include <cstring>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"

namespace limn {
namespace {

/// A file in memory.
class Memory : public Imf::OStream {
public:
    Memory() : Imf::OStream("memory") {}
    void write(const char bytes[], int count) override
    {
        if (at_ + std::size_t(count) > bytes_.size())
            bytes_.resize(at_ + std::size_t(count));
        std::memcpy(bytes_.data() + at_, bytes, std::size_t(count));
        at_ += std::size_t(count);
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t at) override { at_ = at; }
    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
    std::size_t at_ = 0;
};

} // namespace

std::string encode_exr(const Image& image)
{
    if (image.empty() || (image.channels != 1 && image.channels != 3))
        throw Error::Input(fmt::format("a picture of {} x {} with {} channels cannot be written as EXR", image.width, image.height, image.channels));
    static constexpr const char* names[2][3] = {{"Y"}, {"R", "G", "B"}};
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer pixels;
    const std::size_t step = sizeof(float) * std::size_t(image.channels);
    for (int c = 0; c < image.channels; ++c) {
        const char* name = names[image.channels == 3][c];
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        // The library takes pixels to read from through a pointer that could be written to.
        char* first = const_cast<char*>(reinterpret_cast<const char*>(image.samples.data() + c));
        pixels.insert(name, Imf::Slice(Imf::FLOAT, first, step, step * std::size_t(image.width)));
    }
    Memory memory;
    {
        Imf::OutputFile file(memory, header);
        file.setFrameBuffer(pixels);
        file.writePixels(image.height);
    }
    return memory.take();
}

void write_exr(const Image& image, const std::filesystem::path& path) { write_file(path, encode_exr(image)); }

} // namespace limn
