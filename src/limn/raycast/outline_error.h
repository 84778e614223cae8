#pragma once

#include <cstdint>
#include <vector>

#include "limn/camera/camera.h"
#include "limn/geometry/mesh.h"

namespace limn {

/// Which samples of a picture a mesh covers: a grid of them in each pixel.
struct OutlineMask {
    ivec2 size = ivec2(0);  ///< samples
    int per_pixel = 1;      ///< samples along a pixel's edge
    std::vector<std::uint64_t> bits; ///< row by row from the top, each beginning a new word; sample x is bit x % 64 of its word

    std::size_t words_per_row() const { return (std::size_t(size.x) + 63) / 64; }
    bool covers(int x, int y) const { return bits[std::size_t(y) * words_per_row() + std::size_t(x) / 64] >> (x % 64) & 1; }
    std::size_t covered() const; ///< samples
};

/// What a mask is made of.
enum class MaskFaces : std::uint8_t {
    all,   ///< the samples whose centres are in faces, and those that sides of faces run through: parts thinner than a sample show as well
    front, ///< those whose centres are in faces that are counter-clockwise in the picture: a gap between them shows, though the far side lies behind
};

/// @param mesh  faces with a corner behind the eye are left out
/// @param per_pixel  1 or more
OutlineMask outline_mask(const Mesh& mesh, const Camera& camera, int per_pixel = 8, MaskFaces faces = MaskFaces::all);

/// The covered samples that have no other within `steps` steps to the right, left, up or down in the picture.
OutlineMask eroded(const OutlineMask& mask, int steps);

/// How far the outline of one mask is from that of another (silhouette-loop specification, checklist 31). Outlines are the covered samples
/// beside one that is not, within the picture; lengths and distances between them are exact to one sample.
struct OutlineError {
    double difference = 0; ///< px^2: the area that only one of the two covers
    double length = 0;     ///< px: of the wanted outline, its samples counted, so up to 1.41 times less than measured along it
    double beyond = 0;     ///< px: the greatest distance from the found outline to the wanted one
    double short_of = 0;   ///< px: the greatest distance from the wanted outline to the found one
    double most() const { return beyond > short_of ? beyond : short_of; }
    double mean() const { return length > 0 ? difference / length : 0; } ///< px: how far they are apart on average
};

/// @throws Error::Input for masks of different sizes
OutlineError compare_outlines(const OutlineMask& found, const OutlineMask& wanted);

/// The greatest distance in px from a sample that only one of two masks covers to the area that the other covers; infinity where that covers
/// nothing. Distances between outlines are larger where outlines cross at an acute angle, since the corner there moves further than they do, and
/// at gaps narrower than what is looked for; this one is not. @throws Error::Input for masks of different sizes
double area_distance(const OutlineMask& found, const OutlineMask& wanted);

/// The area in px^2 that `wanted` covers and `found` does not. @throws Error::Input for masks of different sizes
double uncovered(const OutlineMask& found, const OutlineMask& wanted);

} // namespace limn
