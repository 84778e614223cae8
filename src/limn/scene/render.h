#pragma once

#include <string>

#include "limn/base/image.h"
#include "limn/drawing/drawing.h"
#include "limn/raycast/ray_scene.h"
#include "limn/scene/loop_model.h"
#include "limn/scene/map_shadows.h"
#include "limn/scene/pixel_painter.h"
#include "limn/scene/scene.h"

namespace limn {

/// A scene's objects ready to be seen from any side: read, their surfaces estimated, and joined in one world.
struct SceneModel {
    LineModel lines;
    RayScene rays; ///< build_ray_scene of `lines`
    Bounds bounds; ///< in the world
    std::vector<PlacedLoop> loops; ///< the objects, where they are control meshes; `lines` then has fine meshes
    ObjectMaps shadow_maps;        ///< of the objects
    std::vector<dmat4> transforms; ///< of the objects, to the world
};

/// Reads every model once. Multi-threaded; same bytes for any number of threads. Fine meshes of control meshes are near enough to the limit surface for
/// pictures of 2000 pixels that show the whole scene.
/// @throws Error::Read for a file that cannot be read and for maps of another model; Error::Input for a scene without objects, for an object whose
///         transform is no similarity (transform_fault), and for control meshes with maps.
SceneModel prepare_scene(const Scene& scene);

/// How a scene is painted: its lights, the materials of its objects, and its lines per pixel.
/// @param model  prepare_scene's @param lines, seen  of it or of its control meshes as cut for a camera
/// @throws Error::Input as object_materials, lit_by and hide_by_maps; as load.
PixelOptions pixel_options(const Scene& scene, const SceneModel& model, const LineModel& lines, const SeenScene& seen);

/// The picture that `limn render` makes of a scene, RGB, of the camera's size. The scene's own view is not looked at.
/// @param model   prepare_scene of the same objects, made once for many cameras
/// @param device  as PixelPainter has it
/// @throws Error::Input for options out of range, materials that the scene does not have, and more than one light.
Image render(const Scene& scene, const SceneModel& model, const Camera& camera, const std::string& device = "cpu");
Image render(const Scene& scene, const Camera& camera);

/// The lines of a scene, as `limn draw` finds them. `lines` of a default-made scene asks for none.
Drawing draw(const Scene& scene, const SceneModel& model, const Camera& camera);
Drawing draw(const Scene& scene, const Camera& camera);

} // namespace limn
