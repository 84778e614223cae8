#pragma once

#include "silhouette_subject.h"

/// Milliseconds of the search for crossings along all edges, the median over views, and what was searched.
struct SearchTimes {
    std::size_t edges = 0;
    double seed_crossed = 0, exact_crossed = 0; ///< edges, mean
    double seed = 0, exact = 0;                 ///< ms
};
/// In as many threads as the caller lets it have.
SearchTimes time_search(const SilhouetteSubject& subject, const std::vector<limn::Camera>& cameras);

/// Milliseconds of the seed's search: of the points that bisection asks for, and of all points as the seed does.
struct DepthTimes {
    int depth = 0;
    double bisected = 0, all = 0;
};
std::vector<DepthTimes> time_depths(const SilhouetteSubject& subject, const std::vector<limn::Camera>& cameras);

/// Milliseconds of whole silhouettes by the number of pieces of a curve in a face.
struct CurveTimes {
    int points = 0;
    double seed = 0, exact = 0;                     ///< ms
    double seed_triangles = 0, exact_triangles = 0; ///< mean
};
std::vector<CurveTimes> time_curves(const SilhouetteSubject& subject, const std::vector<limn::Camera>& cameras);
