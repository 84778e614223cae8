#pragma once

#include <string>
#include <vector>

#include "limn/drawing/drawing.h"

namespace limn {

/// Writes heights into iso lines, as maps have them: where a line is long and straight enough, a gap with the figure in it, turned with the
/// line and upright. One for each line and every so many pixels of a long one, never on another.
class IsoLabels {
public:
    /// @param height  of the figures, pixels; 0: none are written
    IsoLabels(double height, const ivec2& picture) : height_(height), picture_(picture) {}

    /// Cuts a stroke where the text goes. @return the stroke's remaining pieces, or the stroke itself where it has no room
    std::vector<Stroke> write(const Stroke& stroke, const std::string& text);
    const std::vector<Caption>& captions() const { return captions_; }

private:
    bool is_free(const dvec2& middle, double reach) const;
    double height_;
    ivec2 picture_;
    std::vector<Caption> captions_;
    std::vector<double> reaches_; ///< of captions from their middles
};

} // namespace limn
