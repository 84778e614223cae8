// A real scan: the Stanford bunny of the package glmark2-data, where it is installed. Sections 4 and 7 of the line-visibility
// specification.

#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/geometry/read_mesh.h"
#include "limn/lines/chain.h"
#include "limn/lines/contour.h"
#include "limn/lines/draw.h"
#include "limn/lines/prepare.h"
#include "limn/lines/strokes.h"
#include "limn/lines/visibility.h"
#include "lines/cameras.h"

namespace limn {
namespace {

using namespace test;

constexpr const char* bunny_file = "/usr/share/glmark2/models/bunny.obj";

/// The contours of one view as they are decided, in pieces with their place in the picture.
struct Piece {
    dvec2 a, b;
    double length; ///< px
    bool visible, turned; ///< turned: the radial curvature is negative there
};
using Chain = std::vector<Piece>;

struct ContourPieces {
    std::vector<Chain> chains;
    std::vector<bool> closed;
};

/// Radial curvature in the middle of an element that lies on link l.
float curvature_of(const Element& e, const Link& link, const LinkCurvature& curvature, std::size_t l)
{
    const float t = 0.5f * (e.t0 + e.t1), along = link.reversed ? 1 - t : t;
    return glm::mix(curvature.enter[l], curvature.leave[l], along);
}

ContourPieces contour_pieces(const LineModel& model, const RayScene& rays, const Camera& camera)
{
    const View view = model.view(camera);
    const Projector projector(model, camera);
    const std::vector<float> facing = facing_of_vertices(model, view);
    const ViewContext context = {model, rays, view, projector, facing};
    const std::vector<Segment> segments = extract_contours(model, facing);
    const Chains chains = chain_segments(segments);
    const LinkCurvature curvature = curvature_along_contours(context, segments, chains);
    const OccluderGrid occluders(occluders_of_contours(context, segments, chains, curvature), camera);
    const ChainElements decided = find_visibility(context, VisibilityRule::contour, segments, chains, curvature, occluders);
    ContourPieces result;
    for (std::size_t c = 0; c < chains.size(); ++c) {
        Chain& chain = result.chains.emplace_back();
        result.closed.push_back(chains.closed[c]);
        std::size_t l = chains.start[c];
        for (std::uint32_t k = decided.start[c]; k < decided.start[c + 1]; ++k) {
            const Element& e = decided.elements[k];
            while (chains.links[l].segment != e.segment)
                ++l;
            const Segment& s = segments[e.segment];
            const dvec2 a(projector.project(glm::mix(s.a, s.b, e.t0))), b(projector.project(glm::mix(s.a, s.b, e.t1)));
            chain.push_back({a, b, glm::distance(a, b), e.visible, curvature_of(e, chains.links[l], curvature, l) < 0});
        }
    }
    return result;
}

double distance_to(const Piece& piece, const dvec2& p)
{
    const dvec2 d = piece.b - piece.a;
    const double t = glm::clamp(glm::dot(p - piece.a, d) / std::max(glm::dot(d, d), 1e-12), 0.0, 1.0);
    return glm::distance(p, piece.a + t * d);
}

/// Visual gaps (section 4): hidden runs between two visible ends that are 1 to 20 px apart and both free, with no other line
/// within 1.5 px.
struct Gaps {
    int all = 0;
    int cusp_to_cusp = 0; ///< those that begin and end at a cusp: folds
    int turned = 0;       ///< those of them with negative radial curvature all along
};

class GapFinder {
public:
    explicit GapFinder(const ContourPieces& pieces) : pieces_(pieces) {}

    Gaps find() const
    {
        Gaps gaps;
        for (std::size_t c = 0; c < pieces_.chains.size(); ++c)
            for (std::size_t i = 0; i < pieces_.chains[c].size(); ++i)
                if (!at(c, i).visible && (pieces_.closed[c] || i > 0) && at(c, i + size(c) - 1).visible)
                    add_run(gaps, c, i);
        return gaps;
    }

private:
    std::size_t size(std::size_t c) const { return pieces_.chains[c].size(); }
    const Piece& at(std::size_t c, std::size_t i) const { return pieces_.chains[c][i % size(c)]; }

