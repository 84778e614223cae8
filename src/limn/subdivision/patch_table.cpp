#include "limn/subdivision/patch_table.h"

#include <map>

#include "limn/base/parallel.h"
#include "limn/subdivision/loop_refine.h"
#include "limn/subdivision/loop_walk.h"
#include "limn/subdivision/patch_class.h"
#include "limn/subdivision/patch_neighbourhood.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1024;

using RegularPoints = std::array<std::uint32_t, regular_support>;

/// @return whether the face is regular in the simplest way, without creases
bool is_regular(const LoopTopology& t, std::uint32_t face, RegularPoints& points)
{
    std::uint32_t a[6], b[6], c[6];
    if (!six_around(t, 3 * face, a) || !six_around(t, 3 * face + 1, b) || !six_around(t, 3 * face + 2, c))
        return false;
    points = {t.triangles[face].x, t.triangles[face].y, t.triangles[face].z, a[2], a[3], a[4], a[5], b[3], b[4], b[5], c[3], c[4]};
    return true;
}

PatchClass regular_class()
{
    PatchClass out;
    out.support = regular_support;
    out.nodes = {{PatchClass::Kind::patch, 0, 0}};
    for (const std::array<double, regular_support>& weights : box_spline_weights())
        out.weights.insert(out.weights.end(), weights.begin(), weights.end());
    return out;
}

} // namespace

PatchTable::PatchTable(LoopTopology control) : control_(std::move(control)), refined_(refine(control_)), edges_(control_), classes_{regular_class()}
{
    const std::size_t faces = refined_.triangles.size();
    std::vector<RegularPoints> points(faces);
    class_.assign(faces, regular);
    parallel_each(faces, grain, [&](std::size_t f) {
        if (!is_regular(refined_, std::uint32_t(f), points[f]))
            class_[f] = none;
    });
    struct Known {
        std::uint32_t number;
        std::vector<std::uint32_t> support;
    };
    std::map<std::vector<std::uint32_t>, Known> known;
    first_.push_back(0);
    for (std::uint32_t f = 0; f < faces; ++f) {
        if (class_[f] == regular) {
            support_.insert(support_.end(), points[f].begin(), points[f].end());
        } else {
            const Neighbourhood around = neighbourhood_of(refined_, f);
            const auto [at, is_new] = known.try_emplace(neighbourhood_key(around.topology));
            if (is_new) {
                NewClass made = make_patch_class(around.topology);
                at->second = {std::uint32_t(classes_.size()), std::move(made.support)};
                classes_.push_back(std::move(made.patches));
            }
            class_[f] = at->second.number;
            for (const std::uint32_t v : at->second.support)
                support_.push_back(around.vertices[v]);
        }
        first_.push_back(support_.size());
    }
}

} // namespace limn
