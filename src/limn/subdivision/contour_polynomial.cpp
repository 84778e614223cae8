#include "limn/subdivision/contour_polynomial.h"

#include <algorithm>

namespace limn {
namespace {

/// Coefficients in rows, each coordinate by itself, times their multinomials: products of such polynomials are sums of products.
template <int degree> struct Rows {
    static constexpr std::size_t width = std::size_t(degree) + 1;
    double x[width][width], y[width][width], z[width][width]; ///< [k][j]
};

/// The normal p_v x p_w, of degree 6.
Rows<6> normal_rows(const QuarticPatch& patch)
{
    Rows<3> v, w;
    for (int k = 0; k < 4; ++k)
        for (int j = 0; j < 4 - k; ++j) {
            const double times = multinomials<3>[bezier_index(3, j, k)];
            const dvec3 a = times * (patch.at(j + 1, k) - patch.at(j, k)), b = times * (patch.at(j, k + 1) - patch.at(j, k));
            v.x[k][j] = a.x, v.y[k][j] = a.y, v.z[k][j] = a.z;
            w.x[k][j] = b.x, w.y[k][j] = b.y, w.z[k][j] = b.z;
        }
    Rows<6> out{};
    for (int ka = 0; ka < 4; ++ka)
        for (int ja = 0; ja < 4 - ka; ++ja) {
            const double ax = v.x[ka][ja], ay = v.y[ka][ja], az = v.z[ka][ja];
            for (int kb = 0; kb < 4; ++kb)
                for (int jb = 0; jb < 4 - kb; ++jb) {
                    out.x[ka + kb][ja + jb] += ay * w.z[kb][jb] - az * w.y[kb][jb];
                    out.y[ka + kb][ja + jb] += az * w.x[kb][jb] - ax * w.z[kb][jb];
                    out.z[ka + kb][ja + jb] += ax * w.y[kb][jb] - ay * w.x[kb][jb];
                }
        }
    return out;
}

} // namespace

ContourPolynomial contour_polynomial(const dvec3& anchor, const QuarticPatch& patch, const Eye& eye)
{
    const Rows<6> normal = normal_rows(patch);
    double g[10][10] = {};
    for (int ka = 0; ka <= 3; ++ka) // the patch's part at its first corner, of degree 3: p is further in the tangent plane
        for (int ja = 0; ja <= 3 - ka; ++ja) {
            const dvec3 to_eye = multinomials<3>[bezier_index(3, ja, ka)] * eye.from(anchor + patch.at(ja, ka));
            for (int kb = 0; kb <= 6; ++kb)
                for (int jb = 0; jb <= 6 - kb; ++jb)
                    g[ka + kb][ja + jb] += to_eye.x * normal.x[kb][jb] + to_eye.y * normal.y[kb][jb] + to_eye.z * normal.z[kb][jb];
        }
    ContourPolynomial out;
    for (int k = 0; k <= 9; ++k)
        for (int j = 0; j <= 9 - k; ++j)
            out.at(j, k) = g[k][j] / multinomials<9>[bezier_index(9, j, k)];
    return out;
}

bool shows_one_side(const dvec3& anchor, const QuarticPatch& patch, const Eye& eye)
{
    const dvec3 middle = (patch.at(0, 0) + patch.at(4, 0) + patch.at(0, 4)) / 3.0, to_eye = eye.from(anchor + middle);
    double reach = 0; // squared: how far the patch goes from there
    for (const dvec3& p : patch.c)
        reach = std::max(reach, glm::dot(p - middle, p - middle));
    reach *= eye.place.w * eye.place.w;
    const Rows<6> normal = normal_rows(patch);
    const bool front = glm::dot(to_eye, dvec3(normal.x[0][0], normal.y[0][0], normal.z[0][0])) >= 0;
    for (int k = 0; k <= 6; ++k)
        for (int j = 0; j <= 6 - k; ++j) {
            const dvec3 n(normal.x[k][j], normal.y[k][j], normal.z[k][j]);
            const double along = glm::dot(to_eye, n);
            if ((along >= 0) != front || along * along <= reach * glm::dot(n, n))
                return false;
        }
    return true;
}

std::array<double, 10> along_side(const ContourPolynomial& polynomial, int side)
{
    std::array<double, 10> out;
    for (int i = 0; i < 10; ++i)
        out[std::size_t(i)] = polynomial.c[bezier_side_index(9, side, i, 0)];
    return out;
}

} // namespace limn
