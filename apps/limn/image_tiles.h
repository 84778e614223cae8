#pragma once

#include <vector>

#include "limn/base/image.h"

/// Pictures side by side, row by row, with a white gap between them; of one channel and three alike. All are of one size; at least one.
/// @param columns  at least 1
limn::Image tile_images(const std::vector<limn::Image>& images, int columns);
