#pragma once

#include <span>
#include <vector>

#include "limn/lines/line_model.h"
#include "limn/lines/segment.h"

namespace limn {

/// Ways to test less (contour-lines specification 2.9). None of them changes which lines are found on front faces.
struct SuggestiveShortcuts {
    bool skip_convex = true;    ///< a: only the candidate faces (needs SuggestiveFaces)
    bool front_only = true;     ///< b: faces turned away are skipped; off, their lines are found too
    bool sign_first = true;     ///< c: the sign of the radial curvature is tested before the facing
    bool stored_normals = true; ///< d: the facing is tested with the stored face normals (needs SuggestiveFaces)
    bool strength_test = true;  ///< a face with no corner above the limit is skipped before its zeros are computed
};

/// Suggestive contours (DeCarlo et al. 2003, 2004) or highlights (DeCarlo & Rusinkiewicz 2007).
struct SuggestiveOptions {
    float feature_size = 0.05f; ///< in the model's frame, see feature_size_of(); makes the limit independent of scale
    float limit = 0.01f;        ///< smallest sin^2(theta) feature_size^2 D kr (t_d, t_h); 0 keeps every line
    float fade = 2;             ///< the ink is full from this many limits above the limit; 0: no fading
    float speed_limit = 0;      ///< largest speed, model radii per radius of camera motion; 0: no limit
    bool highlight = false;     ///< suggestive highlights: the derivative with the other sign
    SuggestiveShortcuts shortcuts;
};

/// What does not depend on the view.
struct SuggestiveFaces {
    std::vector<std::uint32_t> candidates; ///< faces that can hold a line, ascending
    std::vector<vec3> normals;             ///< (p1 - p0) x (p2 - p0) of every face
};

/// A face is no candidate where all three corners have positive Gaussian curvature and mean curvatures of one sign: the
/// radial curvature cannot change sign there, from wherever it is seen. (A coarse face may join a convex and a concave corner:
/// such a face stays.) Curvatures too small to have a sure sign do not count as positive Gaussian curvature.
SuggestiveFaces find_suggestive_faces(const LineModel& model);

/// Why faces were left (tables 4.3 and 4.4 of the specification), in the order of the tests.
struct SuggestiveCounts {
    std::size_t faces = 0;      ///< of the model
    std::size_t tested = 0;     ///< candidates
    std::size_t one_sign = 0;   ///< left by the test of the radial curvature's sign
    std::size_t turned_away = 0;///< left by the facing test
    std::size_t too_weak = 0;   ///< left because no corner is above the limit
    std::size_t trimmed = 0;    ///< nothing remained between the two zeros
    std::size_t drawn = 0;
    SuggestiveCounts& operator+=(const SuggestiveCounts& other);
};

/// The view code (suggestive_face.h) of every vertex: the signs of n.v and of the radial curvature, without division or root.
std::vector<std::uint8_t> view_codes(const LineModel& model, const View& view);

/// The suggestive contours of a model as seen from an eye: at most one segment per face, in the order of the faces, trimmed to where
/// the limits hold, with the ink of the fading at its ends. Needs curvature and its derivative.
/// @param codes   view_codes(model, view)
/// @param faces   find_suggestive_faces(model), or null for a single view: the lines are the same
/// @param counts  added to, or null
/// @throws Error::Input when the model has no derivative of curvature.
std::vector<Segment> extract_suggestive(const LineModel& model, const View& view, std::span<const std::uint8_t> codes,
                                        const SuggestiveOptions& options, const SuggestiveFaces* faces = nullptr,
                                        SuggestiveCounts* counts = nullptr);

/// The same for a view that is used once.
std::vector<Segment> extract_suggestive(const LineModel& model, const View& view, const SuggestiveOptions& options);

} // namespace limn
