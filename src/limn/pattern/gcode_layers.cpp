#include "limn/pattern/gcode_layers.h"

#include <algorithm>
#include <cmath>

namespace limn {
namespace {

constexpr double same_height = 1e-4, thinnest = 5e-3; ///< mm

} // namespace

void GcodeLayers::mark(GcodeTold mark)
{
    if (kind_ == GcodeTold::nothing) { // beads before the first mark count with its layer
        kind_ = mark;
        levels_.clear();
        layers_.assign(1, PrintLayer());
    }
    if (mark != kind_)
        return;
    ++marks_;
    if (layers_.back().height > 0)
        layers_.emplace_back();
}

void GcodeLayers::announce(double count)
{
    announced_ = std::max(count, 0.0);
    marks_ = 0;
}

bool GcodeLayers::begins(double z, bool level) const
{
    if (layers_.empty())
        return true;
    if (told_)
        return false;
    const double rise = z - double(layers_.back().z);
    return level ? std::abs(rise) > same_height : rise > double(layers_.back().height) - same_height; // spirals rise in beads
}

const PrintLayer& GcodeLayers::place(double from_z, double to_z, double told_height)
{
    const double z = std::max(from_z, to_z);
    if (begins(z, from_z == to_z))
        layers_.emplace_back();
    PrintLayer& layer = layers_.back();
    if (layer.height > 0)
        return layer;
    const auto above = std::lower_bound(levels_.begin(), levels_.end(), z - same_height);
    const double below = above == levels_.begin() ? 0 : *(above - 1);
    double height = told_height > 0 ? told_height : z - below;
    if (height < thinnest) {
        height = layers_.size() > 1 ? double(layers_[layers_.size() - 2].height) : usual_layer_height;
        ++assumed_;
    }
    layer = {float(z), float(height)};
    if (above == levels_.end() || *above > z + same_height)
        levels_.insert(above, z);
    return layer;
}

std::optional<GcodeLayers::Missing> GcodeLayers::missing() const
{
    if (marks_ > 0 && double(marks_) < announced_)
        return Missing{marks_, announced_};
    return std::nullopt;
}

std::vector<PrintLayer> GcodeLayers::finished(std::vector<PrintMove>& moves)
{
    if (layers_.size() > 1 && layers_.back().height <= 0)
        layers_.pop_back();
    if (layers_.size() == 1 && layers_.back().height <= 0) { // all beads came before the first mark
        const auto bead = std::find_if(moves.begin(), moves.end(), [](const PrintMove& move) { return move.extrudes(); });
        if (bead != moves.end())
            layers_.back() = {bead->to.z, bead->height};
    }
    for (std::size_t i = moves.size(); i-- > 0 && moves[i].layer >= layers_.size();)
        moves[i].layer = std::uint32_t(layers_.size() - 1);
    return std::move(layers_);
}

} // namespace limn
