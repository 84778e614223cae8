#include "limn/camera/matrices.h"

#include <cmath>

namespace limn {

dmat4 view_matrix(const Camera& camera)
{
    const dvec3 right = camera.right(), above = camera.above(), back = -camera.forward();
    dmat4 view(1);
    for (int k = 0; k < 3; ++k)
        view[k] = dvec4(right[k], above[k], back[k], 0);
    view[3] = dvec4(-glm::dot(right, camera.eye), -glm::dot(above, camera.eye), -glm::dot(back, camera.eye), 1);
    return view;
}

dmat4 projection_matrix(const Camera& camera, double near, double far)
{
    const double aspect = double(camera.size.x) / double(camera.size.y);
    dmat4 projection(0);
    if (camera.orthographic) {
        projection[0][0] = 2 / (camera.ortho_height * aspect);
        projection[1][1] = 2 / camera.ortho_height;
        projection[2][2] = 2 / (near - far);
        projection[3][2] = (far + near) / (near - far);
        projection[3][3] = 1;
        return projection;
    }
    const double cotangent = 1 / std::tan(glm::radians(camera.fov_degrees) / 2);
    projection[0][0] = cotangent / aspect;
    projection[1][1] = cotangent;
    projection[2][2] = (near + far) / (near - far);
    projection[2][3] = -1;
    projection[3][2] = 2 * near * far / (near - far);
    return projection;
}

dvec3 window_place(const dvec4& clip, const ivec2& size)
{
    const dvec3 device = dvec3(clip) / clip.w;
    return {0.5 * size.x * (device.x + 1), 0.5 * size.y * (1 - device.y), 0.5 * (device.z + 1)};
}

} // namespace limn
