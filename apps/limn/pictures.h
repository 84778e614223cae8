#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common.h"
#include "limn/drawing/style.h"
#include "limn/lines/options.h"
#include "limn/scene/pixel_painter.h"
#include "models.h"
#include "views.h"

/// What `limn draw` and `limn render` have in common: models, cameras, lines, and files.
struct PictureCommand {
    std::string name;                 ///< of the subcommand
    std::vector<std::string> formats; ///< that it writes
    CommonOptions common;
    std::vector<std::string> files;   ///< models or one scene, as on the command line
    std::string from;                 ///< their format, whatever their ending; "" takes their own
    ViewOptions view;
    ModelOptions model;               ///< what the files are, once take_files has read their names
    limn::LineOptions lines;
    limn::Style style;
    limn::Need need = limn::Need::normals; ///< of the surface, besides what the lines need
    bool shades_cut_meshes = false;        ///< control meshes are shaded as cut for each camera; lines are always drawn of fine ones
    bool uses_gpu = false;            ///< the subcommand has a way to compute on the GPU
    int turntable = 0;                ///< frames; 0: one picture
    std::string cameras;              ///< JSON file with a list of cameras, or ""
};

/// Where the two differ.
struct PictureHooks {
    /// Hears of the models when they are read, before anything is written; may be absent.
    std::function<void(const Models&)> prepared;
    /// Puts what lies under the lines of one view into its drawing.
    std::function<void(limn::Drawing&, const limn::SeenModel&)> underlay;
    /// Lays over that what explains how control meshes were cut; absent: nothing.
    std::function<void(limn::Drawing&, const limn::LoopView&, const Models&)> overlay;
    /// Writes a picture to one of the files asked for, and returns the names of all that it wrote.
    std::function<std::vector<std::string>(const limn::Drawing&, const limn::SeenModel&, const Output&)> write;
    /// What else the last line of the run says; absent or "": nothing.
    std::function<std::string()> note;
    /// What else the report (--json) holds, an object; absent: nothing.
    std::function<nlohmann::ordered_json()> report;
    /// Where pixels were computed, once all pictures are written; absent: on the processor.
    std::function<std::string()> device;
};

/// MODEL, --from, --cache, --turntable, --cameras, and the options of surfaces, cameras and every subcommand.
void add_picture_options(CLI::App& app, PictureCommand& command, const std::string& output_help);

/// Reads the models that the command's objects name, draws the lines of every view, and writes every picture.
void make_pictures(PictureCommand& command, const PictureHooks& hooks);

/// The pictures of a run: the frames of a turntable, one for each camera of a list, or one sheet. @throws limn::Error as place_cameras
std::vector<Sheet> all_sheets(const PictureCommand& command, const Subject& subject, char up_axis);
/// Whether they go to files of their own, FILE-000, FILE-001, ...
bool sheets_are_numbered(const PictureCommand& command);
/// @throws limn::Error::Input where that cannot be
void check_numbered(const PictureCommand& command, const std::vector<Output>& outputs);
/// "turn-007.svg".
std::string numbered(const std::string& path, int number);
