#include "limn/surface/tensor.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "limn/base/parallel.h"
#include "limn/surface/tangent.h"
#include "limn/surface/vertex_areas.h"

namespace limn {
namespace {

constexpr std::size_t grain = 2048;

/// A face in its own plane. Edge k is opposite to corner k; lengths in units of the longest edge, so that the fits are
/// conditioned alike at any scale.
struct FaceFrame {
    TangentFrame basis;
    dvec2 edge[3];
    double unit = 0; ///< length of the longest edge; 0: the face has no area
};

FaceFrame face_frame(const Mesh& mesh, const uvec3& t)
{
    const dvec3 p[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
    const dvec3 edge[3] = {p[2] - p[1], p[0] - p[2], p[1] - p[0]};
    FaceFrame face;
    face.basis.n = unit_or_zero(glm::cross(edge[0], edge[1]));
    face.basis.u = unit_or_zero(edge[0]);
    face.basis.v = glm::cross(face.basis.n, face.basis.u);
    const double longest = std::max({glm::length(edge[0]), glm::length(edge[1]), glm::length(edge[2])});
    if (face.basis.n == dvec3(0) || !(longest > 0))
        return face;
    for (int k = 0; k < 3; ++k)
        face.edge[k] = dvec2(glm::dot(edge[k], face.basis.u), glm::dot(edge[k], face.basis.v)) / longest;
    face.unit = longest;
    return face;
}

/// Least squares from a symmetric normal matrix; 0 where it is singular.
template <int N> Eigen::Vector<double, N> solve(const Eigen::Matrix<double, N, N>& matrix, const Eigen::Vector<double, N>& right)
{
    const Eigen::LDLT<Eigen::Matrix<double, N, N>> factors(matrix);
    if (factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > 1e-14 * matrix.diagonal().maxCoeff()))
        return Eigen::Vector<double, N>::Zero();
    return factors.solve(right);
}

SecondForm fit_form(const FaceFrame& face, const dvec3 normals[3])
{
    double uu = 0, uv = 0, vv = 0;
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
        const double u = face.edge[k].x, v = face.edge[k].y;
        const dvec3 difference = normals[(k + 2) % 3] - normals[(k + 1) % 3];
        const double du = glm::dot(difference, face.basis.u), dv = glm::dot(difference, face.basis.v);
        uu += u * u;
        uv += u * v;
        vv += v * v;
        right += Eigen::Vector3d(du * u, du * v + dv * u, dv * v);
    }
    Eigen::Matrix3d matrix;
    matrix << uu, uv, 0, uv, uu + vv, uv, 0, uv, vv;
    const Eigen::Vector3d x = solve<3>(matrix, right) / face.unit;
    return {x[0], x[1], x[2]};
}

dvec4 fit_derivative(const FaceFrame& face, const SecondForm forms[3])
{
    double uu = 0, uv = 0, vv = 0;
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (int k = 0; k < 3; ++k) {
        const double u = face.edge[k].x, v = face.edge[k].y;
        const SecondForm &from = forms[(k + 1) % 3], &to = forms[(k + 2) % 3];
        const double da = to.a - from.a, db = to.b - from.b, dc = to.c - from.c;
        uu += u * u;
        uv += u * v;
        vv += v * v;
        right += Eigen::Vector4d(u * da, v * da + 2 * u * db, 2 * v * db + u * dc, v * dc);
    }
    Eigen::Matrix4d matrix;
    matrix << uu, uv, 0, 0,
              uv, 2 * uu + vv, 2 * uv, 0,
              0, 2 * uv, uu + 2 * vv, uv,
              0, 0, uv, vv;
    const Eigen::Vector4d x = solve<4>(matrix, right) / face.unit;
    return {x[0], x[1], x[2], x[3]};
}

class TensorEstimate {
public:
    TensorEstimate(const Mesh& mesh, const VertexFaces& faces)
        : mesh_(mesh), faces_(faces), normals_(max_vertex_normals(mesh, faces)), frames_(mesh.positions.size()),
          face_frames_(mesh.triangles.size())
    {
        parallel_each(face_frames_.size(), grain, [&](std::size_t f) { face_frames_[f] = face_frame(mesh_, mesh_.triangles[f]); });
        parallel_each(frames_.size(), grain, [&](std::size_t v) { frames_[v] = any_frame(normals_[v]); });
    }

    void curvature()
    {
        std::vector<SecondForm> forms(face_frames_.size());
        parallel_each(forms.size(), grain, [&](std::size_t f) {
            const uvec3& t = mesh_.triangles[f];
            const dvec3 normals[3] = {normals_[t.x], normals_[t.y], normals_[t.z]};
            if (face_frames_[f].unit > 0)
                forms[f] = fit_form(face_frames_[f], normals);
        });
        principal_.resize(frames_.size());
        parallel_each(frames_.size(), grain, [&](std::size_t v) {
            SecondForm sum;
            gather(v, [&](std::uint32_t f, double weight, const PlaneRotation& turn) { sum.add(weight, rotate(forms[f], turn)); });
            principal_[v] = principal_frame(sum);
            const PlaneRotation r = principal_[v].rotation;
            frames_[v] = {r.c * frames_[v].u + r.s * frames_[v].v, r.c * frames_[v].v - r.s * frames_[v].u, frames_[v].n};
        });
    }

