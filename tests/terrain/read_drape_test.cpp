#include "limn/terrain/read_drape.h"

#include <cmath>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/terrain/read_height_map.h"
#include "support/support.h"
#include "terrain/rasters.h"

namespace limn::test {
namespace {

constexpr double west = 400000, north = 3800000, step = 30; // of the map, UTM zone 11N

class ReadDrape : public testing::Test {
protected:
    ReadDrape()
    {
        RasterFile file;
        file.system = "EPSG:32611";
        file.transform = {{west, step, 0, north, 0, -step}};
        write_raster(map_file(), file);
        map_ = read_height_map(map_file());
    }
    std::filesystem::path map_file() const { return folder_ / "map.tif"; }
    std::filesystem::path image_file() const { return folder_ / "image.tif"; }
    Drape read(const RasterFile& image, const std::string& format = "GTiff")
    {
        write_raster(image_file(), image, format);
        return read_drape(image_file(), map_, map_file());
    }
    const HeightMap& map() const { return map_; }

private:
    TemporaryFolder folder_;
    HeightMap map_;
};

/// An RGB image of 80 x 60, twice as fine as the map: red for its columns, green for its rows.
RasterFile ramps()
{
    RasterFile image;
    image.columns = 80, image.rows = 60, image.bands = 3, image.type = GDT_Byte;
    image.number = [](int x, int y, int band) { return band == 1 ? 3 * x : band == 2 ? 4 * y : 7; };
    return image;
}

void expect_pixel(const Image& image, int x, int y, const vec4& bytes)
{
    for (int k = 0; k < 4; ++k)
        EXPECT_NEAR(255 * image.at(x, y)[k], bytes[k], 0.01) << x << "," << y << " " << k;
}

TEST_F(ReadDrape, StretchesImagesWithoutAGeoreference)
{
    for (const std::string format : {"GTiff", "PNG"}) {
        const Drape drape = read(ramps(), format);
        ASSERT_EQ(drape.colours.size(), ivec2(80, 60));
        EXPECT_NE(drape.note.find("is stretched over the map"), std::string::npos);
        expect_pixel(drape.colours, 0, 0, {0, 0, 7, 255});
        expect_pixel(drape.colours, 79, 59, {237, 236, 7, 255});
    }
}

TEST_F(ReadDrape, PutsImagesOfTheMapsSystemInTheirPlace)
{
    RasterFile image = ramps();
    image.system = "EPSG:32611";
    image.transform = {{west, step / 2, 0, north, 0, -step / 2}};
    const Drape same = read(image);
    EXPECT_NE(same.note.find("lies where its georeference says"), std::string::npos);
    ASSERT_EQ(same.colours.size(), ivec2(80, 60));
    for (const ivec2& p : {ivec2(0, 0), {79, 59}, {31, 17}})
        expect_pixel(same.colours, p.x, p.y, {3 * p.x, 4 * p.y, 7, 255});
    // Moved east by half of the map, and without a system: the map's.
    image.system = "";
    image.transform = {{west + 20 * step, step / 2, 0, north, 0, -step / 2}};
    const Drape east = read(image);
    ASSERT_EQ(east.colours.size(), ivec2(80, 60));
    expect_pixel(east.colours, 39, 20, {0, 0, 0, 0});
    expect_pixel(east.colours, 41, 20, {3, 80, 7, 255});
    // Rows that run north.
    image.transform = {{west, step / 2, 0, north - 60 * step / 2, 0, step / 2}};
    expect_pixel(read(image).colours, 10, 0, {30, 4 * 59, 7, 255});
    image.transform = {{west + 1e5, step / 2, 0, north, 0, -step / 2}};
    EXPECT_THROW(read(image), Error::Read);
}

/// Red counts degrees of longitude: it must be what PROJ says of each place of the map.
TEST_F(ReadDrape, BringsImagesFromOtherSystems)
{
    OGRSpatialReference utm, degrees;
    utm.importFromEPSG(32611), degrees.importFromEPSG(4326);
    utm.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER), degrees.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const std::unique_ptr<OGRCoordinateTransformation> change(OGRCreateCoordinateTransformation(&utm, &degrees));
    double x = west, y = north;
    ASSERT_TRUE(change->Transform(1, &x, &y));
    const double left = x - 0.002, top = y + 0.002, pixel = 1e-4;
    RasterFile image;
    image.columns = 200, image.rows = 150, image.bands = 3, image.type = GDT_UInt16;
    image.system = "EPSG:4326";
    image.transform = {{left, pixel, 0, top, 0, -pixel}};
    image.number = [](int column, int row, int band) { return band == 1 ? 300 * column : band == 2 ? 400 * row : 0; };
    const Drape drape = read(image);
    const ivec2 size = drape.colours.size();
    EXPECT_NEAR(size.x, 40 * step / (pixel * 111320 * std::cos(glm::radians(y))), 2);
    for (int row = 0; row < size.y; row += 7)
        for (int column = 0; column < size.x; column += 7) {
            x = west + 40 * step * (column + 0.5) / size.x, y = north - 30 * step * (row + 0.5) / size.y;
            ASSERT_TRUE(change->Transform(1, &x, &y));
            EXPECT_NEAR(65535 * drape.colours.at(column, row)[0], 300 * ((x - left) / pixel - 0.5), 3); // a hundredth of a pixel
            EXPECT_NEAR(65535 * drape.colours.at(column, row)[1], 400 * ((top - y) / pixel - 0.5), 4);
        }
}

TEST_F(ReadDrape, TakesGreyAndTransparency)
{
    RasterFile image = ramps();
    image.bands = 1;
    expect_pixel(read(image).colours, 20, 5, {60, 60, 60, 255});
    image.bands = 4;
    image.number = [](int, int, int band) { return 10 * (band - 1); };
    expect_pixel(read(image).colours, 20, 5, {0, 10, 20, 30});
}

TEST_F(ReadDrape, RefusesWhatIsNoImage)
{
    RasterFile image = ramps();
    image.type = GDT_Float32;
    EXPECT_THROW(read(image), Error::Read);
    image.type = GDT_Byte, image.bands = 5;
    EXPECT_THROW(read(image), Error::Read);
    write_text(image_file(), "no image");
    EXPECT_THROW(read_drape(image_file(), map(), map_file()), Error::Read);
    EXPECT_THROW(read_drape(map_file().parent_path() / "none.png", map(), map_file()), Error::Read);
}

} // namespace
} // namespace limn::test
