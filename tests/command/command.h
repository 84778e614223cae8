#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "limn/surface/shapes.h"
#include "support/support.h"

namespace limn::test {

/// Runs `limn` with arguments as a shell would split them.
inline ProgramResult limn(const std::string& arguments) { return run_limn(LIMN_COMMAND, arguments); }

/// A mesh as OBJ text.
inline std::string obj_text(const Mesh& mesh)
{
    std::string text;
    for (const dvec3& p : mesh.positions)
        text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    for (const uvec3& t : mesh.triangles)
        text += fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
    return text;
}

inline std::string shape_obj(const std::string& name, std::size_t triangles) { return obj_text(make_shape({.name = name, .triangles = triangles}).mesh); }

/// A temporary folder with a closed torus in it.
class WithTorus : public testing::Test {
protected:
    WithTorus() { write_text(folder_ / "torus.obj", shape_obj("torus", 2000)); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string torus() const { return path("torus.obj"); }
    bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
    /// Names of all files in the folder, in order.
    std::vector<std::string> files() const
    {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
            names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    }

    TemporaryFolder folder_;
};

/// How many lines a text has.
inline long line_count(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

} // namespace limn::test
