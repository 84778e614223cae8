#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/camera/camera.h"

namespace limn {
namespace {

TEST(CameraJson, RoundTripsEveryFieldExactly)
{
    Camera camera;
    camera.eye = {0.1, -2.0 / 3, 1e-17};
    camera.look = {1e9, 3, 5};
    camera.up = {0, 0.6, 0.8};
    camera.fov_degrees = 33.3;
    camera.orthographic = true;
    camera.ortho_height = 0.7;
    camera.size = {333, 77};
    const Camera read = camera_from_json(camera_to_json(camera));
    EXPECT_EQ(read.eye, camera.eye);
    EXPECT_EQ(read.look, camera.look);
    EXPECT_EQ(read.up, camera.up);
    EXPECT_EQ(read.fov_degrees, camera.fov_degrees);
    EXPECT_EQ(read.orthographic, camera.orthographic);
    EXPECT_EQ(read.ortho_height, camera.ortho_height);
    EXPECT_EQ(read.size, camera.size);
}

TEST(CameraJson, ReadsTheCameraInsideAReport)
{
    const Camera camera = camera_from_json(R"({"time": 3, "camera": {"eye": [1, 2, 3], "look": [0, 0, 0]}})");
    EXPECT_EQ(camera.eye, dvec3(1, 2, 3));
    EXPECT_EQ(camera.fov_degrees, Camera().fov_degrees);
}

TEST(CameraJson, NamesTheKeyThatIsWrong)
{
    const std::pair<const char*, const char*> cases[] = {
        {R"({"look": [0, 0, 0]})", "'eye' is missing"},
        {R"({"eye": [1, 2, 3]})", "'look' is missing"},
        {R"({"eye": [1, 2, 3], "look": [0, 0, 0], "fow": 3})", "'fow'"},
        {R"({"eye": [1, 2], "look": [0, 0, 0]})", "'eye' is [1,2]"},
        {R"({"eye": [1, 2, "3"], "look": [0, 0, 0]})", "'eye'"},
        {R"({"eye": [1, 2, 1e999], "look": [0, 0, 0]})", "too large"},
        {R"({"eye": [1, 2, 3], "look": [0, 0, 0], "fov_degrees": 180})", "'fov_degrees' is 180"},
        {R"({"eye": [1, 2, 3], "look": [0, 0, 0], "fov_degrees": null})", "'fov_degrees'"},
        {R"({"eye": [1, 2, 3], "look": [0, 0, 0], "ortho_height": 0})", "'ortho_height'"},
        {R"({"eye": [1, 2, 3], "look": [0, 0, 0], "orthographic": 1})", "'orthographic'"},
        {R"({"eye": [1, 2, 3], "look": [0, 0, 0], "size": [0, 10]})", "'size'"},
        {R"({"eye": [1, 2, 3], "look": [0, 0, 0], "size": [10.5, 10]})", "'size'"},
        {R"({"eye": [1, 2, 3], "look": [0, 0, 0], "up": [0, 0, 0]})", "'up'"},
        {R"({"eye": [1, 2, 3], "look": [1, 2, 3]})", "'look'"},
        {R"({"eye": [1e-200, 0, 0], "look": [0, 0, 0]})", "'look'"}, // no direction in double precision
        {R"({"eye": [1e300, 0, 0], "look": [0, 0, 0]})", "'eye' is farther"},
        {R"([1, 2])", "expected an object"},
        {"{\n\"eye\": [1, 2,, 3]}", "line 2"},
        {"", "line 1"},
    };
    for (const auto& [text, expected] : cases) {
        try {
            camera_from_json(text);
            ADD_FAILURE() << "accepted: " << text;
        } catch (const Error::Input& error) {
            EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << text << ": " << error.what();
        }
    }
}

} // namespace
} // namespace limn
