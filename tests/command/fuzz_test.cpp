#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <regex>

#include "command/command.h"
#include "limn/base/error.h"
#include "limn/drawing/svg.h"
#include "limn/geometry/read_mesh.h"
#include "limn/geometry/write_mesh.h"
#include "limn/lines/draw.h"
#include "limn/lines/prepare.h"

namespace limn::test {
namespace {

/// Triangles that have nothing to do with each other, with shared, equal, flat and infinite ones among them.
Mesh random_soup(std::uint32_t seed)
{
    std::mt19937 random(seed);
    const auto below = [&](std::uint32_t n) { return std::uint32_t(random() % n); };
    Mesh mesh;
    const std::uint32_t vertices = 3 + below(60), faces = 1 + below(120);
    for (std::uint32_t i = 0; i < vertices; ++i) {
        // A coarse grid, so that points and whole triangles coincide.
        dvec3 p(below(9), below(9), below(9));
        if (seed % 3 == 0)
            p += dvec3(below(1000), below(1000), below(1000)) * 1e-3;
        if (seed % 7 == 0 && below(40) == 0)
            p.x = std::numeric_limits<double>::quiet_NaN();
        if (seed % 11 == 0 && below(40) == 0)
            p.y = 1e300;
        mesh.positions.push_back(p);
    }
    for (std::uint32_t i = 0; i < faces; ++i)
        mesh.triangles.push_back({below(vertices), below(vertices), below(vertices)});
    return mesh;
}

/// Not inlined: g++ 12 takes the members of a default-made one for uninitialised.
[[gnu::noinline]] LineOptions usual_lines() { return {}; }

LineOptions every_line()
{
    LineOptions options = usual_lines();
    line_option_table().front().set(options, "all,mesh-contour");
    return options;
}

/// Draws a mesh as the command does, in memory.
std::string draw_svg(const Mesh& mesh, const LineOptions& options)
{
    const PreparedMesh prepared = prepare_mesh(mesh);
    const PlacedSurface placed = prepared.placed();
    const LineModel model = build_line_model({&placed, 1});
    const Camera camera = Camera::framing(mesh.bounds(), {.size = {160, 120}});
    return to_svg(draw_lines(model, build_ray_scene(model), camera, options));
}

/// "" for a drawing, the error's message otherwise.
std::string try_file(const std::filesystem::path& path)
{
    try {
        const ReadResult read = read_mesh_with_notes(path);
        const LineOptions usual = usual_lines();
        EXPECT_NE(draw_svg(read.mesh, usual).find("</svg>"), std::string::npos);
        return "";
    } catch (const Error::Read& error) {
        return error.what();
    }
}

// Checklist item 1 of the contour-lines specification.
TEST(Fuzz, AThousandTriangleSoupsGiveADrawing)
{
    const TemporaryFolder folder;
    const LineOptions usual = usual_lines(), every = every_line();
    int drawings = 0;
    for (std::uint32_t seed = 1; seed <= 1000; ++seed) {
        SCOPED_TRACE(fmt::format("seed {}", seed));
        write_text(folder / "soup.obj", obj_text(random_soup(seed)));
        try {
            const ReadResult read = read_mesh_with_notes(folder / "soup.obj");
            ASSERT_NE(draw_svg(read.mesh, seed % 4 == 0 ? every : usual).find("</svg>"), std::string::npos);
            ++drawings;
        } catch (const Error::Read& error) { // only where every face uses a point that is nowhere
            ASSERT_NE(std::string(error.what()).find("face"), std::string::npos) << error.what();
        }
    }
    EXPECT_GT(drawings, 980);
}

TEST(Fuzz, TheCommandDrawsSoupsAndSaysWhatIsUnclean)
{
    const TemporaryFolder folder;
    for (std::uint32_t seed = 1001; seed <= 1020; ++seed) {
        write_text(folder / "soup.obj", obj_text(random_soup(seed)));
        const ProgramResult result = limn(fmt::format("draw {0}/soup.obj -o {0}/{1}.svg --size 160x120 --quiet", folder.path().string(), seed));
        EXPECT_EQ(result.exit_code, 0) << "seed " << seed << ": " << result.errors;
        EXPECT_EQ(line_count(result.errors), 1) << "seed " << seed << ": " << result.errors;
        EXPECT_NE(read_text(folder / fmt::format("{}.svg", seed)).find("</svg>"), std::string::npos) << "seed " << seed;
    }
}

/// The same torus in every format that Limn reads itself.
std::vector<std::pair<std::string, std::string>> torus_files()
{
    const Mesh mesh = make_shape({.name = "torus", .triangles = 400}).mesh;
    const auto append = [](std::string& bytes, const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    std::string ply = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
                                  "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                                  mesh.positions.size(), mesh.triangles.size());
    for (const dvec3& p : mesh.positions)
        append(ply, vec3(p));
    for (const uvec3& t : mesh.triangles) {
        append(ply, std::uint8_t(3));
        append(ply, t);
    }
    std::string stl(80, ' ');
    append(stl, std::uint32_t(mesh.triangles.size()));
    for (const uvec3& t : mesh.triangles) {
        append(stl, vec3(0));
        for (int k = 0; k < 3; ++k)
            append(stl, vec3(mesh.positions[t[k]]));
        append(stl, std::uint16_t(0));
    }
    std::string off = fmt::format("OFF\n{} {} 0\n", mesh.positions.size(), mesh.triangles.size());
    for (const dvec3& p : mesh.positions)
        off += fmt::format("{} {} {}\n", p.x, p.y, p.z);
    for (const uvec3& t : mesh.triangles)
        off += fmt::format("3 {} {} {}\n", t.x, t.y, t.z);
    const TemporaryFolder folder;
    write_mesh(mesh, folder / "torus.glb");
    return {{"obj", obj_text(mesh)}, {"ply", ply}, {"stl", stl}, {"off", off}, {"glb", read_text(folder / "torus.glb")}};
}

constexpr int broken_files = 200; ///< of each kind

/// Files cut anywhere, then files with one to eight flipped bits: the ending and the bytes of each.
std::vector<std::pair<std::string, std::string>> cut_files()
{
    std::mt19937 random(1);
    const auto models = torus_files();
    std::vector<std::pair<std::string, std::string>> files;
    for (int i = 0; i < broken_files; ++i) {
        const auto& [ending, whole] = models[std::size_t(i) % models.size()];
        files.emplace_back(ending, whole.substr(0, random() % whole.size()));
    }
    return files;
}

std::vector<std::pair<std::string, std::string>> flipped_files()
{
    std::mt19937 random(2);
    const auto models = torus_files();
    std::vector<std::pair<std::string, std::string>> files;
    for (int i = 0; i < broken_files; ++i) {
        auto [ending, bytes] = models[std::size_t(i) % models.size()];
        // Half of the damage to the head, where the claims are.
        for (int flips = 1 + int(random() % 8); flips > 0; --flips) {
            const std::size_t range = random() % 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 400);
            bytes[random() % range] ^= char(1 << random() % 8);
        }
        files.emplace_back(ending, bytes);
    }
    return files;
}

/// A refusal is one line that names the file and a place in it, or says what its size has to do with it.
void expect_names_file_and_place(const std::string& message, const std::string& file)
{
    static const std::regex place("(line|byte|accessor|buffer|buffer view|mesh|node) [0-9]+|its [0-9]+ bytes|is empty");
    EXPECT_EQ(message.rfind(file + ": ", 0), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_TRUE(std::regex_search(message.substr(std::min(message.size(), file.size())), place)) << message;
}

TEST(Fuzz, TruncatedFilesAreRefusedByNameAndPlaceOrDrawn)
{
    const TemporaryFolder folder;
    for (const auto& [ending, bytes] : cut_files()) {
        const std::filesystem::path file = folder / ("cut." + ending);
        write_text(file, bytes);
        const std::string message = try_file(file);
        // Text has no stated length: what was cut between two lines is a smaller model.
        EXPECT_TRUE(ending == "obj" || !message.empty()) << ending << " cut to " << bytes.size() << " bytes was drawn";
        if (!message.empty())
            expect_names_file_and_place(message, file.string());
    }
}

TEST(Fuzz, FilesWithFlippedBytesAreRefusedByNameAndPlaceOrDrawn)
{
    const TemporaryFolder folder;
    int refused = 0;
    for (const auto& [ending, bytes] : flipped_files()) {
        const std::filesystem::path file = folder / ("flipped." + ending);
        write_text(file, bytes);
        if (const std::string message = try_file(file); !message.empty()) {
            expect_names_file_and_place(message, file.string());
            ++refused;
        }
    }
    EXPECT_GT(refused, broken_files / 4);
}

TEST(Fuzz, TheCommandDrawsBrokenFilesOrRefusesThemAndLeavesNothing)
{
    const TemporaryFolder folder;
    const auto cut = cut_files(), flipped = flipped_files();
    for (std::size_t i = 0; i < 60; ++i) { // 3 is no divisor of the number of formats
        const auto& [ending, bytes] = (i % 2 ? cut : flipped)[3 * i];
        const std::string in = (folder / ("broken." + ending)).string(), out = (folder / "out.svg").string();
        write_text(in, bytes);
        const ProgramResult result = limn("draw " + in + " -o " + out + " --size 160x120 --quiet");
        ASSERT_TRUE(result.exit_code == 0 || result.exit_code == 1) << result.exit_code << ": " << result.errors;
        if (result.exit_code == 0) {
            EXPECT_NE(read_text(out).find("</svg>"), std::string::npos);
        } else {
            ASSERT_EQ(result.errors.rfind("limn: ", 0), 0u) << result.errors;
            expect_names_file_and_place(result.errors.substr(6, result.errors.size() - 7), in);
            EXPECT_FALSE(std::filesystem::exists(out));
        }
        std::filesystem::remove(in);
        std::filesystem::remove(out);
        EXPECT_TRUE(std::filesystem::is_empty(folder.path())); // nothing half written either
    }
}

} // namespace
} // namespace limn::test
