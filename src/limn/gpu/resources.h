#pragma once

#include <span>
#include <utility>
#include <vector>

#include "limn/base/image.h"
#include "limn/base/vec.h"

namespace limn::gpu {

/// Owns one OpenGL name and deletes it.
template <void (*remove)(unsigned)> class Name {
public:
    Name() = default;
    explicit Name(unsigned id) : id_(id) {}
    ~Name()
    {
        if (id_ != 0)
            remove(id_);
    }
    Name(Name&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Name& operator=(Name&& other) noexcept
    {
        std::swap(id_, other.id_);
        return *this;
    }
    unsigned id() const { return id_; }

private:
    unsigned id_ = 0;
};

void delete_buffer(unsigned id);
void delete_texture(unsigned id);
void delete_framebuffer(unsigned id);
void delete_vertex_array(unsigned id);
void delete_query(unsigned id);
using Texture = Name<delete_texture>;
using VertexArray = Name<delete_vertex_array>;

/// Bytes on the device.
class Buffer {
public:
    Buffer() = default;
    /// @throws Error::Device where the device has no room.
    explicit Buffer(std::size_t bytes, const void* data = nullptr);
    template <class T> explicit Buffer(const std::vector<T>& data) : Buffer(data.size() * sizeof(T), data.data()) {}

    unsigned id() const { return name_.id(); }
    std::size_t bytes() const { return bytes_; }
    void write(std::size_t offset, std::size_t bytes, const void* data) const;
    void clear() const; ///< to zero
    /// Waits for the device.
    template <class T> std::vector<T> read(std::size_t count, std::size_t first = 0) const
    {
        std::vector<T> data(count);
        read_bytes(first * sizeof(T), count * sizeof(T), data.data());
        return data;
    }
    /// As shader storage at a binding point.
    void bind_storage(unsigned binding) const;
    /// As a block of uniforms at a binding point.
    void bind_uniforms(unsigned binding) const;

private:
    void read_bytes(std::size_t offset, std::size_t bytes, void* data) const;
    Name<delete_buffer> name_;
    std::size_t bytes_ = 0;
};

/// Bytes of so many things in a buffer that shaders read.
/// @param what  for the message, in the plural
/// @throws Error::Device where shaders do not see so much of a buffer
std::size_t storage_bytes(std::size_t count, std::size_t size, const char* what);

/// Tells when the device has done all that was queued before.
class Fence {
public:
    void set(); ///< from here on
    bool is_set() const { return sync_ != nullptr; }
    bool has_passed() const; ///< does not wait
    void clear();
    Fence() = default;
    ~Fence() { clear(); }
    Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}
    Fence& operator=(Fence&& other) noexcept
    {
        std::swap(sync_, other.sync_);
        return *this;
    }

private:
    void* sync_ = nullptr; ///< a GLsync
};

/// The formats of pictures on the device.
enum class Format : std::uint8_t { rgba8, r32f, rgba32f, r32ui, depth32f };

/// A picture on the device with one level. @throws Error::Device where the device has no room.
Texture make_texture(Format format, ivec2 size);

/// A texture of floats from all its levels, each half as large as the one before and of one channel; filtered between texels and levels,
/// its border repeated. The first row of an image has t = 0. @throws Error::Device where the device has no room.
Texture make_mipmaps(const std::vector<Image>& levels);

/// An array of RGBA textures of 16 bits a channel, not filtered, each a layer: pictures of one size with 3 or 4 channels, of 0 to 1. The first row
/// of an image has t = 0. @throws Error::Device where the device has no room.
Texture make_texture_array(const std::vector<const Image*>& layers);

/// For the sampler at a binding point.
void bind_texture(const Texture& texture, unsigned binding);

/// Pictures that a program draws into, with a depth buffer: Mesa's software renderer loses what fragment shaders write to
/// buffers where there is none.
class Framebuffer {
public:
    /// One colour picture for each format.
    /// @throws Error::Device where the device has no room or cannot draw into such pictures.
    Framebuffer(ivec2 size, const std::vector<Format>& colours);

    ivec2 size() const { return size_; }
    void bind() const; ///< draws go here, over the whole picture
    void clear(int colour, const vec4& value) const;
    void clear(int colour, unsigned value) const;
    void clear_depth(float value = 1) const;
    const Texture& colour(int index) const { return colours_[std::size_t(index)]; }
    const Texture& depth() const { return depth_; }
    /// Tests of depth go by those of another of the same size from now on, which has to outlive this.
    void use_depth_of(const Framebuffer& other) const;

    /// Pixels of a colour picture, rows from the bottom to the top as OpenGL has them. Waits for the device.
    std::vector<vec4> read_floats(int colour) const;
    std::vector<unsigned> read_unsigned(int colour) const;
    std::vector<float> read_depth() const;
    /// The value of the depth buffer at a pixel, rows from the bottom. Waits for the device.
    float depth_at(const ivec2& pixel) const;
    /// Fills the window of the context with the first colour picture; twice as large as the window, four pixels become one. Draws go
    /// to the window then.
    /// @param size  of the window, pixels
    void copy_to_window(const ivec2& size) const;

private:
    ivec2 size_;
    std::vector<Texture> colours_;
    Texture depth_;
    Name<delete_framebuffer> name_;
};

/// Tells whether anything was drawn between two moments.
class DrawnQuery {
public:
    DrawnQuery();
    void start() const;
    void stop() const;
    bool anything() const; ///< waits for the device

private:
    Name<delete_query> name_;
};

/// Time on the device between two moments. (Two time stamps: Mesa's software renderer measures nonsense as the time elapsed
/// where nothing but a clearing happens.)
class Timer {
public:
    Timer();
    void start() const;
    void stop() const;
    double milliseconds() const; ///< waits for the device

private:
    Name<delete_query> begin_, end_;
};

VertexArray make_vertex_array();

} // namespace limn::gpu
