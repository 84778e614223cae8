#pragma once

#include "shadow_studies.h"

/// Checklist 27: seconds for pictures of an object on a ground under a ball of light, by the samples of the light that a pixel takes, without shadows, by
/// rays and by maps.
/// @param maps  about so many, of resolution x resolution texels
void add_pictures(const ShadowSubject& subject, int maps, int resolution, const std::vector<int>& samples, MarkdownTable& table);

/// Checklist 27: how many segments the seed's lists of the texels hold.
void add_list_lengths(const ShadowSubject& subject, int maps, int resolution, MarkdownTable& table);
