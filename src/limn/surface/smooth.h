#pragma once

#include <span>

#include "limn/surface/neighbours.h"
#include "limn/surface/surface.h"

namespace limn {

/// Replaces the normals (unit, or 0 to keep the old one) and carries the principal directions along by the smallest turn.
void replace_normals(Surface& surface, std::span<const dvec3> normals);

/// One-ring smoothing passes for each quantity. Smoothed normals belong to the centre of the neighbourhood instead of the
/// vertex: right for noisy positions, worse than none for exact positions that are sampled irregularly.
struct SmoothPasses {
    int normals = 0, curvature = 0, derivative = 0;
};

/// Each pass replaces a quantity by the mean over the vertex and its neighbours, weighted by their areas, after carrying
/// tensors into the vertex's frame by the smallest turn of the normals. Vertices flagged as unreliable give nothing and
/// receive from the others; a vertex without any weight around it stays as it is.
/// @param areas  one for each vertex (vertex_areas)
void smooth_surface(Surface& surface, const Neighbours& neighbours, std::span<const double> areas, const SmoothPasses& passes);

} // namespace limn
