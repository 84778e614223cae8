#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace limn {

/// x^a y^b
struct Monomial {
    int a, b;
    constexpr int degree() const { return a + b; }
    constexpr bool operator==(const Monomial&) const = default;
};

constexpr std::size_t monomial_count(int lowest, int highest)
{
    return std::size_t((highest + 1) * (highest + 2) / 2 - lowest * (lowest + 1) / 2);
}

/// Place of a monomial in the order 1, x, y, x^2, xy, y^2, x^3, … that starts with degree `lowest`.
constexpr std::size_t monomial_index(Monomial m, int lowest)
{
    return monomial_count(lowest, m.degree()) - std::size_t(m.a) - 1;
}

template <int Lowest, int Highest> constexpr auto make_monomials()
{
    std::array<Monomial, monomial_count(Lowest, Highest)> list{};
    for (int degree = Lowest; degree <= Highest; ++degree)
        for (int b = 0; b <= degree; ++b)
            list[monomial_index({degree - b, b}, Lowest)] = {degree - b, b};
    return list;
}

/// A monomial as the product of two whose degrees differ by at most 1.
struct MonomialFactors {
    Monomial first, second;
};
constexpr MonomialFactors halve(Monomial m)
{
    const int half = m.degree() / 2;
    const int a = std::min(m.a, half);
    const Monomial first = {a, half - a};
    return {first, {m.a - first.a, m.b - first.b}};
}

} // namespace limn
