#include "limn/gpu/program.h"

#include <algorithm>
#include <set>
#include <utility>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/gpu/shader_texts.h"

namespace limn::gpu {
namespace {

constexpr const char* prelude = R"(#version 450
#define FORMULA
#define OUT(T) out T
#define INOUT(T) inout T
#define OUT_ARRAY(T, name, n) out T name[n]
#define REAL float
#define REAL2 vec2
#define REAL3 vec3
)";

GLenum gl_stage(Stage stage)
{
    switch (stage) {
    case Stage::vertex: return GL_VERTEX_SHADER;
    case Stage::tess_control: return GL_TESS_CONTROL_SHADER;
    case Stage::tess_evaluation: return GL_TESS_EVALUATION_SHADER;
    case Stage::geometry: return GL_GEOMETRY_SHADER;
    case Stage::fragment: return GL_FRAGMENT_SHADER;
    case Stage::compute: return GL_COMPUTE_SHADER;
    }
    return 0;
}

Stage stage_of(std::string_view name)
{
    const std::pair<std::string_view, Stage> endings[] = {{".vert", Stage::vertex}, {".tesc", Stage::tess_control}, {".tese", Stage::tess_evaluation},
                                                          {".geom", Stage::geometry}, {".frag", Stage::fragment}, {".comp", Stage::compute}};
    for (const auto& [ending, stage] : endings)
        if (name.ends_with(ending))
            return stage;
    throw Error::Device(fmt::format("shader '{}': its name ends in no kind of shader", name));
}

std::string_view find_text(std::string_view path, const std::string& asked_by)
{
    if (const auto text = shader_text(path))
        return *text;
    throw Error::Device(fmt::format("shader '{}': there is no '{}'", asked_by, path));
}

/// The path of an #include line, or "".
std::string_view included_path(std::string_view line)
{
    if (!line.starts_with("#include \""))
        return {};
    const std::string_view rest = line.substr(10);
    return rest.substr(0, rest.find('"'));
}

/// Appends `text` with its includes in place; #line keeps the line numbers of the file that a message is about.
void append_expanded(std::string& out, const std::string& name, std::string_view text, std::set<std::string, std::less<>>& seen)
{
    std::size_t line_number = 0;
    for (std::size_t begin = 0; begin < text.size(); ++line_number) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = text.substr(begin, end - begin);
        begin = end + 1;
        if (line == "#pragma once") {
            out += '\n';
        } else if (const std::string_view path = included_path(line); !path.empty()) {
            if (seen.emplace(path).second) {
                out += "#line 1\n";
                append_expanded(out, std::string(path), find_text(path, name), seen);
            }
            out += fmt::format("#line {}\n", line_number + 2);
        } else {
            out += fmt::format("{}\n", line);
        }
    }
}

/// The first line of what a compiler or linker said.
template <class Length, class Text> std::string first_line(unsigned id, const Length& read_length, const Text& read_text)
{
    GLint length = 0;
    read_length(id, GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(std::max(length, 1)), '\0');
    read_text(id, length, nullptr, log.data());
    return log.substr(0, log.find('\n'));
}

/// A shader that goes with its name.
class Shader {
public:
    explicit Shader(const ShaderText& source) : id_(glCreateShader(gl_stage(source.stage)))
    {
        const std::string text = expand_shader(source.name, source.text);
        const char* pointer = text.c_str();
        glShaderSource(id_, 1, &pointer, nullptr);
        glCompileShader(id_);
        GLint compiled = 0;
        glGetShaderiv(id_, GL_COMPILE_STATUS, &compiled);
        if (!compiled) {
            const std::string log = first_line(id_, glGetShaderiv, glGetShaderInfoLog);
            glDeleteShader(id_);
            throw Error::Device(fmt::format("shader '{}' does not compile: {}", source.name, log));
        }
    }
    ~Shader() { glDeleteShader(id_); }
    Shader(Shader&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Shader& operator=(Shader&&) = delete;
    unsigned id() const { return id_; }

private:
    unsigned id_;
};

} // namespace

std::string expand_shader(const std::string& name, const std::string& text)
{
    std::string out = prelude;
    std::set<std::string, std::less<>> seen;
    out += "#line 1\n";
    append_expanded(out, name, text, seen);
    return out;
}

Program::Program(const std::vector<ShaderText>& sources)
{
    std::vector<Shader> shaders;
    std::string names;
    for (const ShaderText& source : sources) {
        shaders.emplace_back(source);
        names += (names.empty() ? "" : ", ") + source.name;
    }
    id_ = glCreateProgram();
    for (const Shader& shader : shaders)
        glAttachShader(id_, shader.id());
    glLinkProgram(id_);
    GLint linked = 0;
    glGetProgramiv(id_, GL_LINK_STATUS, &linked);
    if (!linked) {
        const std::string log = first_line(id_, glGetProgramiv, glGetProgramInfoLog);
        glDeleteProgram(id_);
        throw Error::Device(fmt::format("shaders {} do not link: {}", names, log));
    }
}

Program::~Program()
{
    if (id_ != 0)
        glDeleteProgram(id_);
}

Program::Program(Program&& other) noexcept : id_(std::exchange(other.id_, 0)) {}

Program& Program::operator=(Program&& other) noexcept
{
    std::swap(id_, other.id_);
    return *this;
}

void Program::use() const { glUseProgram(id_); }
void Program::set(const char* name, float v) const { glProgramUniform1f(id_, glGetUniformLocation(id_, name), v); }
void Program::set(const char* name, int v) const { glProgramUniform1i(id_, glGetUniformLocation(id_, name), v); }
void Program::set(const char* name, unsigned v) const { glProgramUniform1ui(id_, glGetUniformLocation(id_, name), v); }
void Program::set(const char* name, const vec2& v) const { glProgramUniform2f(id_, glGetUniformLocation(id_, name), v.x, v.y); }
void Program::set(const char* name, const vec3& v) const { glProgramUniform3f(id_, glGetUniformLocation(id_, name), v.x, v.y, v.z); }
void Program::set(const char* name, const vec4& v) const { glProgramUniform4f(id_, glGetUniformLocation(id_, name), v.x, v.y, v.z, v.w); }
void Program::set(const char* name, const ivec2& v) const { glProgramUniform2i(id_, glGetUniformLocation(id_, name), v.x, v.y); }
void Program::set(const char* name, const glm::mat4& v) const
{
    glProgramUniformMatrix4fv(id_, glGetUniformLocation(id_, name), 1, GL_FALSE, &v[0][0]);
}

Program load_program(const std::vector<std::string>& names)
{
    std::vector<ShaderText> shaders;
    for (const std::string& name : names)
        shaders.push_back({stage_of(name), name, std::string(find_text("limn/gpu/shaders/" + name, name))});
    return Program(shaders);
}

} // namespace limn::gpu
