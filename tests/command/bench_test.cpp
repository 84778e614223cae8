#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/support.h"

namespace limn::test {
namespace {

TEST(Bench, WritesATableForEveryModelAndReplacesOnlyItsSection)
{
    const TemporaryFolder folder;
    write_text(folder / "bench.md", "# Speed\n\n<!-- begin other -->\nkept\n<!-- end other -->\n");
    const std::string arguments = "bench lines --sizes 2k,4k --models torus,sphere --views 2 --quiet -o " + (folder / "bench.md").string();
    for (int run = 0; run < 2; ++run) {
        const ProgramResult result = run_limn(LIMN_COMMAND, arguments);
        ASSERT_EQ(result.exit_code, 0) << result.errors;
    }
    const std::string text = read_text(folder / "bench.md");
    EXPECT_TRUE(text.starts_with("# Speed\n\n<!-- begin other -->\nkept\n<!-- end other -->\n"));
    for (const char* once : {"<!-- begin lines -->", "<!-- end lines -->", "### torus", "### sphere", "## Lines"}) {
        const std::size_t at = text.find(once);
        ASSERT_NE(at, std::string::npos) << once;
        EXPECT_EQ(text.find(once, at + 1), std::string::npos) << once;
    }
}

TEST(Bench, JsonHoldsTheTablesRowByRow)
{
    const TemporaryFolder folder;
    const std::string arguments = "bench lines --sizes 2k,4k --models torus --views 1 --device cpu --strict --quiet ";
    const ProgramResult result = run_limn(LIMN_COMMAND, arguments + "--json");
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(run_limn(LIMN_COMMAND, arguments + "-o " + (folder / "bench.data").string() + " --to json").exit_code, 0);
    for (const std::string& text : {result.output, read_text(folder / "bench.data")}) {
        const nlohmann::json models = nlohmann::json::parse(text)["models"];
        ASSERT_EQ(models.size(), 1u);
        for (const char* table : {"extraction_ms", "views_ms", "runs_s"}) {
            ASSERT_EQ(models[0][table].size(), 2u) << table;
            EXPECT_TRUE(models[0][table][1].contains("triangles")) << table;
        }
    }
}

TEST(Bench, MeasuresEveryMethodOfPicturesBesideTheStudy)
{
    const std::string arguments = "bench render --sizes 1k --models torus --views 1 --edges 32,64 --runs 1 --quiet --json";
    const ProgramResult result = run_limn(LIMN_COMMAND, arguments);
    if (result.exit_code == 1 && result.errors.find("no GPU driver") != std::string::npos)
        GTEST_SKIP() << result.errors;
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const auto json = nlohmann::json::parse(result.output);
    for (const char* table : {"fps", "stages_ms", "threshold_us", "picture_sizes_fps", "processes"})
        EXPECT_GE(json.at(table).size(), 2u) << table;
    for (const char* method : {"M1 + M3", "M2 + M3", "M3", "M5", "M6", "M7", "M8", "M9", "M10", "lit picture"}) {
        const bool found = std::any_of(json["fps"].begin(), json["fps"].end(), [&](const auto& row) { return row["method"].template get<std::string>().starts_with(method); });
        EXPECT_TRUE(found) << method;
    }
    for (const auto& row : json["processes"])
        EXPECT_LT(std::stod(row["memory (MB)"].get<std::string>()), 1000) << row.dump();
    EXPECT_EQ(run_limn(LIMN_COMMAND, "bench render --models torus,blob").exit_code, 2);
}

// Checklist item 26 of the contour-lines specification: every method per pixel against the lines of the objects' space.
TEST(Bench, AgreementHoldsEveryMethodOnShapesAndFiles)
{
    const TemporaryFolder folder;
    ASSERT_EQ(run_limn(LIMN_COMMAND, "sample blob --triangles 20000 --quiet -o " + (folder / "b.ply").string()).exit_code, 0);
    const ProgramResult result =
        run_limn(LIMN_COMMAND, "bench agreement --sizes 20k --views 2 --edges 256 --quiet --json --models rings," + (folder / "b.ply").string());
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const nlohmann::json report = nlohmann::json::parse(result.output);
    ASSERT_EQ(report["models"].size(), 2u);
    EXPECT_EQ(report["models"][1]["model"], "b.ply");
    for (const nlohmann::json& model : report["models"]) {
        ASSERT_EQ(model["methods"].size(), 7u);
        for (const nlohmann::json& method : model["methods"]) {
            EXPECT_GT(method["precision"], 0.5) << method;
            EXPECT_GT(method["recall"], 0.3) << method;
            EXPECT_LT(method["chamfer_px"], 10) << method;
        }
        // What sees the surface's curvature finds both kinds of line; what sees depth finds contours.
        EXPECT_GT(model["methods"][1]["f1"], 0.95) << model["methods"][1];
        EXPECT_GE(model["methods"][1]["recall"], model["methods"][4]["recall"]);
    }
    const ProgramResult unknown = run_limn(LIMN_COMMAND, "bench agreement --models nothing.ply --quiet");
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_NE(unknown.errors.find("nothing.ply"), std::string::npos) << unknown.errors;
}

TEST(Bench, SubdivisionGoesDownFiveLevelsAndUpTheSizes)
{
    const ProgramResult result = run_limn(LIMN_COMMAND, "bench subdivision --sizes 100,400 --models sphere --runs 1 --quiet --json");
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const nlohmann::json report = nlohmann::json::parse(result.output);
    EXPECT_EQ(report["model"], "sphere");
    for (const char* table : {"cold_ms", "pose_ms", "limit_ms"}) {
        const nlohmann::json& rows = report.at(table);
        ASSERT_EQ(rows.size(), 6u) << table;
        const char* const triangles[] = {"320", "1,280", "5,120", "20,480", "81,920", "20,480"}; // of spheres of 80 and 320
        for (std::size_t i = 0; i < rows.size(); ++i) {
            EXPECT_EQ(rows[i]["levels"], i < 5 ? std::to_string(i + 1) : "3") << table;
            EXPECT_EQ(rows[i]["triangles"], triangles[i]) << table;
        }
        EXPECT_GT(std::stod(rows[4][std::string(table) == "limit_ms" ? "limn once" : "limn"].get<std::string>()), 0) << rows[4];
    }
    EXPECT_EQ(run_limn(LIMN_COMMAND, "bench subdivision --models torus,blob --quiet").exit_code, 2);
}

TEST(Bench, HoldsSilhouettesBesideUniformLevels)
{
    const ProgramResult result = run_limn(LIMN_COMMAND, "bench silhouette --models octahedron,leaf --sizes 100,300 --views 2 --edges 32,64 --quiet --json");
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const nlohmann::json report = nlohmann::json::parse(result.output);
    ASSERT_EQ(report["outlines"].size(), 2u * 7);
    const auto most = [&](std::size_t row) { return std::stod(report["outlines"][row]["most (px)"].get<std::string>()); };
    for (const std::size_t first : {0u, 7u}) {
        EXPECT_EQ(report["outlines"][first + 6]["way"], "exact");
        EXPECT_LE(most(first + 6), 0.6);
        EXPECT_LT(most(first + 1), most(first));     // level 1 and the control mesh
        EXPECT_LT(most(first + 6), most(first + 5)); // exact and seed
    }
    EXPECT_EQ(report["vertices"].size(), 2u);
    for (const char* table : {"search", "depths_ms", "curves_ms", "propagation_ms"})
        EXPECT_GE(report[table].size(), 4u) << table;
    if (!report["frames_ms"].empty()) { // there is a device
        EXPECT_EQ(report["frames_ms"].size(), 2u);
        EXPECT_EQ(report["parts_ms"].size(), 2u * 6);
    }
    EXPECT_EQ(run_limn(LIMN_COMMAND, "bench silhouette --models nothing").exit_code, 2);
}

/// Checklist 1 of the terrain specification by way of the command: what strict meshes of terrain G have.
TEST(Bench, CountsTrianglesOfTerrain)
{
    const ProgramResult result = run_limn(LIMN_COMMAND, "bench terrain --models reference,spike --bounds 16,4 --sizes 100,129 --views 20 --runs 1 --quiet --json");
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const nlohmann::json report = nlohmann::json::parse(result.output), &rows = report["triangles"];
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0]["strict"], "14,611");
    EXPECT_EQ(rows[1]["strict"], "61,085");
    EXPECT_LE(report["worst_share_of_bound"].get<double>(), 1);
    EXPECT_EQ(report["mesh_ms"].size(), 4u);
    EXPECT_EQ(report["set_up_ms"].size(), 2u);
    EXPECT_EQ(report["prepared_ms"][0]["samples"], "100 x 100");
    EXPECT_EQ(report["flight_ms"].size(), 5 * report["prepared_ms"].size() / 2);
    for (const nlohmann::json& row : rows)
        if (row["RTIN"] != "-") { // the peer is there
            EXPECT_LE(std::stod(row["strict/RTIN"].get<std::string>()), 1.05) << row;
        }
    EXPECT_EQ(run_limn(LIMN_COMMAND, "bench terrain --models nothing.tif --quiet").exit_code, 1);
    EXPECT_EQ(run_limn(LIMN_COMMAND, "bench terrain --sizes 1M --quiet").exit_code, 2);
}

TEST(Bench, NamesWhatItCannotMeasure)
{
    const ProgramResult unknown = run_limn(LIMN_COMMAND, "bench cheese");
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_NE(unknown.errors.find("cheese"), std::string::npos);
    const ProgramResult size = run_limn(LIMN_COMMAND, "bench lines --sizes many");
    EXPECT_EQ(size.exit_code, 2);
    EXPECT_NE(size.errors.find("many"), std::string::npos);
}

} // namespace
} // namespace limn::test
