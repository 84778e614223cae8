#pragma once

#include <algorithm>
#include <cmath>

#include "limn/base/vec.h"

namespace limn {

/// The height of a surface at a place, in metres, and its derivatives there, up to the third ones.
struct HeightJet {
    double height = 0;
    double x = 0, y = 0;
    double xx = 0, xy = 0, yy = 0;
    double xxx = 0, xxy = 0, xyy = 0, yyy = 0;
};

/// A bicubic polynomial over a cell between four samples, by its Bernstein coefficients: b[i][j] with i along u from 0 (west) to 1 (east), j
/// along v from 0 (north) to 1 (south). The surface is between the smallest and the largest of them.
struct HeightPatch {
    double b[4][4];

    double height(double u, double v) const
    {
        double p[4], q[4], sum = 0;
        basis(u, 0, p), basis(v, 0, q);
        for (int i = 0; i < 4; ++i)
            sum += p[i] * (q[0] * b[i][0] + q[1] * b[i][1] + q[2] * b[i][2] + q[3] * b[i][3]);
        return sum;
    }
    /// With derivatives by u and v, which the names x and y stand for.
    HeightJet jet(double u, double v) const
    {
        double p[4][4], q[4][4];
        for (int order = 0; order < 4; ++order)
            basis(u, order, p[order]), basis(v, order, q[order]);
        const auto at = [&](int du, int dv) {
            double sum = 0;
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < 4; ++j)
                    sum += p[du][i] * q[dv][j] * b[i][j];
            return sum;
        };
        return {at(0, 0), at(1, 0), at(0, 1), at(2, 0), at(1, 1), at(0, 2), at(3, 0), at(2, 1), at(1, 2), at(0, 3)};
    }
    double low() const { return *std::min_element(&b[0][0], &b[0][0] + 16); }
    double high() const { return *std::max_element(&b[0][0], &b[0][0] + 16); }

    /// How far the surface can be, along z, from a triangle with its corners on it, for each square of the triangle's size: of the legs where they
    /// run along rows and columns, of the hypotenuse where that does, in cells. Inside the cell an extreme distance is where the surface is
    /// parallel to the triangle, and one of the corners is within half that size in both directions; on a side, both are. So half the largest second
    /// derivatives, (X / 4 + 2 Z / 4 + Y / 4) / 2, bound it (after Filip, Magedson & Markot 1986), and Bernstein coefficients bound those.
    double bend() const
    {
        double uu = 0, uv = 0, vv = 0;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 2; ++j) {
                uu = std::max(uu, std::abs(b[j + 2][i] - 2 * b[j + 1][i] + b[j][i]));
                vv = std::max(vv, std::abs(b[i][j + 2] - 2 * b[i][j + 1] + b[i][j]));
            }
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                uv = std::max(uv, std::abs(b[i + 1][j + 1] - b[i + 1][j] - b[i][j + 1] + b[i][j]));
        return (6 * uu + 2 * 9 * uv + 6 * vv) / 8;
    }

private:
    /// Derivatives of the cubic Bernstein polynomials.
    static void basis(double t, int order, double (&out)[4])
    {
        const double s = 1 - t;
        switch (order) {
        case 0: out[0] = s * s * s, out[1] = 3 * s * s * t, out[2] = 3 * s * t * t, out[3] = t * t * t; return;
        case 1: out[0] = -3 * s * s, out[1] = 3 * s * s - 6 * s * t, out[2] = 6 * s * t - 3 * t * t, out[3] = 3 * t * t; return;
        case 2: out[0] = 6 * s, out[1] = 6 * t - 12 * s, out[2] = 6 * s - 12 * t, out[3] = 6 * t; return;
        default: out[0] = -6, out[1] = 18, out[2] = -18, out[3] = 6; return;
        }
    }
};

} // namespace limn
