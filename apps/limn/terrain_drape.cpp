#include "terrain_drape.h"

#include "limn/drawing/png.h"
#include "limn/scene/terrain_picture.h"

using namespace limn;

namespace {

/// Opaque, the colours where the drape is transparent mixed with white.
Image without_alpha(const Image& drape)
{
    Image image(drape.size(), 3);
    for (std::size_t i = 0; i < drape.samples.size() / 4; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            image.samples[3 * i + k] = glm::mix(1.0f, drape.samples[4 * i + k], drape.samples[4 * i + 3]);
    return image;
}

} // namespace

void add_drape_option(CLI::App& app, std::string& file)
{
    app.add_option("--drape", file, "an image to lay on the terrain (GeoTIFF, PNG, JPEG and more): by its georeference, else stretched over the map; for png and meshes in glb and ply")
        ->type_name("IMAGE")
        ->group("Picture");
}

void drape_mesh(Mesh& mesh, const HeightMap& map, const Drape& drape, WriteMeshOptions& options)
{
    if (options.format == "glb") {
        for (const uvec3& t : mesh.triangles)
            for (int k = 0; k < 3; ++k) {
                const dvec2 place = drape_place(map, dvec2(mesh.positions[t[k]]));
                mesh.corner_uvs.emplace_back(place.x, 1 - place.y);
            }
        options.colour_texture = encode_png(without_alpha(drape.colours), {});
    } else if (options.format == "ply" || options.format == "obj") {
        for (const dvec3& p : mesh.positions)
            mesh.colours.push_back(draped_at(map, drape.colours, dvec2(p)));
    }
}
