#include "limn/subdivision/side_net.h"

namespace limn {
namespace {

constexpr double of_three[] = {1, 3, 3, 1}; ///< binomials
constexpr std::array<double, 10> inverse_of_nine = {1, 1 / 9.0, 1 / 36.0, 1 / 84.0, 1 / 126.0, 1 / 126.0, 1 / 84.0, 1 / 36.0, 1 / 9.0, 1};

/// Which of a regular face's points (box_spline.h) are those of the regular edge that is its side.
constexpr std::size_t of_side[3][regular_edge_support] = {
    {0, 1, 2, 3, 4, 5, 6, 7, 8, 9},   // A to B: around A follow r2, r3, r4, r5, around B y0, y1, y2
    {1, 2, 0, 6, 7, 8, 9, 10, 11, 3}, // B to C: A, r5, y0, y1, y2 around B; y3, y4, r2 around C
    {2, 0, 1, 9, 10, 11, 3, 4, 5, 6}, // C to A
};

dvec3 mixed(const dvec3& a, const dvec3& b, double t) { return a + t * (b - a); }

} // namespace

SideNet side_net(const FacePatches& face, const PatchClass::Node& patch, int side)
{
    if (face.is_regular()) {
        std::array<dvec3, regular_edge_support> points;
        for (std::size_t i = 0; i < points.size(); ++i)
            points[i] = face.points()[of_side[side][i]];
        return regular_side_net(points);
    }
    SideNet net;
    for (int i = 0; i < 5; ++i)
        net.outer[std::size_t(i)] = face.weighted(patch.row + bezier_side_index(4, side, i, 0));
    for (int i = 0; i < 4; ++i)
        net.inner[std::size_t(i)] = face.weighted(patch.row + bezier_side_index(4, side, i, 1));
    return net;
}

SideNet regular_side_net(const std::array<dvec3, regular_edge_support>& points)
{
    const auto& [a, b, r1, r2, r3, r4, r5, q0, q1, q2] = points;
    const dvec3 beside = r1 + r5;
    SideNet net;
    net.outer[0] = (6.0 * a + b + beside + (r2 + r4) + r3) * (1 / 12.0);
    net.outer[1] = (12.0 * a + 4.0 * b + 3.0 * beside + (r2 + r4)) * (1 / 24.0);
    net.outer[2] = (2.0 * (a + b) + beside) * (1 / 6.0);
    net.outer[3] = (4.0 * a + 12.0 * b + 3.0 * beside + (q0 + q2)) * (1 / 24.0);
    net.outer[4] = (a + 6.0 * b + beside + (q0 + q2) + q1) * (1 / 12.0);
    net.inner[0] = (12.0 * a + 3.0 * b + 4.0 * r1 + 3.0 * r2 + (r3 + r5)) * (1 / 24.0);
    net.inner[1] = (10.0 * a + 6.0 * b + 6.0 * r1 + (r2 + r5)) * (1 / 24.0);
    net.inner[2] = (6.0 * a + 10.0 * b + 6.0 * r1 + (q2 + r5)) * (1 / 24.0);
    net.inner[3] = (3.0 * a + 12.0 * b + 4.0 * r1 + 3.0 * q2 + (q1 + r5)) * (1 / 24.0);
    return net;
}

std::array<double, 10> contour_along(const dvec3& anchor, const SideNet& net, const Eye& eye)
{
    dvec3 along[4], across[4];
    for (std::size_t i = 0; i < 4; ++i) {
        along[i] = of_three[i] * (net.outer[i + 1] - net.outer[i]);
        across[i] = of_three[i] * (net.inner[i] - net.outer[i]);
    }
    dvec3 normal[7] = {};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 0; k < 4; ++k)
            normal[i + k] += glm::cross(along[i], across[k]);
    std::array<double, 10> out{};
    for (std::size_t i = 0; i < 4; ++i) { // of degree 3: ContourPolynomial
        const dvec3 to_eye = of_three[i] * eye.from(anchor + net.outer[i]);
        for (std::size_t k = 0; k < 7; ++k)
            out[i + k] += glm::dot(to_eye, normal[k]);
    }
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] *= inverse_of_nine[i];
    return out;
}

SurfaceSample sample_side(const dvec3& anchor, const SideNet& net, double t)
{
    dvec3 outer[5], inner[4]; // de Casteljau
    for (std::size_t i = 0; i < 4; ++i)
        outer[i] = net.outer[i], inner[i] = net.inner[i];
    outer[4] = net.outer[4];
    for (std::size_t n = 4; n > 1; --n) {
        for (std::size_t i = 0; i < n; ++i)
            outer[i] = mixed(outer[i], outer[i + 1], t);
        for (std::size_t i = 0; i + 1 < n; ++i)
            inner[i] = mixed(inner[i], inner[i + 1], t);
    }
    const dvec3 normal = glm::cross(outer[1] - outer[0], inner[0] - outer[0]);
    const double length = glm::length(normal);
    return {anchor + mixed(outer[0], outer[1], t), length > 0 ? normal / length : dvec3(0)};
}

} // namespace limn
