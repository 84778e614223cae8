#pragma once

#include <string>
#include <vector>

#include "limn/base/image.h"
#include "limn/base/vec.h"
#include "limn/gpu/context.h"

struct GLFWwindow;

/// What a hand did since the last frame, outside of panels. Pixels of the window, y down.
struct Gestures {
    limn::dvec2 cursor = limn::dvec2(0), moved = limn::dvec2(0);
    bool pressed = false; ///< a button went down
    bool turns = false, pans = false;
    double wheel = 0;                    ///< steps, up above 0
    limn::dvec3 flight = limn::dvec3(0); ///< right, ahead and up, each -1 to 1; further with Shift
    bool fit = false, from_above = false, picture = false, marks = false, mesh_lines = false, panel = false; ///< keys
};

/// A window with an OpenGL 4.5 context, current on the thread that made it, and with panels of Dear ImGui. One at a time.
class Window {
public:
    /// @param swaps_freely  does not wait for the screen
    /// @throws Error::Device saying why there can be none
    Window(const std::string& title, const limn::ivec2& size, bool swaps_freely);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    const limn::gpu::DriverInfo& driver() const { return driver_; }
    limn::ivec2 size() const; ///< pixels
    bool is_closed() const;
    /// Waits until something happens, at most so long; 0: only looks.
    void wait(double seconds) const;
    /// Ends a wait(). From any thread, while there is a window.
    static void wake();

    /// Between them, ImGui may be told what to show.
    void begin_frame() const;
    Gestures gestures(); ///< since the last call; after begin_frame()
    void close() const;
    void end_frame() const; ///< shows it

    /// What will be shown by end_frame(), RGB, rows from the top.
    limn::Image read() const;
    void draw_panels() const; ///< over what is there; before end_frame()

private:
    static void key_went(GLFWwindow* window, int key, int code, int action, int modifiers);

    GLFWwindow* window_ = nullptr;
    std::vector<int> typed_; ///< keys that went down since the last frame, however shortly
    limn::gpu::DriverInfo driver_;
};
