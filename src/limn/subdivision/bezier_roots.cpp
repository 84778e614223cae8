#include "limn/subdivision/bezier_roots.h"

#include <array>
#include <cmath>

namespace limn {
namespace {

constexpr std::size_t most = 32;
constexpr int deepest = 20;

using Coefficients = std::array<double, most>;

int count_changes(std::span<const double> c)
{
    int changes = 0;
    for (std::size_t i = 1; i < c.size(); ++i)
        changes += (c[i] < 0) != (c[i - 1] < 0);
    return changes;
}

double value(std::span<const double> c, double t)
{
    Coefficients work;
    std::copy(c.begin(), c.end(), work.begin());
    for (std::size_t n = c.size() - 1; n > 0; --n)
        for (std::size_t i = 0; i < n; ++i)
            work[i] = (1 - t) * work[i] + t * work[i + 1];
    return work[0];
}

/// The only change of sign of a polynomial whose ends differ: false position that halves the weight of an end that stays (Illinois).
double only_root(std::span<const double> c)
{
    double low = 0, high = 1, at_low = c.front(), at_high = c.back();
    int stays = 0;
    for (int i = 0; i < 60 && high - low > 1e-14; ++i) {
        double t = at_low == at_high ? 0.5 * (low + high) : low - at_low * (high - low) / (at_high - at_low);
        if (!(t > low && t < high))
            t = 0.5 * (low + high);
        const double f = value(c, t);
        if (f == 0)
            return t;
        if ((f < 0) == (at_low < 0)) {
            low = t, at_low = f;
            at_high *= stays == 1 ? 0.5 : 1;
            stays = 1;
        } else {
            high = t, at_high = f;
            at_low *= stays == -1 ? 0.5 : 1;
            stays = -1;
        }
    }
    return 0.5 * (low + high);
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
