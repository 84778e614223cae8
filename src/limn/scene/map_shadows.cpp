#include "limn/scene/map_shadows.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/shadow/map_occlusion.h"

namespace limn {
namespace {

/// Maps with the look-up in them.
struct HeldMaps {
    explicit HeldMaps(const ShadowMaps& of) : maps(of), look(maps.layout(), maps) {}
    ShadowMaps maps;
    LookUp<ShadowMaps> look;
};

/// Rays against some parts of a scene.
class PartRays : public Occlusion {
public:
    explicit PartRays(const std::vector<RayTriangles>& parts) : rays_(parts), occlusion_(rays_) {}
    void look(const vec3& from, std::span<const LightPlace> to, std::uint8_t* lit) const override { occlusion_.look(from, to, lit); }
    bool may_hide(const vec3& from, const Ball& light) const override { return occlusion_.may_hide(from, light); }

private:
    RayScene rays_;
    RayOcclusion occlusion_;
};

RayTriangles triangles_of(const SeenScene& scene, std::size_t part)
{
    if (scene.first_face.empty())
        return scene.objects[part].triangles;
    const RayTriangles& all = scene.objects.front().triangles;
    return {all.positions, all.triangles.subspan(scene.first_face[part], scene.first_face[part + 1] - scene.first_face[part])};
}

} // namespace

std::shared_ptr<const Occlusion> map_shadows(const ObjectMaps& maps, std::span<const dmat4> transforms, const SeenScene& scene)
{
    std::map<const ShadowMaps*, std::shared_ptr<const HeldMaps>> held;
    std::vector<MapOcclusion<ShadowMaps>::Object> objects;
    std::vector<RayTriangles> others;
    for (std::size_t i = 0; i < maps.size(); ++i) {
        if (!maps[i]) {
            others.push_back(triangles_of(scene, i));
            continue;
        }
        std::shared_ptr<const HeldMaps>& own = held[maps[i].get()];
        if (!own)
            own = std::make_shared<const HeldMaps>(*maps[i]);
        objects.push_back({std::shared_ptr<const LookUp<ShadowMaps>>(own, &own->look), unit_placement(maps[i]->info().sphere, transforms[i], scene.centre, scene.scale)});
    }
    std::shared_ptr<const Occlusion> rays;
    if (!others.empty())
        rays = std::make_shared<const PartRays>(others);
    return std::make_shared<const MapOcclusion<ShadowMaps>>(std::move(objects), *scene.rays, std::move(rays));
}

void hide_by_maps(ShadeOptions& options, ShadowMethod method, const ObjectMaps& maps, std::span<const dmat4> transforms, const SeenScene& scene)
{
    const bool has_maps = std::any_of(maps.begin(), maps.end(), [](const auto& own) { return own != nullptr; });
    if (method == ShadowMethod::maps && !has_maps)
        throw Error::Input("--shadow csm: no object has maps; give some with --shadow-maps FILE.csm, which 'limn shadow bake' makes");
    if (has_maps && (method == ShadowMethod::maps || method == ShadowMethod::automatic))
        options.occlusion = map_shadows(maps, transforms, scene);
}

ObjectMaps match_maps(std::span<const std::filesystem::path> files, std::span<const std::uint64_t> shapes)
{
    ObjectMaps matched(shapes.size());
    for (const std::filesystem::path& file : files) {
        const auto maps = std::make_shared<const ShadowMaps>(read_csm(file));
        bool fits = false;
        for (std::size_t i = 0; i < shapes.size(); ++i)
            if (shapes[i] == maps->info().shape)
                matched[i] = maps, fits = true;
        if (!fits)
            throw Error::Read(fmt::format("{}: was baked of another model than is shown; bake it anew", file.string()));
    }
    return matched;
}

} // namespace limn
