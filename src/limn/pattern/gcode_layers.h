#pragma once

#include <optional>
#include <vector>

#include "limn/pattern/gcode_comment.h"
#include "limn/pattern/print_path.h"

namespace limn {

/// Finds the layers of a print while its beads are read: by the comments that tell of them, or by where level beads lie.
class GcodeLayers {
public:
    /// @param told  comments tell of layers
    explicit GcodeLayers(bool told) : told_(told) {}

    /// A comment tells that a layer begins. Only comments of the first one's kind count: slicers' users write others.
    void mark(GcodeTold mark);
    /// How many layers are to follow.
    void announce(double count);
    /// A bead from a height to another, mm. @param told_height  of it, as comments have it; 0: they do not
    /// @return its layer, which is the last one
    const PrintLayer& place(double from_z, double to_z, double told_height);

    /// Numbers of layers that were announced and did not come; nothing where all did.
    struct Missing {
        std::size_t found;
        double announced;
    };
    std::optional<Missing> missing() const;
    /// Layers whose height nothing tells.
    std::size_t assumed() const { return assumed_; }
    std::size_t size() const { return layers_.size(); }
    /// All layers with beads. @param moves  the path's, whose numbers of layers are set right
    std::vector<PrintLayer> finished(std::vector<PrintMove>& moves);

private:
    bool begins(double z, bool level) const;

    const bool told_;
    std::vector<PrintLayer> layers_;
    std::vector<double> levels_;          ///< heights of layers, sorted
    GcodeTold kind_ = GcodeTold::nothing; ///< of the comments that begin layers
    std::size_t marks_ = 0, assumed_ = 0;
    double announced_ = 0;
};

/// mm; of a first layer that nothing tells of.
inline constexpr double usual_layer_height = 0.2;

} // namespace limn
