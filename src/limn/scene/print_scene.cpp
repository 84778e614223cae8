#include "limn/scene/print_scene.h"

#include <algorithm>

namespace limn {
namespace {

constexpr float travel_thickness = 4e-3f; ///< in the frame, whose print is 2 long

class BeadOcclusion : public Occlusion {
public:
    explicit BeadOcclusion(const BeadScene& beads) : beads_(beads) {}
    bool may_hide(const vec3& from, const Ball& light) const override { return may_be_between(from, light, {vec3(0), 1.1f}); }
    void look(const vec3& from, std::span<const LightPlace> to, std::uint8_t* lit) const override
    {
        for (std::size_t i = 0; i < to.size(); ++i) {
            const vec3 way = vec3(to[i].place) - to[i].place.w * from;
            const float length = glm::length(way);
            const float far = to[i].place.w > 0 ? length : std::numeric_limits<float>::infinity();
            lit[i] = !(length > 0) || !beads_.occluded({from, way / length, 0, far});
        }
    }

private:
    const BeadScene& beads_;
};

} // namespace

SeenPrint see_print(const PrintPath& path, const PrintOptions& options)
{
    if (std::size_t(options.first_layer) > path.layers.size())
        throw Error::Input(fmt::format("--layers: the print has {} layers, and none from {} on", path.layers.size(), options.first_layer));
    const Bounds bounds = print_facts(path).bounds;
    const dvec3 centre = bounds.centre();
    const double scale = bounds.radius();
    const auto in_frame = [&](const vec3& place, float height) {
        return vec3((dvec3(place) - dvec3(0, 0, 0.5 * double(height)) - centre) / scale);
    };
    std::vector<BeadShape> beads;
    std::vector<std::uint32_t> moves;
    vec3 from = path.start;
    for (std::size_t i = 0; i < path.moves.size(); ++i) {
        const PrintMove& move = path.moves[i];
        const bool in_range = int(move.layer) + 1 >= options.first_layer && int(move.layer) + 1 <= options.last_layer;
        if (in_range && (move.extrudes() || options.travel)) {
            const float thin = travel_thickness;
            const Bead bead = move.extrudes() ? Bead{in_frame(from, move.height), in_frame(move.to, move.height),
                                                     float(double(move.width) / scale), float(double(move.height) / scale)}
                                              : Bead{in_frame(from, 0), in_frame(move.to, 0), thin, thin};
            beads.emplace_back(bead);
            moves.push_back(std::uint32_t(i));
        }
        from = move.to;
    }
    if (beads.empty())
        throw Error::Input("--layers: the layers asked for hold no bead");
    return {bounds, centre, scale, BeadScene(std::move(beads)), std::move(moves)};
}

std::shared_ptr<const Occlusion> bead_occlusion(const SeenPrint& print) { return std::make_shared<BeadOcclusion>(print.scene); }

} // namespace limn
