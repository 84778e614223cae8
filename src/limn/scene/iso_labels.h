#pragma once

#include <span>
#include <string>
#include <vector>

#include "limn/drawing/drawing.h"

namespace limn {

/// Writes heights into iso lines, as maps have them: where a line is long and straight enough, a gap with the figure in it, turned with the
/// line and upright. One for each line and every so many pixels of a long one, never on another or on a line of another kind.
class IsoLabels {
public:
    /// @param height  of the figures, pixels; 0: none are written
    /// @param others  lines that no figure may touch
    IsoLabels(double height, const ivec2& picture, std::span<const Stroke> others);

    /// Cuts a stroke where the text goes. @return the stroke's remaining pieces, or the stroke itself where it has no room
    std::vector<Stroke> write(const Stroke& stroke, const std::string& text);
    const std::vector<Caption>& captions() const { return captions_; }

private:
    /// Of a text from `a` to `b`.
    bool is_free(const dvec2& a, const dvec2& b) const;
    double height_;
    ivec2 picture_;
    std::vector<Caption> captions_;
    std::vector<double> reaches_; ///< of captions from their middles
    /// A straight piece of a line.
    struct Piece {
        dvec2 a, b;
    };
    std::vector<Piece> others_;
};

} // namespace limn
