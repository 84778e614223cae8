#include "limn/gpu/resources.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn::gpu {
namespace {

struct GlFormat {
    GLenum internal, layout, type;
};

GlFormat gl_format(Format format)
{
    switch (format) {
    case Format::rgba8: return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};
    case Format::r32f: return {GL_R32F, GL_RED, GL_FLOAT};
    case Format::rgba32f: return {GL_RGBA32F, GL_RGBA, GL_FLOAT};
    case Format::r32ui: return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT};
    case Format::depth32f: return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT};
    }
    return {};
}

void check_room(std::string_view what)
{
    for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError())
        if (error == GL_OUT_OF_MEMORY)
            throw Error::Device(fmt::format("the GPU has no room for {}", what));
}

template <class T> std::vector<T> read_texture(const Texture& texture, ivec2 size, GLenum layout, GLenum type)
{
    std::vector<T> pixels(std::size_t(size.x) * std::size_t(size.y));
    glGetTextureImage(texture.id(), 0, layout, type, GLsizei(pixels.size() * sizeof(T)), pixels.data());
    return pixels;
}

} // namespace

void delete_buffer(unsigned id) { glDeleteBuffers(1, &id); }
void delete_texture(unsigned id) { glDeleteTextures(1, &id); }
void delete_framebuffer(unsigned id) { glDeleteFramebuffers(1, &id); }
void delete_vertex_array(unsigned id) { glDeleteVertexArrays(1, &id); }
void delete_query(unsigned id) { glDeleteQueries(1, &id); }

Buffer::Buffer(std::size_t bytes, const void* data) : bytes_(bytes)
{
    unsigned id = 0;
    glCreateBuffers(1, &id);
    name_ = Name<delete_buffer>(id);
    // A buffer of no bytes is an error in OpenGL, but not to us.
    glNamedBufferStorage(id, GLsizeiptr(std::max<std::size_t>(bytes, 4)), bytes > 0 ? data : nullptr, GL_DYNAMIC_STORAGE_BIT);
    check_room(fmt::format("a buffer of {} bytes", bytes));
}

void Buffer::write(std::size_t offset, std::size_t bytes, const void* data) const
{
    if (bytes > 0)
        glNamedBufferSubData(id(), GLintptr(offset), GLsizeiptr(bytes), data);
}

void Buffer::clear() const { glClearNamedBufferData(id(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr); }

void Buffer::read_bytes(std::size_t offset, std::size_t bytes, void* data) const
{
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    if (bytes > 0)
        glGetNamedBufferSubData(id(), GLintptr(offset), GLsizeiptr(bytes), data);
}

void Buffer::bind_storage(unsigned binding) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, id()); }
void Buffer::bind_uniforms(unsigned binding) const { glBindBufferBase(GL_UNIFORM_BUFFER, binding, id()); }

std::size_t storage_bytes(std::size_t count, std::size_t size, const char* what)
{
    GLint64 most = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    if (count * size > std::size_t(most))
        throw Error::Device(fmt::format("{} {} take {} bytes on the GPU, whose shaders see at most {} of a buffer (at most {} {})", count,
                                        what, count * size, most, std::size_t(most) / size, what));
    return count * size;
}

void Fence::set()
{
    clear();
    sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glFlush();
}

bool Fence::has_passed() const
{
    const GLenum state = sync_ ? glClientWaitSync(static_cast<GLsync>(sync_), 0, 0) : GLenum(GL_ALREADY_SIGNALED);
    return state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED;
}

void Fence::clear()
{
    if (sync_)
        glDeleteSync(static_cast<GLsync>(sync_));
    sync_ = nullptr;
}

Texture make_texture(Format format, ivec2 size)
{
    unsigned id = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &id);
    Texture texture(id);
    glTextureStorage2D(id, 1, gl_format(format).internal, size.x, size.y);
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    check_room(fmt::format("a picture of {} x {}", size.x, size.y));
    return texture;
}

Texture make_mipmaps(const std::vector<Image>& levels)
{
    unsigned id = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &id);
    Texture texture(id);
    glTextureStorage2D(id, GLsizei(levels.size()), GL_R32F, levels[0].width, levels[0].height);
    for (std::size_t k = 0; k < levels.size(); ++k)
        glTextureSubImage2D(id, GLint(k), 0, 0, levels[k].width, levels[k].height, GL_RED, GL_FLOAT, levels[k].samples.data());
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    check_room(fmt::format("a texture of {} x {}", levels[0].width, levels[0].height));
    return texture;
}

Texture make_texture_array(const std::vector<const Image*>& layers)
{
    unsigned id = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &id);
    Texture texture(id);
    const ivec2 size = layers[0]->size();
    glTextureStorage3D(id, 1, GL_RGBA16, size.x, size.y, GLsizei(layers.size()));
    for (std::size_t k = 0; k < layers.size(); ++k)
        glTextureSubImage3D(id, 0, 0, 0, GLint(k), size.x, size.y, 1, layers[k]->channels == 3 ? GL_RGB : GL_RGBA, GL_FLOAT, layers[k]->samples.data());
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    check_room(fmt::format("{} textures of {} x {}", layers.size(), size.x, size.y));
    return texture;
}

