#include "limn/subdivision/bezier_roots.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace limn {
namespace {

constexpr std::size_t most = 32;
constexpr int deepest = 20;

using Coefficients = std::array<double, most>;

constexpr std::array<Coefficients, most> pascals_triangle()
{
    std::array<Coefficients, most> rows{};
    for (std::size_t n = 0; n < most; ++n)
        for (std::size_t k = 0; k <= n; ++k)
            rows[n][k] = k == 0 || k == n ? 1 : rows[n - 1][k - 1] + rows[n - 1][k];
    return rows;
}
constexpr std::array<Coefficients, most> binomials = pascals_triangle();

int count_changes(std::span<const double> c)
{
    int changes = 0;
    for (std::size_t i = 1; i < c.size(); ++i)
        changes += (c[i] < 0) != (c[i - 1] < 0);
    return changes;
}

/// A polynomial and its derivative as sums of terms c t^i (1-t)^(n-i).
class Terms {
public:
    explicit Terms(std::span<const double> c) : degree_(c.size() - 1)
    {
        const Coefficients& binomial = binomials[degree_];
        for (std::size_t i = 0; i <= degree_; ++i)
            value_[i] = binomial[i] * c[i];
        for (std::size_t i = 0; i < degree_; ++i)
            slope_[i] = binomial[i] * double(degree_ - i) * (c[i + 1] - c[i]);
    }
    struct At {
        double value, slope;
    };
    At at(double t) const
    {
        const double rest = 1 - t;
        double power = t, value = value_[0], slope = slope_[0];
        for (std::size_t i = 1; i < degree_; ++i, power *= t) {
            value = value * rest + value_[i] * power;
            slope = slope * rest + slope_[i] * power;
        }
        return {value * rest + value_[degree_] * power, slope};
    }

private:
    std::size_t degree_;
    Coefficients value_, slope_;
};

/// The only change of sign of a polynomial whose ends differ: Newton's method, and halving where that leaves what is between the ends or does
/// not come nearer by half.
double only_root(std::span<const double> c)
{
    constexpr int most_steps = 80;
    constexpr double enough = 1e-11; // the next step would be a square of it
    const Terms terms(c);
    const bool rises = c.front() < 0;
    double low = 0, high = 1, last = 1, t = c.front() / (c.front() - c.back());
    for (int i = 0; i < most_steps; ++i) {
        const auto [value, slope] = terms.at(t);
        if (value == 0)
            return t;
        ((value < 0) == rises ? low : high) = t;
        const double step = value / slope, next = t - step;
        if (std::abs(step) <= enough)
            return std::clamp(next, low, high);
        if (next > low && next < high && std::abs(step) <= 0.5 * last) {
            last = std::abs(step), t = next;
        } else {
            last = 0.5 * (high - low), t = 0.5 * (low + high);
            if (t <= low || t >= high)
                return t;
        }
    }
    return t;
}

void append(std::span<const double> c, double begin, double size, int depth, std::vector<double>& roots)
{
    const int changes = count_changes(c);
    if (changes == 0)
        return;
    if (changes == 1 || depth == deepest) {
        if ((c.front() < 0) != (c.back() < 0))
            roots.push_back(begin + size * only_root(c));
        return;
    }
    Coefficients first, second;
    std::copy(c.begin(), c.end(), second.begin());
    const std::size_t n = c.size();
    for (std::size_t i = 0; i < n; ++i) {
        first[i] = second[0];
        for (std::size_t k = 0; k + 1 < n - i; ++k)
            second[k] = 0.5 * (second[k] + second[k + 1]);
    }
    append({first.data(), n}, begin, size / 2, depth + 1, roots);
    append({second.data(), n}, begin + size / 2, size / 2, depth + 1, roots);
}

} // namespace

void append_sign_changes(std::span<const double> coefficients, std::vector<double>& roots) { append(coefficients, 0, 1, 0, roots); }

} // namespace limn
