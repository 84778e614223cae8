#pragma once

#include <filesystem>
#include <string>

#include "limn/drawing/drawing.h"

namespace limn {

/// A drawing as one JSON object: "camera" (camera_to_json), "mm_per_pixel" (where it has a true scale), "strokes"
/// (each with "type", "visible", "closed", "object", "points" [[x,y],...] in pixels, "world" [[x,y,z],...], "ink" [...] and
/// "faces" [...], null for no face) and "regions" ("name", "colour", "rings"), and where there are any
/// "captions" ("text", "height", "position", and "angle" where it is not 0). World coordinates are exact, pixels have 4 decimals.
std::string to_json(const Drawing& drawing);

/// @throws Error::Write
void write_json(const Drawing& drawing, const std::filesystem::path& path);

} // namespace limn
