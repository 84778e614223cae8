#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "limn/geometry/mesh.h"

namespace limn {

/// Generated models of many closed shells, which run into each other where they are joined: hard cases for whatever looks at depths. y is up;
/// about 2 units large.
///
/// | name      | |
/// |-----------|-|
/// | tree      | a trunk, four levels of branches, and 1,536 leaves thinner than a hundredth of their length; grown from the seed |
/// | dragonfly | a slender body with a head, eyes and six legs, and four wings thinner than a hundredth of their length |
///
/// @param seed  of the tree
/// @throws Error::Input for an unknown name
Mesh make_model_sample(const std::string& name, std::uint64_t seed = 1);

/// Every name that make_model_sample knows.
const std::vector<std::string>& model_sample_names();

} // namespace limn
