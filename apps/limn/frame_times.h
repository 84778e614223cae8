#pragma once

#include "frame_methods.h"

/// Times of many frames of one method, milliseconds.
struct FrameTimes {
    std::vector<double> frames;               ///< each frame as a whole
    std::vector<std::vector<double>> stages;  ///< per stage, each frame
    std::vector<double> per_second;           ///< frames counted in each second; only of the whole protocol

    double mean_fps() const;
    double median() const;
    double p95() const; ///< 95 of 100 frames take no longer
    std::vector<double> stage_medians() const;
};

/// One frame for each camera, after one that does not count.
FrameTimes time_frames(const FrameMethod& method, const std::vector<limn::Camera>& cameras);

/// The study's protocol: ten times ten seconds about each axis; the angle follows the clock.
FrameTimes time_full_turns(const FrameMethod& method, const limn::Bounds& bounds, int pixels);
