#pragma once

#include "limn/scene/json_place.h"

namespace limn {

/// The keys by which an object stands in the world.
inline const std::vector<std::string> transform_keys = {"translate", "rotate", "scale", "matrix"};

/// What an object's keys say: scaled by "scale", then turned by "rotate" (degrees around the world's x axis, then y, then z, or {"axis", "degrees"}), then moved by
/// "translate"; or the 16 numbers of "matrix", row by row. @throws Error::Read naming the key that is no such thing.
dmat4 read_transform(const JsonPlace& object);
/// The 16 numbers of "matrix".
Json matrix_json(const dmat4& transform);

/// A point of the world, at most 1e15 from its origin. @throws Error::Read
dvec3 read_point(const JsonPlace& place);
/// A vector that is not 0. @throws Error::Read
dvec3 read_direction(const JsonPlace& place);

} // namespace limn
