#pragma once

#include <string>
#include <string_view>

#include "limn/scene/scene.h"

namespace limn {

/// The version of scene files that this Limn writes and reads: the value of their key "limn".
inline constexpr int scene_version = 1;

/// A scene from JSON (docs/scene.md lists the keys). The options of lines, style, surface, subdivision, render, image-lines and shader-lines have the names and ranges of
/// their tables, so those of the command line.
/// @param file    stands in messages; the objects' paths count from its folder ("": from the working folder)
/// @throws Error::Read with one line that names the file and the place in it: broken JSON, unknown keys (with the nearest known one), values of a wrong type
///         or out of range, and models that do not exist.
Scene scene_from_json(std::string_view text, const std::filesystem::path& file);

/// The same from a file; "-" is standard input.
Scene read_scene(const std::filesystem::path& file);

/// The scene as JSON text that scene_from_json reads: only what differs from a default-made scene. Colours have 8 bits a channel there.
/// @param folder  where the text will be kept: the objects' paths are written from it; "": as they are
/// @throws Error::Input for an object that has a mesh and no file.
std::string scene_to_json(const Scene& scene, const std::filesystem::path& folder = {});

} // namespace limn