    void derivative()
    {
        std::vector<dvec4> tensors(face_frames_.size());
        parallel_each(tensors.size(), grain, [&](std::size_t f) {
            if (!(face_frames_[f].unit > 0))
                return;
            SecondForm forms[3];
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t v = mesh_.triangles[f][k];
                forms[k] = rotate(SecondForm{principal_[v].k1, 0, principal_[v].k2}, transport(frames_[v], face_frames_[f].basis));
            }
            tensors[f] = fit_derivative(face_frames_[f], forms);
        });
        derivative_.resize(frames_.size());
        parallel_each(frames_.size(), grain, [&](std::size_t v) {
            dvec4 sum(0);
            gather(v, [&](std::uint32_t f, double weight, const PlaneRotation& turn) { sum += weight * rotate(tensors[f], turn); });
            derivative_[v] = sum;
        });
    }

    Surface surface() const
    {
        Surface result;
        const std::size_t vertices = frames_.size();
        for (std::vector<vec3>* directions : {&result.normals, &result.e1, &result.e2})
            directions->resize(vertices);
        result.k1.resize(vertices);
        result.k2.resize(vertices);
        result.derivative.resize(derivative_.size());
        result.unreliable.resize(vertices);
        parallel_each(vertices, grain, [&](std::size_t v) { store(v, result); });
        return result;
    }

private:
    /// Calls add(face, weight, turn) for the faces around v that have area. The weights add up to 1.
    template <class Add> void gather(std::size_t v, Add&& add) const
    {
        double total = 0;
        for (std::uint32_t i = faces_.start[v]; i < faces_.start[v + 1]; ++i)
            total += corner_area(faces_.face[i], v);
        if (!(total > 0))
            return;
        for (std::uint32_t i = faces_.start[v]; i < faces_.start[v + 1]; ++i) {
            const std::uint32_t f = faces_.face[i];
            if (face_frames_[f].unit > 0)
                add(f, corner_area(f, v) / total, transport(face_frames_[f].basis, frames_[v]));
        }
    }

    double corner_area(std::uint32_t f, std::size_t v) const
    {
        const uvec3& t = mesh_.triangles[f];
        return corner_areas(mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z])[corner_of(t, std::uint32_t(v))];
    }

    void store(std::size_t v, Surface& result) const
    {
        const TangentFrame& frame = frames_[v];
        result.normals[v] = vec3(frame.n);
        result.e1[v] = vec3(frame.u);
        result.e2[v] = vec3(frame.v);
        const float k1 = float(principal_[v].k1), k2 = float(principal_[v].k2);
        const vec4 d = derivative_.empty() ? vec4(0) : vec4(derivative_[v]);
        const bool good = frame.n != dvec3(0) && std::isfinite(k1 + k2 + d.x + d.y + d.z + d.w);
        result.unreliable[v] = good ? 0 : 1;
        result.k1[v] = good ? k1 : 0;
        result.k2[v] = good ? k2 : 0;
        if (!derivative_.empty())
            result.derivative[v] = good ? d : vec4(0);
    }

    const Mesh& mesh_;
    const VertexFaces& faces_;
    std::vector<dvec3> normals_;
    std::vector<TangentFrame> frames_;
    std::vector<FaceFrame> face_frames_;
    std::vector<PrincipalFrame> principal_;
    std::vector<dvec4> derivative_;
};

/// The cross product of two edges over both squared lengths, at a scale at which nothing overflows.
dvec3 max_term(dvec3 a, dvec3 b)
{
    const double aa = glm::dot(a, a), bb = glm::dot(b, b);
    return aa > 0 && bb > 0 ? glm::cross(a / aa, b / bb) : dvec3(0);
}

} // namespace

std::vector<dvec3> max_vertex_normals(const Mesh& mesh, const VertexFaces& faces)
{
    std::vector<dvec3> normals(mesh.positions.size());
    parallel_each(normals.size(), grain, [&](std::size_t v) {
        const dvec3& p = mesh.positions[v];
        dvec3 sum(0);
        for (std::uint32_t i = faces.start[v]; i < faces.start[v + 1]; ++i) {
            const uvec3& t = mesh.triangles[faces.face[i]];
            const int k = corner_of(t, std::uint32_t(v));
            sum += max_term(mesh.positions[t[(k + 1) % 3]] - p, mesh.positions[t[(k + 2) % 3]] - p);
        }
        normals[v] = unit_or_zero(sum);
    });
    return normals;
}

Surface estimate_by_tensors(const Mesh& mesh, const VertexFaces& faces, Need need)
{
    TensorEstimate estimate(mesh, faces);
    estimate.curvature();
    if (need == Need::derivative)
        estimate.derivative();
    return estimate.surface();
}

} // namespace limn
