#pragma once

#include <span>
#include <vector>

namespace limn {

/// Where a polynomial in Bernstein form over [0, 1] changes its sign, ascending and appended to `roots`. Counted by sign changes of its
/// coefficients, of which there are never fewer than roots, so that none are missed; 0 counts as positive. Roots nearer to each other than
/// 2^-20 may be taken for none, in pairs.
/// @param coefficients  up to 32
void append_sign_changes(std::span<const double> coefficients, std::vector<double>& roots);

} // namespace limn