void bind_texture(const Texture& texture, unsigned binding) { glBindTextureUnit(binding, texture.id()); }

Framebuffer::Framebuffer(ivec2 size, const std::vector<Format>& colours) : size_(size)
{
    unsigned id = 0;
    glCreateFramebuffers(1, &id);
    name_ = Name<delete_framebuffer>(id);
    std::vector<GLenum> targets;
    for (const Format format : colours) {
        targets.push_back(GLenum(GL_COLOR_ATTACHMENT0 + targets.size()));
        colours_.push_back(make_texture(format, size));
        glNamedFramebufferTexture(id, targets.back(), colours_.back().id(), 0);
    }
    depth_ = make_texture(Format::depth32f, size);
    glNamedFramebufferTexture(id, GL_DEPTH_ATTACHMENT, depth_.id(), 0);
    glNamedFramebufferDrawBuffers(id, GLsizei(targets.size()), targets.data());
    if (glCheckNamedFramebufferStatus(id, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw Error::Device(fmt::format("the GPU cannot draw into a picture of {} x {}", size.x, size.y));
}

void Framebuffer::use_depth_of(const Framebuffer& other) const { glNamedFramebufferTexture(name_.id(), GL_DEPTH_ATTACHMENT, other.depth_.id(), 0); }

void Framebuffer::bind() const
{
    glBindFramebuffer(GL_FRAMEBUFFER, name_.id());
    glViewport(0, 0, size_.x, size_.y);
}

void Framebuffer::clear(int colour, const vec4& value) const { glClearNamedFramebufferfv(name_.id(), GL_COLOR, colour, &value.x); }
void Framebuffer::clear(int colour, unsigned value) const
{
    const unsigned values[4] = {value, value, value, value};
    glClearNamedFramebufferuiv(name_.id(), GL_COLOR, colour, values);
}
void Framebuffer::clear_depth(float value) const { glClearNamedFramebufferfv(name_.id(), GL_DEPTH, 0, &value); }

std::vector<vec4> Framebuffer::read_floats(int index) const { return read_texture<vec4>(colour(index), size_, GL_RGBA, GL_FLOAT); }
std::vector<unsigned> Framebuffer::read_unsigned(int index) const { return read_texture<unsigned>(colour(index), size_, GL_RED_INTEGER, GL_UNSIGNED_INT); }
std::vector<float> Framebuffer::read_depth() const { return read_texture<float>(depth_, size_, GL_DEPTH_COMPONENT, GL_FLOAT); }

float Framebuffer::depth_at(const ivec2& pixel) const
{
    float value = 0;
    glGetTextureSubImage(depth_.id(), 0, pixel.x, pixel.y, 0, 1, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, sizeof value, &value);
    return value;
}

void Framebuffer::copy_to_window(const ivec2& size) const
{
    const GLenum filter = size == size_ ? GL_NEAREST : GL_LINEAR;
    glBlitNamedFramebuffer(name_.id(), 0, 0, 0, size_.x, size_.y, 0, 0, size.x, size.y, GL_COLOR_BUFFER_BIT, filter);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, size.x, size.y);
}

DrawnQuery::DrawnQuery()
{
    unsigned id = 0;
    glCreateQueries(GL_ANY_SAMPLES_PASSED, 1, &id);
    name_ = Name<delete_query>(id);
}

void DrawnQuery::start() const { glBeginQuery(GL_ANY_SAMPLES_PASSED, name_.id()); }
void DrawnQuery::stop() const { glEndQuery(GL_ANY_SAMPLES_PASSED); }

bool DrawnQuery::anything() const
{
    GLuint any = 0;
    glGetQueryObjectuiv(name_.id(), GL_QUERY_RESULT, &any);
    return any != 0;
}

Timer::Timer()
{
    unsigned ids[2] = {};
    glCreateQueries(GL_TIMESTAMP, 2, ids);
    begin_ = Name<delete_query>(ids[0]);
    end_ = Name<delete_query>(ids[1]);
}

void Timer::start() const { glQueryCounter(begin_.id(), GL_TIMESTAMP); }
void Timer::stop() const { glQueryCounter(end_.id(), GL_TIMESTAMP); }

double Timer::milliseconds() const
{
    GLuint64 begin = 0, end = 0;
    glGetQueryObjectui64v(begin_.id(), GL_QUERY_RESULT, &begin);
    glGetQueryObjectui64v(end_.id(), GL_QUERY_RESULT, &end);
    return 1e-6 * double(end - begin);
}

VertexArray make_vertex_array()
{
    unsigned id = 0;
    glCreateVertexArrays(1, &id);
    return VertexArray(id);
}

} // namespace limn::gpu
