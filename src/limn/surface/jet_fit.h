#pragma once

#include <span>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// Which polynomial is fitted to the heights of a neighbourhood.
struct JetModel {
    int degree = 4;            ///< 2, 3 or 4
    bool interpolating = true; ///< passes through the vertex, weights 1/(rho^2 + 0.1); else free with weights 1
};

/// Vertices to fit and their neighbourhoods in CSR form.
struct Neighbourhoods {
    std::vector<std::uint32_t> centre;
    std::vector<std::uint32_t> start;     ///< centre.size() + 1
    std::vector<std::uint32_t> neighbour; ///< at most RingCollector::most for each centre

    void clear();
    /// Ends the neighbourhood of `vertex`: every neighbour appended since the last call is its own.
    void close(std::uint32_t vertex);
    std::size_t size() const { return centre.size(); }
};

/// The fit at one vertex. Meaningless where not ok.
struct Jet {
    dvec3 normal, e1;     ///< unit; e2 = normal x e1
    double k1, k2;        ///< |k1| >= |k2|
    dvec4 derivative;     ///< P Q S T in (e1,e2); zero for degree 2
    double reach;         ///< distance of the farthest neighbour in the tangent plane
    double residual;      ///< standard deviation of the heights from the fit; 0 unless asked for
    bool ok;              ///< false: too few points, points that do not determine the fit, or a value that is not finite
};

/// What `fit_jets` reads.
struct JetProblem {
    std::span<const dvec3> positions;
    std::span<const dvec3> normals; ///< indexed like `positions`; set the height direction, any length but 0
    const Neighbourhoods* hoods = nullptr;
    bool with_residual = false;     ///< fill Jet::residual
};

/// Fits a height polynomial at every centre and returns the differential quantities of its graph (curvature-jets
/// specification, section 3), in double, several vertices at a time with the widest vectors of the machine. The result
/// for a vertex does not depend on the others in the call.
/// @param out  one for each centre
void fit_jets(const JetProblem& problem, JetModel model, std::span<Jet> out);

} // namespace limn
