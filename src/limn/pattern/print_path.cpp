#include "limn/pattern/print_path.h"

#include <algorithm>
#include <bitset>
#include <cctype>

namespace limn {
namespace {

struct SlicerWord {
    std::string_view word; ///< in lower case
    BeadFeature feature;
};

using F = BeadFeature;

/// PrusaSlicer's, Cura's, and OrcaSlicer's and BambuStudio's, in this order.
constexpr SlicerWord slicer_words[] = {
    {"external perimeter", F::outer_wall},
    {"perimeter", F::inner_wall},
    {"overhang perimeter", F::overhang},
    {"internal infill", F::infill},
    {"solid infill", F::solid},
    {"top solid infill", F::top},
    {"bridge infill", F::bridge},
    {"internal bridge infill", F::bridge},
    {"thin wall", F::gap},
    {"gap fill", F::gap},
    {"ironing", F::ironing},
    {"skirt", F::skirt},
    {"skirt/brim", F::skirt},
    {"support material", F::support},
    {"support material interface", F::interface},
    {"wipe tower", F::tower},

    {"wall-outer", F::outer_wall},
    {"wall-inner", F::inner_wall},
    {"skin", F::top},
    {"fill", F::infill},
    {"support", F::support},
    {"support-interface", F::interface},
    {"prime-tower", F::tower},

    {"outer wall", F::outer_wall},
    {"inner wall", F::inner_wall},
    {"overhang wall", F::overhang},
    {"floating vertical shell", F::inner_wall},
    {"sparse infill", F::infill},
    {"internal solid infill", F::solid},
    {"top surface", F::top},
    {"bottom surface", F::solid},
    {"bridge", F::bridge},
    {"internal bridge", F::bridge},
    {"gap infill", F::gap},
    {"brim", F::skirt},
    {"support interface", F::interface},
    {"support transition", F::interface},
    {"prime tower", F::tower},
};

constexpr std::string_view names[bead_feature_count] = {
    "outer wall", "inner wall", "overhang", "top",     "solid infill",      "infill",     "bridge",
    "gap fill",   "ironing",    "skirt",    "support", "support interface", "wipe tower", "other"};

} // namespace

std::string_view feature_name(BeadFeature feature) { return names[int(feature)]; }

BeadFeature feature_from_slicer(std::string_view word)
{
    const auto is_it = [&](const SlicerWord& known) {
        return std::equal(word.begin(), word.end(), known.word.begin(), known.word.end(),
                          [](unsigned char a, unsigned char b) { return std::tolower(a) == b; });
    };
    const auto* found = std::find_if(std::begin(slicer_words), std::end(slicer_words), is_it);
    return found == std::end(slicer_words) ? F::other : found->feature;
}

PrintFacts print_facts(const PrintPath& path)
{
    PrintFacts facts;
    std::bitset<256> tools;
    vec3 from = path.start;
    for (const PrintMove& move : path.moves) {
        const double length = glm::length(dvec3(move.to) - dvec3(from));
        (move.extrudes() ? facts.extruded : facts.travel) += length;
        if (move.extrudes()) {
            facts.length[std::size_t(move.feature)] += length;
            tools.set(move.tool);
            ++facts.beads;
            for (const vec3& end : {from, move.to}) {
                const dvec3 aside = {0.5 * double(move.width), 0.5 * double(move.width), 0};
                facts.bounds.add(dvec3(end) + aside);
                facts.bounds.add(dvec3(end) - aside - dvec3(0, 0, double(move.height)));
            }
        }
        from = move.to;
    }
    facts.tools = int(tools.count());
    for (const PrintLayer& layer : path.layers) {
        facts.thinnest = facts.thinnest == 0 ? double(layer.height) : std::min(facts.thinnest, double(layer.height));
        facts.thickest = std::max(facts.thickest, double(layer.height));
    }
    return facts;
}

} // namespace limn