    void add_run(Gaps& gaps, std::size_t c, std::size_t begin) const
    {
        std::size_t end = begin;
        bool turned = true;
        for (; !at(c, end).visible; ++end) {
            if (!pieces_.closed[c] && end + 1 == size(c))
                return;
            turned = turned && at(c, end).turned;
        }
        if (extent(c, begin, end) < StrokeOptions().shortest)
            return; // the drawing closes it
        const dvec2 p = at(c, begin).a, q = at(c, end).a;
        const double distance = glm::distance(p, q);
        if (distance < 1 || distance > 20 || !is_free(c, begin, p) || !is_free(c, end, q))
            return;
        ++gaps.all;
        gaps.cusp_to_cusp += at(c, begin).turned && at(c, end - 1).turned;
        gaps.turned += turned;
    }

    double extent(std::size_t c, std::size_t begin, std::size_t end) const
    {
        dvec2 low = at(c, begin).a, high = low;
        for (std::size_t k = begin; k < end; ++k) {
            low = glm::min(low, at(c, k).b);
            high = glm::max(high, at(c, k).b);
        }
        return glm::distance(low, high);
    }

    /// Whether no visible line but the one that ends there comes near an end, the place before piece i.
    bool is_free(std::size_t c, std::size_t i, const dvec2& end) const
    {
        std::set<std::size_t> own; // the pieces within 8 px along the line
        double length = 0;
        for (std::size_t k = i; k < i + size(c) && length < 8; length += at(c, k++).length)
            own.insert(k % size(c));
        length = 0;
        for (std::size_t k = i + size(c) - 1; k > i && length < 8; length += at(c, k--).length)
            own.insert(k % size(c));
        for (std::size_t other = 0; other < pieces_.chains.size(); ++other)
            for (std::size_t k = 0; k < size(other); ++k)
                if (at(other, k).visible && !(other == c && own.count(k)) && distance_to(at(other, k), end) < 1.5)
                    return false;
        return true;
    }

    const ContourPieces& pieces_;
};

TEST(Scan, TheBunnysContoursHaveNoGapsAndFewStrokes)
{
    if (!std::filesystem::exists(bunny_file))
        GTEST_SKIP() << bunny_file << " (package glmark2-data) is not installed";
    const PreparedMesh bunny = prepare_mesh(read_mesh(bunny_file));
    const PlacedSurface placed = bunny.placed();
    const LineModel model = build_line_model({&placed, 1});
    const RayScene rays = build_ray_scene(model);
    LineOptions options;
    const LineFeatures features = find_line_features(model, options);
    constexpr int views = 20;
    Gaps gaps;
    std::size_t contours = 0, strokes = 0;
    for (std::uint64_t k = 0; k < views; ++k) {
        const Camera camera = random_camera(bunny.mesh.bounds(), k, k % 5 == 4);
        const Gaps found = GapFinder(contour_pieces(model, rays, camera)).find();
        gaps.all += found.all;
        gaps.cusp_to_cusp += found.cusp_to_cusp;
        gaps.turned += found.turned;
        const Drawing drawing = draw_lines(model, rays, features, camera, options);
        strokes += drawing.strokes.size();
        for (const Stroke& s : drawing.strokes) {
            contours += s.type == LineType::contour;
            for (std::size_t i = 0; i < s.points.size(); ++i)
                ASSERT_TRUE(std::isfinite(s.points[i].x) && std::isfinite(s.points[i].y) && s.ink[i] >= 0 && s.ink[i] <= 1) << "view " << k;
        }
    }
    const auto per_view = [&](auto count) { return double(count) / views; };
    fmt::print("[   scan   ] bunny, per view: {:.2f} gaps, {:.2f} of them not cusp to cusp, {:.2f} not turned away all along, ", per_view(gaps.all),
               per_view(gaps.all - gaps.cusp_to_cusp), per_view(gaps.all - gaps.turned));
    fmt::print("{:.1f} contours, {:.1f} strokes\n", per_view(contours), per_view(strokes));
    EXPECT_LE(gaps.all - gaps.cusp_to_cusp, 0.3 * views);
    EXPECT_LE(gaps.all - gaps.turned, 0.5 * views);
    EXPECT_LE(gaps.all, 4 * views);
    EXPECT_LE(contours, 60u * views);
    EXPECT_LE(strokes, 150u * views);
}

} // namespace
} // namespace limn
