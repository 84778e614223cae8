#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "limn/geometry/mesh.h"

namespace limn {

/// Generated control meshes for Loop subdivision, as somebody would model them: triangles, few, of mixed valence, with creases tagged as
/// sharp or semi-sharp. y is up; about 2 units large.
///
/// | name          | |
/// |---------------|-|
/// | creature      | a fox: body, four legs, head, ears, tail; semi-sharp creases at soles, ears, eyes and nose |
/// | rook          | a chess piece turned of rings, with battlements pulled out; sharp and semi-sharp rings |
/// | mug           | with a handle (genus 1), foot and rim creased |
/// | bracket       | two plates at a right angle with a hole in each (genus 2), semi-sharp edges for fillets, sharp rims of the holes |
/// | leaf          | an open surface: its creased midrib ends within it (a dart) and at a sharp tip |
/// | bent-cylinder | closed and smooth: a tube around three eighths of a circle, so that its outline is concave |
///
/// @throws Error::Input for an unknown name
Mesh make_control_sample(std::string_view name);

/// Every name that make_control_sample knows, in the order of the table.
const std::vector<std::string>& control_sample_names();

} // namespace limn
