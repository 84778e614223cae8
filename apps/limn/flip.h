#pragma once

#include "limn/base/image.h"

/// How different two pictures look where one flips between them: LDR-FLIP (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild 2020, "FLIP: a
/// difference evaluator for alternating images"), its mean over the pixels, in [0,1]; 0 is equal.
/// @param a, b  encoded (sRGB) RGB in [0,1], of one size
/// @param pixels_per_degree  of the eye; the authors' monitor by default: 0.7 m away, 0.7 m and 3840 pixels wide
/// @throws limn::Error::Input for pictures of several sizes
double flip(const limn::Image& a, const limn::Image& b, double pixels_per_degree = 67.0206);
