#pragma once

#include <vector>

#include "limn/base/random.h"
#include "limn/lines/line_model.h"
#include "limn/lines/segment.h"
#include "limn/lines/suggestive.h"

namespace limn {

/// How many faces are tried before lines are followed (contour-lines specification 2.10).
struct StochasticOptions {
    double sample_fraction = 0.01; ///< n, as a part of the pool
    double discovery = 0.2;        ///< delta in [0,1]: (1 - delta) n seeds and (1 + delta) n random faces are tried
};

/// What one type of line remembers from frame to frame. A caller owns one per model and type, and shows it the views in
/// their order.
struct SeedSet {
    std::vector<std::uint32_t> pool;  ///< faces that can hold a line, shuffled a bit further in each frame
    std::vector<std::uint32_t> seeds; ///< faces that held a line in the last frame, first one of each line
    std::size_t lines = 0;            ///< so many of the seeds are the first of their line
    std::vector<std::uint32_t> visit; ///< per face of the model: the last frame in which it was tested
    std::uint32_t frame = 0;
    Random random{1};
};

/// Pools of contours (all faces) and of suggestive lines (candidate faces). Same seed, same lines.
SeedSet seeds_of_contours(const LineModel& model, std::uint64_t seed);
SeedSet seeds_of_suggestive(const LineModel& model, const SuggestiveFaces& faces, std::uint64_t seed);

/// What one frame did.
struct StochasticCounts {
    std::size_t seeds = 0, random = 0; ///< faces tried
    std::size_t tested = 0;            ///< faces tested in all, with those reached by following lines
    std::size_t lines = 0;             ///< runs of faces found
};

/// Contours from seeds and random faces: where a face holds one it is followed through its neighbours (Markosian et al. 1997,
/// across faces as in Kalnins et al. 2002). A subset of extract_contours, in the same order: whole lines,
/// but not all of them; with sample_fraction 1, all. (Lines along creases are not looked for: append_crease_outlines.)
std::vector<Segment> extract_contours_stochastic(const LineModel& model, const View& view, const StochasticOptions& options, SeedSet& seeds,
                                                 StochasticCounts* counts = nullptr);

/// The same for extract_suggestive.
std::vector<Segment> extract_suggestive_stochastic(const LineModel& model, const View& view, const SuggestiveOptions& suggestive,
                                                   const StochasticOptions& options, SeedSet& seeds, StochasticCounts* counts = nullptr);

/// For a single drawing: all that `stochastic_frames` frames from one eye find together (one frame where it samples every
/// face), in the order of the exact pass. The same seed gives the same lines.
inline constexpr int stochastic_frames = 8;
std::vector<Segment> draw_contours_stochastic(const LineModel& model, const View& view, const StochasticOptions& options, std::uint64_t seed);
std::vector<Segment> draw_suggestive_stochastic(const LineModel& model, const View& view, const SuggestiveFaces& faces,
                                                const SuggestiveOptions& suggestive, const StochasticOptions& options, std::uint64_t seed);

} // namespace limn
