#include "limn/surface/jet_fit.h"

#include <array>
#include <cstddef>
#include <utility>

// Compiled once for each instruction set below; the best one of the machine is chosen at run time. Scalable vectors
// cannot be kept in arrays, and the two left out of x86 gain nothing over their neighbours here.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "limn/surface/jet_fit.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "limn/surface/jet_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

using FitFunction = void (*)(const JetProblem&, std::span<Jet>);

void fit_with_model(const JetProblem& problem, JetModel model, std::span<Jet> out)
{
    constexpr std::array<std::array<FitFunction, 2>, 3> functions = {{
        {&fit_batches<2, false>, &fit_batches<2, true>},
        {&fit_batches<3, false>, &fit_batches<3, true>},
        {&fit_batches<4, false>, &fit_batches<4, true>},
    }};
    functions[std::size_t(model.degree - 2)][model.interpolating ? 1 : 0](problem, out);
}

} // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

HWY_EXPORT(fit_with_model);

void Neighbourhoods::clear()
{
    centre.clear();
    start.assign(1, 0);
    neighbour.clear();
}

void Neighbourhoods::close(std::uint32_t vertex)
{
    centre.push_back(vertex);
    start.push_back(std::uint32_t(neighbour.size()));
}

void fit_jets(const JetProblem& problem, JetModel model, std::span<Jet> out)
{
    HWY_DYNAMIC_DISPATCH(fit_with_model)(problem, model, out);
}

} // namespace limn
#endif
