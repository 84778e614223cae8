#pragma once

#include "limn/terrain/nested_errors.h"
#include "limn/terrain/par.h"

namespace limn {

/// What of a terrain a camera may show: boxes around everything that may come up in a place, between the lowest and the highest sample there.
/// (A bounding sphere of a coarse triangle, as the seed has it, misses peaks that the triangle does not know of yet.)
class SeenTerrain {
public:
    /// @param ranges  with ranges; has to outlive this, as the map
    /// @throws Error::Input for errors without ranges
    SeenTerrain(const HeightMap& map, const NestedErrors& ranges, const Camera& camera);
    /// Of an edge that can be split: whether anything of the two triangles that have it as hypotenuse may be seen, which is all that its split changes.
    bool edge(const ivec2& a, const ivec2& b) const;
    /// Whether anything of a triangle may be seen, or one of its edges.
    bool triangle(const BisectionTriangle& t) const;

private:
    bool box(const dvec2& middle, double reach, double low, double high) const;
    const HeightMap& map_;
    const NestedErrors& ranges_;
    dvec3 eye_, right_, above_, forward_;
    dvec2 across_;
    double scale_;
    bool parallel_;
};

/// Whether two cameras show the same.
bool is_same_view(const Camera& a, const Camera& b);

/// Parallel adaptive refinement of what a camera sees (2.6 and 2.13 of the terrain specification). An edge counts where its split may change the
/// picture; that is the edge's own matter, so meshes are conforming everywhere, and triangles without such an edge need neither be tested nor drawn.
/// As the seed does, a view begins with the coarse mesh again, but only when the camera or the tolerance changes.
class ParView {
public:
    /// @param start  a conforming mesh
    ParView(const HeightMap& map, const NestedErrors& ranges, std::vector<BisectionTriangle> start);
    /// @param pixels  see screen_height_test()
    /// @param on_stage  as ParOptions has it
    /// @return how many triangles were tested: 0 where nothing changed since the last view
    std::size_t update(const Camera& camera, double pixels = 1, std::function<void(ParStage)> on_stage = {});
    const ParResult& result() const { return result_; } ///< of the last view
    /// Triangles that the last view may show.
    std::vector<BisectionTriangle> seen() const;

private:
    const HeightMap& map_;
    const NestedErrors& ranges_;
    std::vector<BisectionTriangle> start_;
    ParResult result_;
    Camera camera_;
    double pixels_ = -1; ///< none yet
};

} // namespace limn
