#pragma once

#include "limn/subdivision/patch_table.h"

namespace limn {

/// A class of patches, and which of a neighbourhood's vertices its support are.
struct NewClass {
    PatchClass patches;
    std::vector<std::uint32_t> support;
};

/// The class of face 0 of a neighbourhood, by impulses: a mesh for each vertex, with 1 there and 0 elsewhere, is subdivided.
NewClass make_patch_class(const LoopTopology& neighbourhood);

} // namespace limn
