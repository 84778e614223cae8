#include "limn/subdivision/control_samples.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "limn/base/error.h"
#include "limn/subdivision/control_shapes.h"

namespace limn {
namespace {

struct Sample {
    const char* name;
    Mesh (*make)();
};

constexpr Sample samples[] = {{"creature", creature_cage}, {"rook", rook_cage}, {"mug", mug_cage},
                              {"bracket", bracket_cage}, {"leaf", leaf_cage}, {"bent-cylinder", bent_cylinder_cage}};

} // namespace

Mesh make_control_sample(std::string_view name)
{
    const auto* found = std::find_if(std::begin(samples), std::end(samples), [&](const Sample& s) { return s.name == name; });
    if (found == std::end(samples))
        throw Error::Input(fmt::format("there is no control mesh '{}'; known are {}", name, fmt::join(control_sample_names(), ", ")));
    return found->make();
}

const std::vector<std::string>& control_sample_names()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const Sample& sample : samples)
            all.emplace_back(sample.name);
        return all;
    }();
    return names;
}

} // namespace limn
