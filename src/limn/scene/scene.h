#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "limn/camera/camera.h"
#include "limn/drawing/style.h"
#include "limn/geometry/mesh.h"
#include "limn/lines/image_lines.h"
#include "limn/lines/options.h"
#include "limn/lines/shader_lines.h"
#include "limn/pattern/options.h"
#include "limn/raycast/material.h"
#include "limn/scene/render_options.h"
#include "limn/scene/subdivision_options.h"
#include "limn/surface/estimate.h"

namespace limn {

/// A model with its place in the world and its looks.
struct SceneObject {
    std::filesystem::path file;       ///< with the model, in any mesh format
    std::string format;               ///< of the file, whatever its name ends in; "" takes the ending
    std::shared_ptr<const Mesh> mesh; ///< the model itself, instead of a file; not null in scenes made in memory
    std::string name;                 ///< for reports; may be ""
    dmat4 transform = dmat4(1);       ///< model to world: rotation, uniform scale and translation
    std::filesystem::path shadow_maps; ///< of the model (limn shadow bake); "": it has none
    std::variant<std::string, Material> material = ""; ///< the name of one of the scene's materials or one of its own; "": the usual one
};

/// Light from the eye.
struct Headlight {};
/// Light from far away. `direction` is towards it, of any length above 0, in the world.
struct DistantLight {
    dvec3 direction = {0, 0, 1};
};
/// A point light in the world.
struct Lamp {
    dvec3 place = {0, 0, 0};
};
using Light = std::variant<Headlight, DistantLight, Lamp, SphereLight, RectangleLight, EnvironmentFile>;

/// Where a scene is looked at from: a whole camera, or a side from which all of it is framed.
struct SceneView {
    std::optional<Camera> camera; ///< where it is given, the rest does not matter
    std::string view;             ///< as Framing::view; "": iso
    char up_axis = 0;             ///< 'y' or 'z'; 0: as the first file's format has it
    std::optional<ivec2> size;    ///< of the picture, pixels
    double fov_degrees = Camera().fov_degrees;
    bool orthographic = false;
};

LineOptions no_lines();

/// 'z' for the formats of 3D printing (stl, 3mf), 'y' otherwise. @param format  an ending
char usual_up_axis(std::string_view format);
dvec3 up_vector(char up_axis);

/// Everything that a picture is made of. A value: copy it, change it, keep several.
struct Scene {
    std::vector<SceneObject> objects;
    std::map<std::string, Material> materials;
    std::vector<Light> lights;  ///< at most one is shaded with so far; empty: the one of `render`
    SceneView view;
    EstimateOptions surface;    ///< how curvature is estimated
    SubdivisionOptions subdivision; ///< whether models are control meshes
    LineOptions lines = no_lines();
    Style style;                ///< of the lines
    RenderOptions render;       ///< `colour` and `shade` are the material of objects without one
    ImageLineOptions image_lines;
    PatternOptions pattern;     ///< what surfaces are made of, where that is not plain
    ShaderLineOptions shader_lines; ///< its limit and feature size are those of `lines`
};

/// The materials of all objects, in their order. @throws Error::Input naming an object whose material the scene does not have.
std::vector<Material> object_materials(const Scene& scene, const Material& usual);

/// `options` with a scene's lights in place of its own, where the scene has any. @throws Error::Input for more than one light.
RenderOptions lit_by(const std::vector<Light>& lights, RenderOptions options);

/// Whether a matrix is a rotation, a uniform scale between 1e-9 and 1e9 and a translation up to 1e15; and "shears or scales unevenly", "mirrors", ...
/// otherwise ("" where it is).
std::string transform_fault(const dmat4& transform);

/// The axis of the scene that points up: what its view says, or usual_up_axis of its first object.
char up_axis_of(const Scene& scene);

/// For each object the first one that shows the same model: files are read once.
std::vector<std::size_t> first_of_same_model(const std::vector<SceneObject>& objects);

} // namespace limn
