#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "limn/formulas/formulas.h"

namespace limn {

/// The layers of a print from the lowest on: a first one, more of one height, or of any heights. Lengths are in the unit of the heights asked
/// about; scaled() takes them to another.
class LayerStack {
public:
    /// @param bottom  where the lowest layer begins, along the print direction
    /// @param first   height of the lowest layer; 0: as the others
    /// @throws Error::Input for heights that are not above 0.
    explicit LayerStack(double height = 0.2, double bottom = 0, double first = 0);
    /// @param heights  of all layers; the last one goes on above. @throws Error::Input for none, or for one not above 0.
    LayerStack(std::vector<double> heights, double bottom);

    /// The same stack with lengths multiplied by `factor`, and then moved by `shift`.
    LayerStack scaled(double factor, double shift) const;

    /// Where a height lies in the stack.
    /// @param change  of the height, for a pixel to the right and down
    /// @param width   of the pixel's kernel, pixels: where layers of several heights are seen through it, the place changes as they do on average
    formulas::LayerPlace place(float at, const vec2& change, float width) const;
    /// How many layers reach up to a height; fractions count.
    double layers_below(double at) const;

    /// The same as formulas and devices have it: `row`, and where its layers end.
    formulas::LayerRow row() const { return {bottom_, height_, int(tops_.size())}; }
    const std::vector<float>& tops() const { return tops_; }

private:
    std::vector<float> tops_;       ///< of the layers that differ from those above, lowest first
    float bottom_ = 0, height_ = 0; ///< height of all above
};

/// Heights of layers from a text: a number for each layer, or "Z HEIGHT" pairs as slicers write them (the height holds from that Z on); '#'
/// begins a comment. Millimetres.
/// @param name  of the file, for messages  @throws Error::Read naming the line.
std::vector<double> layer_heights_from_text(std::string_view text, const std::string& name);

} // namespace limn
