#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "limn/base/vec.h"

namespace limn::gpu {

/// The kinds of shader, by the ending of their file.
enum class Stage : std::uint8_t { vertex, tess_control, tess_evaluation, geometry, fragment, compute };

struct ShaderText {
    Stage stage;
    std::string name; ///< for messages
    std::string text; ///< GLSL 4.50 without #version; may include "limn/formulas/NAME.glsl" and "limn/gpu/shaders/NAME"
};

/// A linked program. Needs a Context.
class Program {
public:
    /// @throws Error::Device with the compiler's first message, which names the file and line.
    explicit Program(const std::vector<ShaderText>& shaders);
    ~Program();
    Program(Program&& other) noexcept;
    Program& operator=(Program&& other) noexcept;

    unsigned id() const { return id_; }
    void use() const;
    /// Sets a uniform. A name that the program does not use is passed over.
    void set(const char* name, float value) const;
    void set(const char* name, int value) const;
    void set(const char* name, unsigned value) const;
    void set(const char* name, const vec2& value) const;
    void set(const char* name, const vec3& value) const;
    void set(const char* name, const vec4& value) const;
    void set(const char* name, const ivec2& value) const;
    void set(const char* name, const glm::mat4& value) const;

private:
    unsigned id_ = 0;
};

/// A program of shaders that came with the library, by the names of their files ("lit.vert", "lit.frag").
/// @throws Error::Device as the constructor, or for a name that there is none of.
Program load_program(const std::vector<std::string>& names);

/// The text that the driver compiles: the version, the dialect's macros, and every include in its place, once.
/// @throws Error::Device for an include that there is none of.
std::string expand_shader(const std::string& name, const std::string& text);

} // namespace limn::gpu
