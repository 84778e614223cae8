// Small pictures of every style, kept in tests/golden. A picture may differ from its golden one a little, since other compilers and drivers
// round otherwise; where it differs more, both and their difference are written for a person to look at. LIMN_KEEP_GOLDEN=1 writes the
// pictures anew: look at each before it is committed.

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/base/file.h"
#include "limn/drawing/png.h"
#include "support/image_compare.h"
#include "support/support.h"

namespace limn::test {
namespace {

struct Golden {
    std::string name, command; ///< of `limn`, after the model
};

const std::vector<Golden> goldens = {
    {"smooth", "render"},
    {"flat", "render --shading flat --light 2,-3,5 --lines technical"},
    {"toon", "render --shading toon --toon-levels 3 --lamp 3,-4,6 --lines illustration"},
    {"dark", "render --style dark --surface-colour '#555555' --lines contour,suggestive,highlight"},
    {"ground", "render --ground --lines contour --background '#cfe0f0'"},
    {"orthographic", "render --ortho --ground --view front --surface-colour '#b0c4a0'"},
    {"threshold", "render --image-lines threshold --unlit 1"},
    {"depth-raw", "render --image-lines depth-raw --unlit 1"},
    {"depth", "render --image-lines depth --unlit 1"},
    {"valley-printed", "render --image-lines valley-printed --unlit 1"},
    {"valley", "render --image-lines valley --unlit 1"},
    {"shader-lines-width", "render --shader-lines width --unlit 1"},
    {"shader-lines-texture", "render --shader-lines texture --unlit 1"},
    {"draw-plain", "draw --lines contour,suggestive"},
    {"draw-coloured", "draw --style coloured --lines contour,suggestive,highlight,crease"},
    {"draw-dark", "draw --style dark --lines contour,suggestive,highlight"},
    {"draw-toon", "draw --style toon --lines contour,suggestive,highlight"},
    {"draw-hidden", "draw --hidden dash --lines contour"},
};

class GoldenPictures : public testing::TestWithParam<Golden> {
protected:
    TemporaryFolder folder;
};

TEST_P(GoldenPictures, LookAsTheyDid)
{
    const Golden& golden = GetParam();
    const std::string model = (folder / "blob.ply").string(), picture = (folder / "picture.png").string();
    ASSERT_EQ(run_limn(LIMN_COMMAND, "sample blob --triangles 8000 --quiet -o " + model).exit_code, 0);
    const std::size_t word = golden.command.find(' ');
    const std::string rest = word == std::string::npos ? "" : golden.command.substr(word);
    const ProgramResult result = run_limn(LIMN_COMMAND, golden.command.substr(0, word) + " " + model + rest + " --up-axis z --size 160x120 --device cpu --quiet -o " + picture);
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const std::string kept = std::string(LIMN_GOLDEN) + "/" + golden.name + ".png";
    if (std::getenv("LIMN_KEEP_GOLDEN"))
        write_file(kept, read_file(picture));
    const Image now = read_png(picture), before = read_png(kept);
    ASSERT_EQ(now.size(), before.size());
    double sum = 0;
    for (std::size_t i = 0; i < now.samples.size(); ++i)
        sum += std::abs(double(now.samples[i]) - double(before.samples[i]));
    EXPECT_LE(sum / double(now.samples.size()), 0.5 / 255) << "see " << write_difference(now, before, "golden-" + golden.name);
    EXPECT_GE(lowest_tile_ssim(now, before), 0.97) << "see " << write_difference(now, before, "golden-" + golden.name);
}

INSTANTIATE_TEST_SUITE_P(Styles, GoldenPictures, testing::ValuesIn(goldens), [](const auto& about) {
    std::string name = about.param.name;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

} // namespace
} // namespace limn::test
