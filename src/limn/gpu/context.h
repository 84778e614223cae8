#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace limn::gpu {

/// What a driver says of itself.
struct DriverInfo {
    std::string vendor, renderer, version; ///< GL_VENDOR, GL_RENDERER, GL_VERSION
    bool software = false;                 ///< rasterises on the processor (llvmpipe)
    int max_texture_size = 0;              ///< texels along an edge
};

/// Of the context that is current.
DriverInfo current_driver();

/// An OpenGL 4.5 core context without a window (EGL): hardware devices first, then the driver's own choice, which is Mesa's
/// software renderer where there is no other. It is current on the thread that made it, and every object of this folder must
/// be used on that thread while it lives. One at a time in a thread.
class Context {
public:
    /// @throws Error::Device in one line that names each way tried and why it failed.
    Context();
    ~Context();
    Context(Context&&) noexcept;
    Context& operator=(Context&&) noexcept;

    const DriverInfo& info() const { return info_; }

    /// Calls back for every error and undefined behaviour that the driver reports from now on (tests make them failures).
    void on_problem(std::function<void(const std::string& message)> report);

private:
    struct Egl;
    std::unique_ptr<Egl> egl_;
    DriverInfo info_;
};

/// Whether the machine shows a graphics card to this process, by its device files: without one, opening a context only to find the
/// software renderer would cost a tenth of a second.
bool hardware_is_present();

/// The context that a user asks for: "cpu" for none; "gpu" for any driver's, Mesa's software renderer too; "auto" for that of a graphics card, where there
/// is one that works.
/// @param say  hears in one line why "auto" finds none that works, where there is a card
/// @throws Error::Device where "gpu" was asked for and there is no driver
std::optional<Context> wanted_context(const std::string& device, const std::function<void(const std::string& line)>& say);

/// Waits for all submitted work and throws what went wrong since the last call.
/// @throws Error::Device with the first OpenGL error's name and `what` was going on.
void check_errors(const char* what);

} // namespace limn::gpu
