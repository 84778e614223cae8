#pragma once

#include <filesystem>

#include "limn/surface/estimate.h"

namespace limn {

/// estimate_surface with a memory: looks in `folder` for the surface of this very mesh (every position and triangle) with
/// these options, and otherwise estimates it and keeps it there (one file, made with the folder). A damaged file is
/// replaced. Same surface, bit for bit, with and without the cache; `report` is only filled where it estimates.
/// @return the surface, and whether it came from the folder
/// @throws Error::Write when the folder or the file cannot be made.
struct CachedSurface {
    Surface surface;
    bool from_cache = false;
};
CachedSurface estimate_surface_cached(const Mesh& mesh, const EstimateOptions& options, const std::filesystem::path& folder,
                                      EstimateReport* report = nullptr, const VertexFaces* around = nullptr);

} // namespace limn
