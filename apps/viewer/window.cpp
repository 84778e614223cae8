#include "window.h"

#include <algorithm>
#include <utility>

#include <epoxy/gl.h>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include "limn/base/error.h"

using namespace limn;

namespace {

std::string last_error()
{
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "unknown reason";
}

[[noreturn]] void fail(const std::string& what)
{
    const std::string why = last_error();
    glfwTerminate();
    throw Error::Device(
        fmt::format("no window can be opened: {} ({}); 'limn terrain -o view.png' and 'limn render -o view.png' need none", what, why));
}

void set_style(float scale)
{
    ImGui::StyleColorsLight();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 4;
    style.FrameRounding = 3;
    style.WindowBorderSize = 0;
    style.Colors[ImGuiCol_WindowBg] = ImVec4(1, 1, 1, 0.88f);
    style.ScaleAllSizes(scale);
    ImGui::GetIO().FontGlobalScale = scale;
    ImGui::GetIO().IniFilename = nullptr; // nothing is written that was not asked for
}

} // namespace

Window::Window(const std::string& title, const ivec2& size, bool swaps_freely)
{
    if (!glfwInit())
        fail("there is no display");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    window_ = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
    if (!window_)
        fail("the display has no OpenGL 4.5 core");
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(swaps_freely ? 0 : 1);
    driver_ = gpu::current_driver();
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, key_went); // before ImGui, which passes on what it hears
    ImGui::CreateContext();
    float scale = 1;
    glfwGetWindowContentScale(window_, &scale, nullptr);
    set_style(scale);
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    ImGui_ImplOpenGL3_Init("#version 450");
}

Window::~Window()
{
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window_);
    glfwTerminate();
}

ivec2 Window::size() const
{
    ivec2 size(0);
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return size;
}

bool Window::is_closed() const { return glfwWindowShouldClose(window_); }
void Window::close() const { glfwSetWindowShouldClose(window_, GLFW_TRUE); }
void Window::wake() { glfwPostEmptyEvent(); }

void Window::wait(double seconds) const
{
    if (seconds > 0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
}

void Window::begin_frame() const
{
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Window::key_went(GLFWwindow* window, int key, int, int action, int)
{
    if (action == GLFW_PRESS)
        static_cast<Window*>(glfwGetWindowUserPointer(window))->typed_.push_back(key);
}

Gestures Window::gestures()
{
    const std::vector<int> keys = std::exchange(typed_, {});
    const ImGuiIO& io = ImGui::GetIO();
    Gestures g;
    const dvec2 pixels(double(io.DisplayFramebufferScale.x), double(io.DisplayFramebufferScale.y)); // of a unit of the desktop
    if (!io.WantCaptureMouse) {
        g.cursor = dvec2(double(io.MousePos.x), double(io.MousePos.y)) * pixels;
        g.moved = dvec2(double(io.MouseDelta.x), double(io.MouseDelta.y)) * pixels;
        g.pressed = ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2);
        const bool left = ImGui::IsMouseDown(0);
        g.pans = ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2) || (left && io.KeyShift);
        g.turns = left && !g.pans;
        g.wheel = double(io.MouseWheel);
    }
    if (io.WantCaptureKeyboard)
        return g;
    const auto held = [](int one, int other) { return double(ImGui::IsKeyDown(one) || ImGui::IsKeyDown(other)); };
    g.flight = {held(GLFW_KEY_D, GLFW_KEY_RIGHT) - held(GLFW_KEY_A, GLFW_KEY_LEFT),
                held(GLFW_KEY_W, GLFW_KEY_UP) - held(GLFW_KEY_S, GLFW_KEY_DOWN),
                held(GLFW_KEY_E, GLFW_KEY_PAGE_UP) - held(GLFW_KEY_Q, GLFW_KEY_PAGE_DOWN)};
    if (io.KeyShift)
        g.flight *= 4.0;
    const auto typed = [&](int code) { return std::count(keys.begin(), keys.end(), code) % 2 == 1; };
    g.fit = typed(GLFW_KEY_F);
    g.from_above = typed(GLFW_KEY_T);
    g.picture = typed(GLFW_KEY_P);
    g.marks = typed(GLFW_KEY_M);
    g.mesh_lines = typed(GLFW_KEY_G);
    g.panel = typed(GLFW_KEY_H);
    if (typed(GLFW_KEY_ESCAPE))
        close();
    return g;
}

void Window::draw_panels() const
{
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Window::end_frame() const { glfwSwapBuffers(window_); }

Image Window::read() const
{
    const ivec2 extent = size();
    std::vector<unsigned char> bytes(std::size_t(extent.x) * std::size_t(extent.y) * 3);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, extent.x, extent.y, GL_RGB, GL_UNSIGNED_BYTE, bytes.data());
    Image image(extent, 3);
    for (int y = 0; y < extent.y; ++y) {
        const unsigned char* row = &bytes[std::size_t(extent.y - 1 - y) * std::size_t(extent.x) * 3];
        std::transform(row, row + 3 * extent.x, image.at(0, y), [](unsigned char c) { return float(c) / 255; });
    }
    return image;
}
