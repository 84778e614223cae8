#pragma once

#include <memory>
#include <string>

#include "limn/raycast/fragment.h"
#include "limn/surface/shapes.h"

namespace limn::test {

/// Generated shapes as a scene, each as an object of its own, in their own coordinates.
struct ShapeScene {
    std::vector<std::vector<vec3>> positions, normals;
    std::vector<std::vector<uvec3>> triangles;
    std::unique_ptr<RayScene> rays;
    SeenScene seen;

    void add(const Shape& shape, const dvec3& offset = dvec3(0))
    {
        std::vector<vec3>& p = positions.emplace_back();
        for (const dvec3& q : shape.mesh.positions)
            p.push_back(vec3(q + offset));
        p.push_back(vec3(0)); // the spare element that the ray tracer reads
        normals.push_back(shape.exact.normals);
        triangles.push_back(shape.mesh.triangles);
    }
    const SeenScene& finish()
    {
        std::vector<RayTriangles> objects;
        for (std::size_t i = 0; i < positions.size(); ++i)
            objects.push_back({{positions[i].data(), positions[i].size() - 1}, triangles[i]});
        rays = std::make_unique<RayScene>(objects);
        for (std::size_t i = 0; i < positions.size(); ++i)
            seen.objects.push_back({objects[i], normals[i]});
        seen.rays = rays.get();
        return seen;
    }
};

inline Shape shape(const std::string& name, std::size_t triangles)
{
    ShapeOptions options;
    options.name = name, options.triangles = triangles;
    return make_shape(options);
}

/// Looks along -z at [-1.2, 1.2]^2 of the plane z = 0.
inline Camera orthographic_camera(int size)
{
    Camera camera;
    camera.orthographic = true;
    camera.ortho_height = 2.4;
    camera.size = {size, size};
    return camera;
}

} // namespace limn::test
