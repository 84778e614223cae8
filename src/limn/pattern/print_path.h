#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "limn/base/vec.h"
#include "limn/geometry/bounds.h"

namespace limn {

/// What a bead is for, as slicers tell it.
enum class BeadFeature : std::uint8_t {
    outer_wall,
    inner_wall,
    overhang,
    top,
    solid,
    infill,
    bridge,
    gap,
    ironing,
    skirt,
    support,
    interface, ///< between support and part
    tower,     ///< where nozzles are wiped
    other,
};
inline constexpr int bead_feature_count = 14;

/// "outer wall".
std::string_view feature_name(BeadFeature feature);
/// What a slicer's own word means, in any case: "External perimeter", "WALL-OUTER", "Outer wall". `other` for unknown ones.
BeadFeature feature_from_slicer(std::string_view word);

/// A straight move of a nozzle, from where the one before it ended. Lengths are mm.
struct PrintMove {
    vec3 to;                 ///< z is the nozzle's, which is the top of the bead
    float width = 0;         ///< of the bead; 0: nothing is extruded
    float height = 0;        ///< of the bead
    float speed = 0;         ///< mm/s; 0 where the file tells none
    std::uint32_t layer = 0; ///< in PrintPath::layers
    BeadFeature feature = BeadFeature::other;
    std::uint8_t tool = 0;
    bool extrudes() const { return width > 0; }
};

struct PrintLayer {
    float z = 0;      ///< of its top, mm
    float height = 0; ///< mm
};

/// All that a nozzle does, and what the file says of it.
struct PrintPath {
    vec3 start = vec3(0);            ///< where the first move begins
    std::vector<PrintMove> moves;    ///< arcs as chords; those that move nothing are left out
    std::vector<PrintLayer> layers;  ///< in the order of printing; empty only without beads
    std::string slicer;              ///< "PrusaSlicer 2.5.0"; "" where it is not told
    std::string stated_time;         ///< that the slicer expects, as it writes it; "": none
    double filament_diameter = 1.75; ///< mm
    double filament = 0;             ///< mm of it in beads
    double volume = 0;               ///< mm³ of beads, by the filament that goes in
    double seconds = 0;              ///< of all moves at the speeds told, as if nozzles had no mass: the real time is longer
    std::size_t retractions = 0;
    std::size_t lines = 0;          ///< of the file
    std::vector<std::string> notes; ///< what was assumed, or looks wrong
};

/// What beads there are.
struct PrintFacts {
    Bounds bounds;                                      ///< around all beads, mm
    std::array<double, bead_feature_count> length = {}; ///< mm of bead of each feature
    double extruded = 0, travel = 0;                    ///< mm
    std::size_t beads = 0;
    double thinnest = 0, thickest = 0; ///< layers, mm
    int tools = 0;                     ///< that extrude
};
PrintFacts print_facts(const PrintPath& path);

} // namespace limn
