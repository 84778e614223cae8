#pragma once

#include <filesystem>
#include <string>

#include "limn/base/image.h"

namespace limn::test {

/// Mean structural similarity of two pictures of one size, on luminance (Wang et al., Image quality assessment, 2004:
/// Gaussian window of sigma 1.5 and 11 pixels; K1 = 0.01, K2 = 0.03). 1 is equal. Throws when the sizes differ.
double ssim(const Image& a, const Image& b);

/// The lowest mean of that similarity over a square tile of 32 pixels. A page is mostly white, where every drawing is alike; a
/// tile shows a stroke that is missing, however short.
double lowest_tile_ssim(const Image& a, const Image& b);

/// The largest difference of any sample; infinite when sizes differ.
double largest_difference(const Image& a, const Image& b);

/// Both pictures and, at the right, their difference (white: equal), for a person to look at after a failure. The path
/// is under `limn-test-pictures` in the temporary folder; returned for the message.
std::filesystem::path write_difference(const Image& a, const Image& b, const std::string& name);

} // namespace limn::test
