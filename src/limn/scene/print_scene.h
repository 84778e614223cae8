#pragma once

#include <memory>
#include <vector>

#include "limn/pattern/print_options.h"
#include "limn/raycast/bead_scene.h"
#include "limn/raycast/occlusion.h"

namespace limn {

/// The beads of a print that are shown, ready to be seen from any side. Their frame is (mm - centre) / scale, in which all beads of the print are within
/// about 1 of the origin.
struct SeenPrint {
    Bounds bounds; ///< of all beads, mm
    dvec3 centre = dvec3(0);
    double scale = 1;
    BeadScene scene;
    std::vector<std::uint32_t> moves; ///< in the path, of each bead of the scene
};

/// @throws Error::Input where the options leave no layer of the print
SeenPrint see_print(const PrintPath& path, const PrintOptions& options);

/// What hides light from beads. `print` has to outlive it.
std::shared_ptr<const Occlusion> bead_occlusion(const SeenPrint& print);

} // namespace limn
