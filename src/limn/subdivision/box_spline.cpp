#include "limn/subdivision/box_spline.h"

#include <span>
#include <vector>

namespace limn {
namespace {

/// The term `factor` u^(4-j-k) v^j w^k.
struct Term {
    int factor, j, k;
};

// Twelve times the basis functions, of the points in the order of the header.
constexpr Term of_a[] = {{6, 0, 0}, {24, 0, 1}, {24, 0, 2}, {8, 0, 3}, {1, 0, 4}, {24, 1, 0}, {60, 1, 1}, {36, 1, 2}, {6, 1, 3}, {24, 2, 0}, {36, 2, 1}, {12, 2, 2}, {8, 3, 0}, {6, 3, 1}, {1, 4, 0}};
constexpr Term of_b[] = {{1, 0, 0}, {6, 0, 1}, {12, 0, 2}, {6, 0, 3}, {1, 0, 4}, {8, 1, 0}, {36, 1, 1}, {36, 1, 2}, {8, 1, 3}, {24, 2, 0}, {60, 2, 1}, {24, 2, 2}, {24, 3, 0}, {24, 3, 1}, {6, 4, 0}};
constexpr Term of_c[] = {{1, 0, 0}, {8, 0, 1}, {24, 0, 2}, {24, 0, 3}, {6, 0, 4}, {6, 1, 0}, {36, 1, 1}, {60, 1, 2}, {24, 1, 3}, {12, 2, 0}, {36, 2, 1}, {24, 2, 2}, {6, 3, 0}, {8, 3, 1}, {1, 4, 0}};
constexpr Term of_r2[] = {{1, 0, 0}, {6, 0, 1}, {12, 0, 2}, {6, 0, 3}, {1, 0, 4}, {2, 1, 0}, {6, 1, 1}, {6, 1, 2}, {2, 1, 3}};
constexpr Term of_r3[] = {{1, 0, 0}, {2, 0, 1}};
constexpr Term of_r4[] = {{1, 0, 0}, {2, 1, 0}};
constexpr Term of_r5[] = {{1, 0, 0}, {2, 0, 1}, {6, 1, 0}, {6, 1, 1}, {12, 2, 0}, {6, 2, 1}, {6, 3, 0}, {2, 3, 1}, {1, 4, 0}};
constexpr Term of_y0[] = {{2, 3, 0}, {1, 4, 0}};
constexpr Term of_y1[] = {{2, 3, 1}, {1, 4, 0}};
constexpr Term of_y2[] = {{2, 0, 3}, {1, 0, 4}, {6, 1, 2}, {6, 1, 3}, {6, 2, 1}, {12, 2, 2}, {2, 3, 0}, {6, 3, 1}, {1, 4, 0}};
constexpr Term of_y3[] = {{1, 0, 4}, {2, 1, 3}};
constexpr Term of_y4[] = {{2, 0, 3}, {1, 0, 4}};

struct Weight {
    std::uint32_t coefficient, point;
    double weight;
};

std::vector<Weight> make_list()
{
    const std::span<const Term> functions[regular_support] = {of_a, of_b, of_c, of_r2, of_r3, of_r4, of_r5, of_y0, of_y1, of_y2, of_y3, of_y4};
    std::vector<Weight> list;
    for (std::uint32_t point = 0; point < regular_support; ++point)
        for (const Term& term : functions[point])
            list.push_back({std::uint32_t(bezier_index(4, term.j, term.k)), point, term.factor / (12 * multinomial(4, term.j, term.k))});
    return list;
}

/// Less than half of the weights are not 0.
const std::vector<Weight>& weight_list()
{
    static const std::vector<Weight> list = make_list();
    return list;
}

std::array<std::array<double, regular_support>, bezier_size(4)> make_weights()
{
    std::array<std::array<double, regular_support>, bezier_size(4)> weights{};
    for (const Weight& w : weight_list())
        weights[w.coefficient][w.point] = w.weight;
    return weights;
}

} // namespace

const std::array<std::array<double, regular_support>, bezier_size(4)>& box_spline_weights()
{
    static const auto weights = make_weights();
    return weights;
}

QuarticPatch regular_patch(const dvec3* points)
{
    QuarticPatch patch;
    for (const Weight& w : weight_list())
        patch.c[w.coefficient] += w.weight * points[w.point];
    return patch;
}

} // namespace limn
