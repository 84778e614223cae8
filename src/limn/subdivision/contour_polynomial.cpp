#include "limn/subdivision/contour_polynomial.h"

namespace limn {
namespace {

/// Where the coefficient `inwards` rows from a side and `along` it stands.
template <int degree> constexpr std::size_t from_side(int side, int along, int inwards)
{
    const int left = degree - along - inwards;
    return side == 0 ? bezier_index(degree, along, inwards) : side == 1 ? bezier_index(degree, left, along) : bezier_index(degree, inwards, left);
}

constexpr double binomial(int n, int k) { return factorial(n) / (factorial(k) * factorial(n - k)); }

} // namespace

ContourPolynomial contour_polynomial(const dvec3& anchor, const QuarticPatch& patch, const Eye& eye)
{
    BezierTriangle<4, dvec3> to_eye;
    for (std::size_t i = 0; i < to_eye.c.size(); ++i)
        to_eye.c[i] = eye.from(anchor + patch.c[i]);
    const auto normal = bezier_product(bezier_dv(patch), bezier_dw(patch), [](const dvec3& a, const dvec3& b) { return glm::cross(a, b); });
    return bezier_product(to_eye, normal, [](const dvec3& a, const dvec3& b) { return glm::dot(a, b); });
}

std::array<double, 11> contour_along_side(const dvec3& anchor, const QuarticPatch& patch, int side, const Eye& eye)
{
    dvec3 outer[5], along[4], across[4];
    for (int i = 0; i < 5; ++i)
        outer[i] = patch.c[from_side<4>(side, i, 0)];
    for (int i = 0; i < 4; ++i) {
        along[i] = binomial(3, i) * (outer[i + 1] - outer[i]);
        across[i] = binomial(3, i) * (patch.c[from_side<4>(side, i, 1)] - outer[i]);
    }
    dvec3 normal[7] = {};
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k)
            normal[i + k] += glm::cross(along[i], across[k]);
    std::array<double, 11> out{};
    for (int i = 0; i < 5; ++i) {
        const dvec3 to_eye = binomial(4, i) * eye.from(anchor + outer[i]);
        for (int k = 0; k < 7; ++k)
            out[std::size_t(i + k)] += glm::dot(to_eye, normal[k]);
    }
    for (int i = 0; i < 11; ++i)
        out[std::size_t(i)] /= binomial(10, i);
    return out;
}

std::array<double, 11> along_side(const ContourPolynomial& polynomial, int side)
{
    std::array<double, 11> out;
    for (int i = 0; i < 11; ++i)
        out[std::size_t(i)] = polynomial.c[from_side<10>(side, i, 0)];
    return out;
}

} // namespace limn
