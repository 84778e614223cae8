#pragma once

#include <filesystem>
#include <vector>

#include "console.h"

/// Checklist 26: the figures that the thesis on coherent shadow maps has, of generated shapes, as PNG files in a folder, which is made: shadows on a floor by number of
/// maps and texels, and their errors tenfold; a hard and an easy scene; means of several texels; both layers of depth; maps as they are decoded; which texels compress
/// well; and numbers of maps beside each other. The same bytes in each run.
/// @param maps, resolutions  ascending, not empty
void write_shadow_figures(const std::filesystem::path& folder, const std::vector<int>& maps, const std::vector<int>& resolutions, Console& console);
