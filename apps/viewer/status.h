#pragma once

#include <string>

#include "limn/scene/moving_terrain.h"

/// What a window says of the bound: whether it holds, and if not, where and why not.
struct BoundStatus {
    enum class Kind {
        holds,           ///< everywhere in the picture
        following,       ///< the mesh is of an earlier camera: nothing is known
        reading,         ///< not where it is marked, until tiles arrive
        short_of_memory, ///< nor will it, with so little memory
        unreadable       ///< nor will it, since a tile cannot be read
    } kind = Kind::following;
    std::string text; ///< a line
};

/// @param pixels  the bound
/// @param is_of_this_view  whether the mesh was made for the camera that is seen
BoundStatus bound_status(const limn::TerrainStep& step, double pixels, bool is_of_this_view);
