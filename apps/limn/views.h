#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "limn/camera/camera.h"
#include "limn/lines/line_model.h"

/// Where the cameras stand, as on the command line. Texts are read after the parsing.
struct ViewOptions {
    std::string size;               ///< WxH; "" takes 1600x1200
    std::vector<std::string> views; ///< names or AZ,EL
    std::string usual_view = "iso = 45,35.264"; ///< where none is given; for the help, and where a command takes another one
    std::string eye, look, up;      ///< x,y,z or ""
    double fov_degrees = 30;
    bool orthographic = false;
    std::string scale;       ///< 1:N or ""
    std::string unit = "mm"; ///< length of 1 in the model; for `scale`
    std::string camera_file; ///< JSON, or ""
    std::optional<limn::Camera> camera; ///< a whole one, as `camera_file` would hold it
    std::string up_axis;     ///< y, z or ""
};

/// --size, --view, --eye, --look, --up, --fov, --ortho, --scale, --unit, --camera, --up-axis.
void add_view_options(CLI::App& app, ViewOptions& options);

/// @throws limn::Error::Input for texts that say nothing, values out of range and options that contradict each other.
void check_view_options(const ViewOptions& options);

/// The cameras of one picture, or of several on a sheet, all at one scale.
struct Sheet {
    std::vector<limn::Camera> cameras;
    std::vector<limn::ivec2> corners; ///< upper left corner of each camera's picture
    limn::ivec2 size = {0, 0};        ///< of the whole
    double mm_per_pixel = 0;          ///< of a true scale; 0: none was asked for
};

/// What the options say, or limn::usual_up_axis.
char up_axis_of(const ViewOptions& options, const std::string& format);

/// What the cameras look at.
struct Subject {
    const limn::LineModel& model;
    limn::Bounds bounds;
};

/// The cameras that the options ask for, around a model.
/// @throws limn::Error::Input for a value out of its range, limn::Error::Read for a bad camera file.
Sheet place_cameras(const ViewOptions& options, const Subject& subject, char up_axis);

/// The one camera that the options ask for, turned around the model in `count` equal steps at one distance; a sheet each.
std::vector<Sheet> turntable(const ViewOptions& options, const Subject& subject, char up_axis, int count);
