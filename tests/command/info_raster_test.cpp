#include <gtest/gtest.h>

#include "command/command.h"
#include "limn/base/file.h"

namespace limn::test {
namespace {

class InfoOfRaster : public WithTorus {
protected:
    InfoOfRaster()
    {
        // Steps of three seconds of arc, one sample without data.
        write_text(
            folder_ / "a.asc",
            "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 46\ncellsize 0.0008333333333333334\nNODATA_value -9999\n1 2 3.5\n4 -9999 6\n");
    }
};

TEST_F(InfoOfRaster, TellsSizePlaceAndHeights)
{
    const ProgramResult result = limn("info --quiet --crs EPSG:4326 " + path("a.asc"));
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(result.errors, "");
    for (const char* line :
         {"columns         3\n", "rows            2\n", "system          WGS 84\n", "heights         1 to 6 m, mean 3.3 m\n",
          "no data         1 sample\n", "origin          10.00041667, 46.00041667 (south-western sample)\n",
          "notes           steps of 0.00083333333 x 0.00083333333 degree converted to 64.5518 x 92.6261 m, at latitude 46.0008 degrees\n"})
        EXPECT_NE(result.output.find(line), std::string::npos) << line << result.output;
}

TEST_F(InfoOfRaster, TellsTheSameAsJson)
{
    const nlohmann::json json = nlohmann::json::parse(limn("info --quiet --json " + path("a.asc")).output)["raster"];
    EXPECT_EQ(json["columns"], 3);
    EXPECT_EQ(json["no_data"], 1);
    EXPECT_EQ(json["heights"]["highest"], 6.0);
    EXPECT_EQ(json["system"], "");
    EXPECT_NE(json["notes"][0].get<std::string>().find("if they are degrees, say --crs EPSG:4326"), std::string::npos);
}

TEST_F(InfoOfRaster, KnowsRastersFromMeshes)
{
    EXPECT_NE(limn("info " + torus()).output.find("triangles"), std::string::npos);
    EXPECT_EQ(limn("info --from asc - < " + path("a.asc")).exit_code, 0);
    std::filesystem::copy_file(path("a.asc"), path("a"));
    EXPECT_NE(limn("info " + path("a")).output.find("columns         3"), std::string::npos);
    const ProgramResult missing = limn("info " + path("b.tif"));
    EXPECT_EQ(missing.exit_code, 1);
    EXPECT_EQ(missing.errors, "limn: " + path("b.tif") + ": cannot be opened: No such file or directory\n");
    write_text(folder_ / "c.tif", "no raster");
    const ProgramResult wrong = limn("info " + path("c.tif"));
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_EQ(wrong.errors, "limn: " + path("c.tif") + ": is no raster that GDAL knows\n");
    const ProgramResult crs = limn("info --crs nonsense " + path("a.asc"));
    EXPECT_EQ(crs.exit_code, 2);
    EXPECT_NE(crs.errors.find("--crs: 'nonsense' is no coordinate system"), std::string::npos) << crs.errors;
}

} // namespace
} // namespace limn::test
