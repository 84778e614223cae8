#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "limn/camera/camera.h"
#include "limn/lines/prepare.h"
#include "limn/raycast/fragment.h"
#include "limn/raycast/mapped_normals.h"
#include "limn/scene/loop_normals.h"
#include "limn/scene/subdivision_options.h"
#include "limn/subdivision/seed_surface.h"
#include "limn/subdivision/silhouette_mesh.h"
#include "limn/subdivision/silhouette_pose.h"

namespace limn {

/// A mesh for one picture, as SubdivisionOptions::silhouette says.
struct CutMesh {
    SilhouetteMesh silhouette;
    PreparedMesh prepared; ///< of the same triangles, with normals only
    NormalAt normal_at;    ///< of the limit surface, or empty where vertices' are to be interpolated; must not outlive the LoopModel
};

/// A control mesh, ready to be shown from any side.
class LoopModel {
public:
    /// @throws Error::Input for a mesh that cannot be subdivided (make_control_mesh) or becomes too large by `base_levels`, and for faces that do not fit into
    ///         the normal map where one is asked for.
    LoopModel(const Mesh& mesh, const SubdivisionOptions& options);
    LoopModel(const LoopModel&) = delete; ///< the pose looks into the table
    LoopModel& operator=(const LoopModel&) = delete;

    const SilhouettePose& pose() const { return pose_; }
    const std::vector<std::string>& notes() const { return notes_; }
    std::size_t face_count() const { return table_.control().triangles.size(); }
    int base_levels() const { return base_levels_; }
    /// How far edges with their ends on the limit surface, in the mesh so many levels down, are from the surface at their middles: 99 in 100 of them
    /// at most. (Where creases end the surface has points like that of a cone; edges there get no nearer than in proportion to their length.)
    double deviation(int levels = 0) const;

    /// @param camera  in the frame of the control mesh
    CutMesh cut_mesh(const Camera& camera) const;

    /// The normal map that stands for what the options ask of normals. Null where that is those of vertices, and where it is the limit's but the faces do not
    /// fit into a map. Made at the first call.
    const SurfaceMap* map() const;

    /// A fine mesh on the limit surface, for lines: with the limit surface's curvature, split where sharp edges are.
    /// @param levels  below the control mesh and its base levels
    PreparedMesh fine_mesh(int levels, Need need) const;

private:
    struct Refined {
        LoopTopology topology;
        std::vector<dvec3> positions;
    };
    Refined refined(int levels) const;
    SilhouetteMesh silhouette(const Camera& camera) const;

    SubdivisionOptions options_;
    int base_levels_;
    std::vector<std::string> notes_;
    std::vector<dvec3> positions_;
    PatchTable table_;
    SilhouettePose pose_;
    std::optional<SeedSurface> seed_;
    SeedPose seed_pose_;
    mutable std::once_flag map_once_;
    mutable std::optional<const SurfaceMap> map_;
};

/// The camera as it stands to something that a similarity puts into the world.
Camera in_object_frame(const Camera& camera, const dmat4& transform);

/// A control mesh in the world.
struct PlacedLoop {
    std::shared_ptr<const LoopModel> model;
    dmat4 transform = dmat4(1);
};

/// What one camera is shown of control meshes: not to be moved, for its parts look at each other.
struct LoopView {
    LineModel lines;
    RayScene rays;
    SeenScene seen;              ///< with exact normals where the models' options say so
    std::vector<CutMesh> meshes; ///< per object, in its own frame
    std::span<const PlacedLoop> placed;

    /// The same normals for a GPU: from the models' maps, which limit normals are looked up in there too; none where vertices' are to be interpolated.
    MappedNormals mapped_normals() const;
};
/// @param placed  in the order of objects; must outlive the result
std::unique_ptr<const LoopView> make_loop_view(std::span<const PlacedLoop> placed, const Camera& camera);

/// How many levels bring LoopModel::deviation below a length; at most as many as keep the fine mesh below 4 million triangles.
int levels_for(const LoopModel& model, double error);
/// The same for pictures of 2000 pixels that show all of the model. @param outline_error  pixels
int levels_for_whole(const LoopModel& model, double outline_error);

} // namespace limn
