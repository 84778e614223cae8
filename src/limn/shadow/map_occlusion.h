#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "limn/raycast/occlusion.h"
#include "limn/shadow/look_up.h"
#include "limn/shadow/shadow_caster.h"

namespace limn {

/// Places of a scene's frame in the unit space of an object's maps: turn * place + shift. Rotation, uniform scale and translation alone.
struct UnitPlacement {
    glm::mat3 turn = glm::mat3(1);
    vec3 shift = vec3(0);
};

/// @param sphere     of the object, in its own space @param to_world  that places the object
/// @param centre, scale  of the frame, whose places are (world - centre) / scale
inline UnitPlacement unit_placement(const BoundingSphere& sphere, const dmat4& to_world, const dvec3& centre, double scale)
{
    const dmat4 to_own = glm::inverse(to_world);
    const dvec3 shift = dvec3(to_own * dvec4(centre, 1)) - sphere.centre;
    return {glm::mat3(dmat3(to_own) * (scale / sphere.radius)), vec3(shift / sphere.radius)};
}

/// By maps of some objects, whose copies share them, and by rays for the others. Light is hidden where any of them hides it.
template <class Depths> class MapOcclusion : public Occlusion {
public:
    struct Object {
        std::shared_ptr<const LookUp<Depths>> maps; ///< not null
        UnitPlacement place;
    };
    /// @param all     rays against all objects, where maps cannot tell: it has to outlive this
    /// @param others  rays against those without maps, or null where there is none
    MapOcclusion(std::vector<Object> objects, const RayScene& all, std::shared_ptr<const Occlusion> others = nullptr)
        : objects_(std::move(objects)), all_(all), others_(std::move(others))
    {
    }

    void look(const vec3& from, std::span<const LightPlace> to, std::uint8_t* lit) const override
    {
        for (std::size_t first = 0; first < to.size(); first += together)
            look_at_some(from, to.subspan(first, std::min(together, to.size() - first)), lit + first);
    }

    bool may_hide(const vec3& from, const Ball& light) const override
    {
        if (others_ && others_->may_hide(from, light))
            return true;
        for (const Object& object : objects_) {
            const float scale = glm::length(object.place.turn[0]);
            if (may_be_between(object.place.turn * from + object.place.shift, {object.place.turn * light.centre + object.place.shift, scale * light.radius}, {vec3(0), 1.0f}))
                return true;
        }
        return false;
    }

private:
    static constexpr std::size_t together = 64;

    void look_at_some(const vec3& from, std::span<const LightPlace> to, std::uint8_t* lit) const
    {
        if (others_)
            others_->look(from, to, lit);
        else
            std::fill_n(lit, to.size(), std::uint8_t(1));
        std::array<ShadowEnd, together> ends;
        std::array<Verdict, together> verdicts;
        std::array<bool, together> unknown = {};
        for (const Object& object : objects_) {
            const vec3 own_from = object.place.turn * from + object.place.shift;
            for (std::size_t k = 0; k < to.size(); ++k) {
                const vec4& q = to[k].place;
                ends[k] = {vec4(object.place.turn * vec3(q) + q.w * object.place.shift, q.w), to[k].among};
            }
            object.maps->at(own_from, {ends.data(), to.size()}, verdicts);
            for (std::size_t k = 0; k < to.size(); ++k) {
                lit[k] = lit[k] && verdicts[k] != Verdict::dark;
                unknown[k] = unknown[k] || verdicts[k] == Verdict::unknown;
            }
        }
        for (std::size_t k = 0; k < to.size(); ++k)
            if (lit[k] && unknown[k])
                all_.look(from, to.subspan(k, 1), lit + k);
    }

    std::vector<Object> objects_;
    RayOcclusion all_;
    std::shared_ptr<const Occlusion> others_;
};

} // namespace limn
