#pragma once

#include "silhouette_subject.h"

/// How good one way to draw a control mesh's outline is, over many views.
struct OutlineQuality {
    std::string way;
    double vertices = 0;   ///< mean
    double difference = 0; ///< px^2: symmetric difference, mean
    double mean = 0;       ///< px: mean distance, mean
    double most = 0;       ///< px: greatest distance both ways, of all views
};

/// Of the control mesh on the limit surface, uniform levels 1 to `levels` on the limit surface, the seed's silhouette and the exact one, in this
/// order; by masks of 8 x 8 samples a pixel against triangles within 0.03 px of the limit surface. Parallel.
std::vector<OutlineQuality> measure_outlines(const SilhouetteSubject& subject, const std::vector<limn::Camera>& cameras, int levels);

/// The first uniform level (0: the control mesh) whose outline is nowhere further off than asked for, or -1.
/// @param from  what measure_outlines returned
int level_that_reaches(const std::vector<OutlineQuality>& from, int levels, double pixels);
