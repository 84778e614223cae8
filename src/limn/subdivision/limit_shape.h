#pragma once

#include <span>
#include <vector>

#include "limn/subdivision/patch_table.h"

namespace limn {

/// A place on the limit surface: the weights of the corners of a control face are (1-v-w, v, w), and 0 <= v, 0 <= w, v + w <= 1.
struct PatchPoint {
    std::uint32_t face = 0;
    double v = 0, w = 0;
};

struct SurfaceSample {
    dvec3 position;
    dvec3 normal; ///< unit length
};

/// @param anchor  positions are this plus the patch
SurfaceSample sample_patch(const dvec3& anchor, const QuarticPatch& patch, double v, double w);

/// The limit surface at a place, and its derivatives after the parameters, one-sided at the borders of patches (the third jumps there).
struct LimitJet {
    dvec3 position;
    dvec3 normal; ///< unit length
    dvec3 dv, dw; ///< dv x dw points outside
    dvec3 dvv, dvw, dww;
    dvec3 dvvv, dvvw, dvww, dwww;
};

/// The polynomial that the limit surface is around a place.
struct PatchPiece {
    dvec3 anchor = dvec3(0);  ///< positions are this plus the patch, whose coefficients so keep their digits where it is small
    QuarticPatch patch;
    double v = 0, w = 0;      ///< the place in the patch's own parameters
    dvec2 of_v, of_w;         ///< the derivatives of those two after the control face's v, and after its w
};

/// The patches of a face of the mesh after one step, in one pose.
class FacePatches {
public:
    /// @param positions  of that mesh's vertices
    FacePatches(const PatchTable& table, std::span<const dvec3> positions, std::uint32_t refined_face);

    const PatchClass& patches() const { return *patches_; }
    /// The limit of the first corner where the class is anchored, else 0.
    const dvec3& anchor() const { return anchor_; }
    /// The coefficients of a patch of the class, as seen from the anchor.
    QuarticPatch patch(const PatchClass::Node& node) const;
    dvec3 weighted(std::size_t row) const;
    /// Whether the class is PatchTable::regular.
    bool is_regular() const { return regular_; }
    /// What the face depends on (PatchTable::support).
    const dvec3* points() const { return many_.empty() ? few_.data() : many_.data(); }

private:
    static constexpr std::size_t usual = 24; ///< points, so that memory has to be asked for only at valences above 18
    const PatchClass* patches_;
    bool regular_;
    std::array<dvec3, usual> few_;
    std::vector<dvec3> many_;
    dvec3 anchor_ = dvec3(0);
};

/// The limit surface of a control mesh in one pose, for any place of any face, without making a finer mesh. Exact. Under the rule of
/// OpenSubdiv. For another pose of the same mesh the table is used again.
class LimitShape {
public:
    /// @param table  must live as long as this does
    /// @param positions  of the control mesh's vertices
    LimitShape(const PatchTable& table, std::span<const dvec3> positions);

    dvec3 position(const PatchPoint& at) const { return sample(at).position; }
    /// Unit length; of the side of creases that the face is on.
    dvec3 normal(const PatchPoint& at) const { return sample(at).normal; }
    SurfaceSample sample(const PatchPoint& at) const;
    /// At an extraordinary vertex curvature has no value: at valence 7 and more it grows without bound. So near one, and near ends of creases,
    /// nearer than 2^-held_at of a control face, the derivatives are those of the place that far away in the same direction. Position and
    /// normal are exact everywhere.
    LimitJet jet(const PatchPoint& at) const;
    static constexpr int held_at = 7;

    /// The polynomial around a place, at most `deepest` levels down from the control face; at extraordinary vertices it is held as above.
    PatchPiece piece(const PatchPoint& at, int deepest = held_at) const;
    FacePatches patches(std::uint32_t refined_face) const { return {*table_, positions_, refined_face}; }
    const PatchTable& table() const { return *table_; }
    /// The vertices of the mesh after one step, of which all patches are made.
    std::span<const dvec3> refined_positions() const { return positions_; }
    /// The vertices of the control mesh.
    std::span<const dvec3> control_positions() const { return control_positions_; }

private:
    const PatchTable* table_;
    std::vector<dvec3> control_positions_, positions_;
};

} // namespace limn
