#include <gtest/gtest.h>

#include "limn/subdivision/turned_triangle.h"
#include "subdivision/exact_views.h"

namespace limn::test {
namespace {

constexpr double pixels = 0.25;

/// The octahedron's limit surface before a camera in parallel.
class Before {
public:
    explicit Before(const char* from) : subject_(octahedron()), view_{subject_.pose(), PicturePlane(camera(from)), searched_eye(camera(from), dvec3(0)), pixels, 0, 0} {}
    SilhouetteView& view() { return view_; }
    /// A whole face as it is drawn.
    DrawnTriangle face(std::uint32_t number) const
    {
        DrawnTriangle triangle;
        triangle.face = number;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const PatchPoint at = on_half_edge(3 * number + k, 0);
            triangle.at[k] = {at.v, at.w};
            triangle.positions[k] = view_.pose.shape.position(at);
        }
        return triangle;
    }
    dvec2 pixel(const DrawnTriangle& triangle, std::size_t k) const { return view_.plane.pixel(triangle.positions[k]); }
    /// The greatest distance in pixels between a side and the surface along it.
    double off(const DrawnTriangle& triangle, std::size_t side) const
    {
        double most = 0;
        for (int i = 0; i <= 1000; ++i) {
            const dvec2 at = glm::mix(triangle.at[side], triangle.at[(side + 1) % 3], i / 1000.0);
            const dvec2 p = view_.plane.pixel(view_.pose.shape.position({triangle.face, at.x, at.y}));
            most = std::max(most, distance_to_line(p, pixel(triangle, side), pixel(triangle, (side + 1) % 3)));
        }
        return most;
    }

private:
    Camera camera(const char* from) const
    {
        Framing framing;
        framing.view = from;
        framing.size = {1024, 1024};
        framing.orthographic = true;
        return Camera::framing(subject_.bounds(), framing);
    }
    ExactSubject subject_;
    SilhouetteView view_;
};

TEST(TurnedTriangle, SticksOutByNoMoreThanItsSidesAreOff)
{
    Before before("17,28");
    std::size_t front = 0;
    for (std::uint32_t f = 0; f < 8; ++f) {
        DrawnTriangle triangle = before.face(f);
        const bool faces_eye = shows_side(before.view(), triangle.positions, true);
        front += faces_eye;
        EXPECT_EQ(turned_beyond(before.view(), triangle, faces_eye), 0) << f;
        const double most = std::max({before.off(triangle, 0), before.off(triangle, 1), before.off(triangle, 2)});
        EXPECT_LE(turned_beyond(before.view(), triangle, !faces_eye), most * (1 + 1e-12)) << f;
        EXPECT_GE(turned_beyond(before.view(), triangle, !faces_eye), 0.9 * most) << f;
        for (std::size_t side = 0; side < 3; ++side) { // the contour's polyline is meant to be where it is
            triangle.on_contour = {side != 0, side != 1, side != 2};
            EXPECT_LE(turned_beyond(before.view(), triangle, !faces_eye), before.off(triangle, side) * (1 + 1e-12)) << f;
            EXPECT_GE(turned_beyond(before.view(), triangle, !faces_eye), 0.9 * before.off(triangle, side)) << f;
        }
        triangle.on_contour = {true, true, true};
        EXPECT_EQ(turned_beyond(before.view(), triangle, !faces_eye), 0) << f;
    }
    EXPECT_EQ(front, 4u); // of an octahedron
}

TEST(TurnedTriangle, DoesNotCountOutsideThePicture)
{
    Before before("17,28");
    Camera elsewhere;
    elsewhere.orthographic = true;
    elsewhere.eye = {1000, 0, 5}, elsewhere.look = {1000, 0, 0};
    elsewhere.size = {64, 64};
    before.view().plane = PicturePlane(elsewhere);
    for (std::uint32_t f = 0; f < 8; ++f) {
        const DrawnTriangle triangle = before.face(f);
        EXPECT_EQ(turned_beyond(before.view(), triangle, !shows_side(before.view(), triangle.positions, true)), 0) << f;
    }
}

TEST(TurnedTriangle, IsAsNearAsThePlacesAroundItAsk)
{
    Before before("17,28");
    const DrawnTriangle triangle = before.face(0);
    EXPECT_EQ(pixels_around(before.view(), triangle), pixels);
    const dvec2 middle = 0.5 * (before.pixel(triangle, 1) + before.pixel(triangle, 2));
    before.view().tight = LocalTolerance({{middle, 1, 0.1}});
    EXPECT_EQ(pixels_around(before.view(), triangle), 0.1);
    before.view().tight = LocalTolerance({{middle, 1, 1e-6}});
    EXPECT_EQ(pixels_around(before.view(), triangle), 0.1 * pixels);
    before.view().tight = LocalTolerance({{middle + 2000.0, 1, 1e-6}});
    EXPECT_EQ(pixels_around(before.view(), triangle), pixels);
}

} // namespace
} // namespace limn::test
