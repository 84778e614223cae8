#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common.h"
#include "console.h"
#include "limn/lines/prepare.h"
#include "limn/scene/loop_model.h"
#include "limn/scene/scene.h"

/// What is read and how it is prepared.
struct ModelOptions {
    std::vector<limn::SceneObject> objects; ///< all with files
    limn::PrepareOptions prepare;
    limn::SubdivisionOptions subdivision;
    bool hash_shapes = false; ///< fills Input::shape
};

/// What is worth telling of a model that was read.
struct Input {
    std::string file, format;
    std::string name; ///< that a scene gives it, or ""
    limn::dmat4 transform = limn::dmat4(1); ///< that places it in the world
    std::size_t vertices = 0, triangles = 0;
    std::uint64_t shape = 0; ///< shape_hash, where it is asked for
    limn::Bounds bounds;                          ///< in the world
    std::vector<std::string> notes;               ///< what is unclean; of a file shown several times, only where it stands first
    std::optional<limn::EstimateReport> estimate; ///< where curvature was estimated in this run
    std::vector<std::uint32_t> face_numbers;      ///< Mesh::face_numbers
};

/// Models that stand in one world, ready to be drawn from any side.
struct Models {
    limn::LineModel lines;
    std::vector<Input> inputs;
    std::vector<limn::PlacedLoop> loops; ///< the objects, where they are control meshes; `lines` then has fine meshes
    double read_seconds = 0, surface_seconds = 0, merge_seconds = 0;

    limn::Bounds bounds() const;
    std::size_t triangle_count() const { return lines.faces.size(); }
};

/// Reads the objects' files, each once, and estimates their surfaces. The meshes are let go before this returns.
/// @param share  part of the run that this takes, in (0,1]; for the progress
/// @throws limn::Error::Read naming the file that cannot be read.
Models prepare_models(const ModelOptions& options, Console& console, double share = 1);

/// Makes the fine meshes of control meshes anew where a camera asks for more than they have.
void refine_for(Models& models, std::span<const limn::Camera> cameras, const ModelOptions& options);

/// "3 border edges", "2 non-manifold edges", "4 edges with inconsistent winding", "1 zero-area face": of one object of a model; empty for a clean closed one.
std::vector<std::string> topology_notes(const limn::LineModel& model, std::size_t object);

/// The format of a file as given on the command line: `from`, or its ending.
std::string input_format(const std::string& file, const std::string& from);
