#include "limn/gpu/context.h"

#include <filesystem>
#include <vector>

#ifdef __SANITIZE_ADDRESS__
#include <dlfcn.h>
#include <link.h>
#endif

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn::gpu {
namespace {

/// One way to a display, best first.
struct Route {
    std::string name;
    EGLenum platform = 0;
    void* native = nullptr;
};

bool has_extension(const char* list, std::string_view name)
{
    const std::string padded = fmt::format(" {} ", list ? list : "");
    return padded.find(fmt::format(" {} ", name)) != std::string::npos;
}

/// Devices without Mesa's mark of a software one.
std::vector<Route> hardware_routes(const char* client)
{
    if (!has_extension(client, "EGL_EXT_platform_device") || !has_extension(client, "EGL_EXT_device_enumeration"))
        return {};
    EGLDeviceEXT devices[16];
    EGLint count = 0;
    std::vector<Route> routes;
    if (!eglQueryDevicesEXT(16, devices, &count))
        return {};
    for (EGLint i = 0; i < count; ++i)
        if (!has_extension(eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software"))
            routes.push_back({fmt::format("device {}", i), EGL_PLATFORM_DEVICE_EXT, devices[i]});
    return routes;
}

std::vector<Route> routes()
{
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    std::vector<Route> all = hardware_routes(client);
    if (has_extension(client, "EGL_MESA_platform_surfaceless"))
        all.push_back({"surfaceless", EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY});
    return all;
}

std::string egl_error() { return fmt::format("EGL error 0x{:04x}", unsigned(eglGetError())); }

std::string text_of(GLenum name)
{
    const auto* text = reinterpret_cast<const char*>(glGetString(name));
    return text ? text : "";
}

#ifdef __SANITIZE_ADDRESS__
/// Keeps the driver in memory to the end of the process: the leak checker looks then, and where the driver has gone with its pointers, what
/// it holds for the next context looks lost.
void keep_driver()
{
    const auto keep = [](dl_phdr_info* module, std::size_t, void*) {
        if (std::string_view(module->dlpi_name).ends_with("_dri.so"))
            if (void* handle = dlopen(module->dlpi_name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE))
                dlclose(handle);
        return 0;
    };
    dl_iterate_phdr(keep, nullptr);
}
#else
void keep_driver() {}
#endif

using Report = std::function<void(const std::string&)>;

void GLAPIENTRY forward_problem(GLenum, GLenum type, GLuint, GLenum, GLsizei length, const GLchar* text, const void* report)
{
    if (type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR)
        (*static_cast<const Report*>(report))(std::string(text, std::size_t(length)));
}

const char* error_name(GLenum error)
{
    switch (error) {
    case GL_INVALID_ENUM: return "invalid enum";
    case GL_INVALID_VALUE: return "invalid value";
    case GL_INVALID_OPERATION: return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION: return "incomplete framebuffer";
    case GL_OUT_OF_MEMORY: return "out of memory";
    case GL_CONTEXT_LOST: return "the device was lost";
    default: return "unknown error";
    }
}

} // namespace

DriverInfo current_driver()
{
    DriverInfo info = {text_of(GL_VENDOR), text_of(GL_RENDERER), text_of(GL_VERSION)};
    info.software = info.renderer.find("llvmpipe") != std::string::npos || info.renderer.find("softpipe") != std::string::npos;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &info.max_texture_size);
    return info;
}

struct Context::Egl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    Report report;

    Egl() = default;
    Egl(const Egl&) = delete;
    Egl& operator=(const Egl&) = delete;
    ~Egl()
    {
        if (display == EGL_NO_DISPLAY)
            return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT)
            eglDestroyContext(display, context);
        eglTerminate(display);
    }

    /// @return why it failed, or ""
    std::string open(const Route& route)
    {
        // The name of EGL 1.5 without EXT ends the process in epoxy as long as there is no display.
        display = eglGetPlatformDisplayEXT(route.platform, route.native, nullptr);
        if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) {
            display = EGL_NO_DISPLAY;
            return "no display (" + egl_error() + ")";
        }
        if (!eglBindAPI(EGL_OPENGL_API))
            return "no OpenGL";
        const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE, EGL_NONE};
        context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
        if (context == EGL_NO_CONTEXT)
            return "no OpenGL 4.5 (" + egl_error() + ")";
        if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
            return "no context without a surface (" + egl_error() + ")";
        return "";
    }
};

Context::Context()
{
    std::string failures;
    for (const Route& route : routes()) {
        auto egl = std::make_unique<Egl>();
        const std::string failure = egl->open(route);
        if (failure.empty()) {
            egl_ = std::move(egl);
            info_ = current_driver();
            keep_driver();
            return;
        }
        failures += fmt::format("{}{}: {}", failures.empty() ? "" : ", ", route.name, failure);
    }
    throw Error::Device(fmt::format("no GPU driver with OpenGL 4.5 core can be used without a window ({}); "
                                    "Debian's libgl1-mesa-dri has one that runs on any processor",
                                    failures.empty() ? "EGL offers no way to one" : failures));
}

Context::~Context() = default;
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;

void Context::on_problem(Report report)
{
    egl_->report = std::move(report);
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(egl_->report ? forward_problem : nullptr, &egl_->report);
}

bool hardware_is_present()
{
    for (const char* file : {"/dev/nvidiactl", "/dev/dri", "/dev/dxg"})
        if (std::error_code ignored; std::filesystem::exists(file, ignored))
            return true;
    return false;
}

std::optional<Context> wanted_context(const std::string& device, const std::function<void(const std::string& line)>& say)
{
    if (device == "cpu" || (device == "auto" && !hardware_is_present()))
        return std::nullopt;
    try {
        Context context;
        if (device == "auto" && context.info().software)
            return std::nullopt; // the processor is faster without its detour
        return context;
    } catch (const Error::Device& error) {
        if (device != "auto")
            throw;
        say(std::string(error.what()) + "; the processor is used");
        return std::nullopt;
    }
}

void check_errors(const char* what)
{
    glFinish();
    const GLenum error = glGetError();
    while (error != GL_NO_ERROR && glGetError() != GL_NO_ERROR) {
    }
    if (error != GL_NO_ERROR)
        throw Error::Device(fmt::format("the GPU failed while {}: {}", what, error_name(error)));
}

} // namespace limn::gpu
