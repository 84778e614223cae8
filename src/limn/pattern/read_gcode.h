#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "limn/pattern/print_path.h"

namespace limn {

struct GcodeOptions {
    double filament_diameter = 0; ///< mm; 0: as the file tells, else 1.75
    double arc_error = 0.005;     ///< how far chords of arcs may be from them, mm
};

/// Reads what a printer does: G0 and G1 moves, G2 and G3 arcs (I and J or R, helical ones too), G20 and G21, G90 and G91, M82 and M83, G92, M200, tools,
/// G28. The comments of PrusaSlicer, Cura, OrcaSlicer and BambuStudio tell layers, features, widths and heights. As in printers:
/// - other commands and words of slicers' macros mean nothing here; a line's number and checksum are checked where it has them;
/// - filament that goes in on the way makes a bead, filament alone does not;
/// - M83 holds after G90 (as PrusaSlicer has it).
/// A bead without a told width has that of the volume that goes in: E times the filament's cross-section over the way is the area of its section
/// (bead_width), at most 10 heights or 2 mm, whichever is more, since what oozes in one place makes no bead. Without a told height it has that of its layer:
/// its z over that of the next layer below. Without told layers, one begins where beads are level and lie higher or lower than before.
/// @param name  of the file, for messages
/// @throws Error::Read naming file, line and cause: a number that is none, a word that moves has not (A, B, C, U, V, W: axes of other machines), an arc without
///         centre, a wrong checksum, splines (G5) and arcs in other planes, places outside a million mm, fewer layers than the file says it has, binary
///         G-code, and no bead at all.
PrintPath gcode_from_text(std::string_view text, const std::string& name, const GcodeOptions& options = {});
/// The same of a file, whose bytes are mapped, or of standard input ("-").
PrintPath read_gcode(const std::filesystem::path& file, const GcodeOptions& options = {});

/// Whether files of an ending hold G-code: gcode, gco, g.
bool is_gcode_format(std::string_view ending);

} // namespace limn
