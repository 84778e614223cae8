#pragma once

#include <memory>
#include <string>
#include <vector>

#include "limn/base/vec.h"

/// Ways to draw a pattern.
enum class PatternMethod {
    centre,     ///< one sample, at the pixel's centre
    four,       ///< four samples, rotated, as multisampling places them
    seed,       ///< the seed's 50 samples over 2 x 2 pixels
    even,       ///< 50 samples of the Gauss kernel, spread evenly
    derivative, ///< edges as smoothsteps of the derivative's width; normals at the centre
    gauss,
    box, ///< the analytic filter: standard deviation 0.5 px; a square of 2 x 2 pixels
    gauss_reference,
    box_reference,
    pixel_reference, ///< 1,024 stratified samples of the kernels above, and of one pixel
};

/// A pattern on a surface that fills a square picture.
class PatternSubject {
public:
    virtual ~PatternSubject() = default;
    virtual const std::string& name() const = 0;
    /// Linear colour over white of every pixel that shows the surface, in a fixed order; in one thread.
    virtual std::vector<limn::vec3> draw(PatternMethod method) const = 0;
    /// The same without the pattern: through a kernel of so many pixels that only its mean is left.
    virtual std::vector<limn::vec3> mean() const = 0;
};

/// Bricks, thread and layers (of the seed's model, the slope's and beads) of so many periods a pixel in the middle. Periods are those of the
/// coarsest of the pattern's waves.
/// @param flat  the same all over, seen without perspective; else in perspective, the thread as a whole sphere
std::vector<std::unique_ptr<PatternSubject>> pattern_subjects(double periods_per_pixel, int edge, bool flat);
