#include "limn/scene/subdivision_options.h"

namespace limn {

const OptionTable<SubdivisionOptions>& subdivision_option_table()
{
    using Options = SubdivisionOptions;
    using Scheme = Options::Scheme;
    using Silhouette = Options::Silhouette;
    using Normals = Options::Normals;
    static const OptionTable<Options> table = {
        choice_row<Options, Scheme>("subdivision", {{"none", Scheme::polygons}, {"loop", Scheme::loop}}, "take models for control meshes and show their limit surface",
                                    &Options::scheme),
        choice_row<Options, Silhouette>("silhouette", {{"exact", Silhouette::exact}, {"seed", Silhouette::seed}, {"off", Silhouette::off}},
                                        "how the shaded mesh is cut along the contours of the limit surface", &Options::silhouette),
        number_row<Options>("outline-error", "px", 0.01, 100, "how far outlines and lines may be from those of the limit surface", &Options::outline_error),
        number_row<Options>("surface-error", "px", 0, 1000, "how far shaded triangles may be from the limit surface inside of outlines; 0: any distance",
                            &Options::surface_error),
        number_row<Options>("base-levels", "", 0, 6, "subdivide the control mesh so often first", &Options::base_levels),
        number_row<Options>("depth", "", 0, 12, "steps of the seed's search for contours", &Options::depth),
        number_row<Options>("curve-points", "", 0, 64, "parts of the contour in each face; 0: as many as needed", &Options::curve_points),
        choice_row<Options, Normals>("normals", {{"limit", Normals::limit}, {"map", Normals::map}, {"vertex", Normals::vertex}},
                                     "shade with the limit surface's normal at each pixel (on a GPU: from a map), from a normal map, or between vertices", &Options::normals),
        number_row<Options>("map-size", "texels", 16, 8192, "side of the normal map", &Options::map_size),
        choice_row<Options, CreaseRule>("crease-rule",
                                        {{"opensubdiv", CreaseRule::opensubdiv}, {"hoppe", CreaseRule::hoppe}, {"biermann", CreaseRule::biermann}},
                                        "how sharp edges and what lies beside them are subdivided", &Options::crease_rule),
        number_row<Options>("sharp-angle", "degrees", 0, 180, "keep edges of control meshes sharp where faces turn by more; 0 is off", &Options::sharp_angle),
        switch_row<Options>("crease-tags", "keep edges sharp that an OBJ file tags", &Options::crease_tags)};
    return table;
}

} // namespace limn
