#include "limn/lines/cluster_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace limn {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A float that is not below a number that is not negative.
float rounded_up(double x) { return float(x * (1 + 1e-6)); }

/// The smallest box around points with N components.
template <std::size_t N> struct Box {
    std::array<double, N> low, high;
    Box()
    {
        low.fill(infinity);
        high.fill(-infinity);
    }
    void add(const std::array<double, N>& p)
    {
        for (std::size_t k = 0; k < N; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
    float middle(std::size_t k) const { return float(0.5 * (low[k] + high[k])); }
    /// Measured from the middle as it is stored.
    double half_width(std::size_t k) const { return std::max(high[k] - double(middle(k)), double(middle(k)) - low[k]); }
};

/// One cluster's column in its group.
class Column {
public:
    Column(ClusterBounds& bounds, std::size_t cluster, const ClusterBoundOptions& options)
        : first_(bounds.values.data() + cluster / bound_lanes * bound_rows * bound_lanes + cluster % bound_lanes), options_(options)
    {
    }
    float& operator[](std::size_t row) { return first_[row * bound_lanes]; }
    void put_width(std::size_t row, double width) { (*this)[row] = rounded_up(options_.half_widths * width); }
    template <std::size_t N> void put_middles(std::size_t row, const Box<N>& box, std::size_t first, std::size_t count)
    {
        for (std::size_t k = 0; k < count; ++k)
            (*this)[row + k] = box.middle(first + k);
    }
    template <std::size_t N> void put_widths(std::size_t row, const Box<N>& box, std::size_t first, std::size_t count)
    {
        for (std::size_t k = 0; k < count; ++k)
            put_width(row + k, box.half_width(first + k));
    }
    dvec3 vector(std::size_t row) { return {(*this)[row], (*this)[row + 1], (*this)[row + 2]}; }

private:
    float* first_;
    const ClusterBoundOptions& options_;
};

/// The vertices of the faces, each at least once.
template <class F> void for_corners(const LineModel& model, std::span<const std::uint32_t> faces, F&& f)
{
    for (const std::uint32_t face : faces)
        for (int k = 0; k < 3; ++k)
            f(model.faces[face][k]);
}

dvec3 put_sphere(Column& column, const LineModel& model, std::span<const std::uint32_t> faces)
{
    Box<3> box;
    for_corners(model, faces, [&](std::uint32_t v) { box.add({model.positions[v].x, model.positions[v].y, model.positions[v].z}); });
    column.put_middles(bound_origin, box, 0, 3);
    const dvec3 origin = column.vector(bound_origin);
    double radius = 0;
    for_corners(model, faces, [&](std::uint32_t v) { radius = std::max(radius, glm::distance(dvec3(model.positions[v]), origin)); });
    column[bound_radius] = rounded_up(radius);
    return origin;
}

void put_normals(Column& column, const LineModel& model, std::span<const std::uint32_t> faces, const dvec3& origin)
{
    Box<4> box;
    for_corners(model, faces, [&](std::uint32_t v) {
        const dvec3 n = model.normals[v];
        box.add({n.x, n.y, n.z, glm::dot(n, dvec3(model.positions[v]) - origin)});
    });
    column.put_middles(bound_normal, box, 0, 3);
    column.put_widths(bound_normal_box, box, 0, 3);
    column.put_middles(bound_offset, box, 3, 1);
    column.put_widths(bound_offset_box, box, 3, 1);
    const dvec3 middle = column.vector(bound_normal);
    double ball = 0;
    for_corners(model, faces, [&](std::uint32_t v) { ball = std::max(ball, glm::distance(dvec3(model.normals[v]), middle)); });
    column.put_width(bound_normal_ball, ball);
}

void put_face_normals(Column& column, const LineModel& model, std::span<const std::uint32_t> faces, const dvec3& origin)
{
    Box<3> box;
    std::vector<dvec3> normals(faces.size());
    double offset = infinity, slack = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const uvec3& t = model.faces[faces[i]];
        const dvec3 p = model.positions[t.x], a = dvec3(model.positions[t.y]) - p, b = dvec3(model.positions[t.z]) - p;
        const dvec3 normal = glm::cross(a, b);
        const double area = glm::length(normal);
        slack = area > 0 ? std::max(slack, glm::length(a) * glm::length(b) / area) : infinity;
        normals[i] = area > 0 ? normal / area : dvec3(0);
        offset = std::min(offset, glm::dot(normals[i], p - origin));
        box.add({normals[i].x, normals[i].y, normals[i].z});
    }
    column.put_middles(bound_face_normal, box, 0, 3);
    const dvec3 middle = column.vector(bound_face_normal);
    double ball = 0;
    for (const dvec3& normal : normals)
        ball = std::max(ball, glm::distance(normal, middle));
    column.put_width(bound_face_ball, ball);
    column[bound_face_offset] = float(offset - 1e-6 * std::abs(offset));
    column[bound_face_slack] = rounded_up(1 + slack);
}

/// S, S q and q.S q of a vertex as a point: xx yy zz xy xz yz, x y z, 1.
std::array<double, 10> form_at(const LineModel& model, std::uint32_t v, const dvec3& origin)
{
    const dvec3 a = model.e1[v], b = model.e2[v], q = dvec3(model.positions[v]) - origin;
    const double k1 = model.k1[v], k2 = model.k2[v];
    const dvec3 s = k1 * glm::dot(a, q) * a + k2 * glm::dot(b, q) * b;
    const auto entry = [&](int i, int j) { return k1 * a[i] * a[j] + k2 * b[i] * b[j]; };
    return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2), s.x, s.y, s.z, glm::dot(q, s)};
}

/// At least the spectral norm of a symmetric matrix: its Frobenius norm.
double norm_of_difference(const std::array<double, 10>& p, Column& column)
{
    double sum = 0;
    for (std::size_t k = 0; k < 6; ++k)
        sum += (k < 3 ? 1 : 2) * std::pow(p[k] - double(column[bound_form + k]), 2);
    return std::sqrt(sum);
}

void put_forms(Column& column, const LineModel& model, std::span<const std::uint32_t> faces, const dvec3& origin)
{
    Box<10> box;
    double curvature = 0, torsion = 0;
    for_corners(model, faces, [&](std::uint32_t v) {
        box.add(form_at(model, v, origin));
        const double k1 = model.k1[v], k2 = model.k2[v];
        curvature = std::max(curvature, std::abs(k1) + std::abs(k2));
        torsion = std::max(torsion, 0.25 * (k1 - k2) * (k1 - k2));
    });
    column.put_middles(bound_form, box, 0, 10);
    column.put_widths(bound_form_box, box, 0, 10);
    column[bound_curvature] = rounded_up(curvature);
    column[bound_torsion] = rounded_up(torsion);
    std::array<double, 3> ball = {0, 0, 0};
    const dvec3 middle = column.vector(bound_form + 6);
    for_corners(model, faces, [&](std::uint32_t v) {
        const std::array<double, 10> p = form_at(model, v, origin);
        ball[0] = std::max(ball[0], norm_of_difference(p, column));
        ball[1] = std::max(ball[1], glm::distance(dvec3(p[6], p[7], p[8]), middle));
        ball[2] = std::max(ball[2], std::abs(p[9] - double(column[bound_form + 9])));
    });
    for (std::size_t k = 0; k < 3; ++k)
        column.put_width(bound_form_ball + k, ball[k]);
}

/// The derivative tensor in space: xxx yyy zzz, xxy xxz yyx yyz zzx zzy, xyz.
std::array<double, 10> cubic_at(const LineModel& model, std::uint32_t v)
{
    const dvec3 a = model.e1[v], b = model.e2[v];
    const dvec4 c = model.derivative[v];
    const auto entry = [&](int i, int j, int k) {
        return c.x * a[i] * a[j] * a[k] + c.y * (a[i] * a[j] * b[k] + a[i] * b[j] * a[k] + b[i] * a[j] * a[k]) +
               c.z * (a[i] * b[j] * b[k] + b[i] * a[j] * b[k] + b[i] * b[j] * a[k]) + c.w * b[i] * b[j] * b[k];
    };
    return {entry(0, 0, 0), entry(1, 1, 1), entry(2, 2, 2), entry(0, 0, 1), entry(0, 0, 2), entry(1, 1, 0), entry(1, 1, 2),
            entry(2, 2, 0), entry(2, 2, 1), entry(0, 1, 2)};
}

void put_cubics(Column& column, const LineModel& model, std::span<const std::uint32_t> faces)
{
    Box<10> box;
    double norm = 0;
    for_corners(model, faces, [&](std::uint32_t v) {
        box.add(cubic_at(model, v));
        const dvec4 c = model.derivative[v];
        norm = std::max(norm, std::sqrt(c.x * c.x + 3 * c.y * c.y + 3 * c.z * c.z + c.w * c.w));
    });
    column.put_middles(bound_cubic, box, 0, 10);
    column.put_widths(bound_cubic_box, box, 0, 10);
    column[bound_cubic_norm] = rounded_up(norm);
}

bool is_zero_or_unit(const dvec3& v)
{
    const double length = glm::dot(v, v);
    return length == 0 || std::abs(length - 1) < 4e-5;
}

/// The proofs of the bounds need finite numbers, unit normals and orthonormal frames (or none).
bool is_regular(const LineModel& model, std::uint32_t v)
{
    if (!is_zero_or_unit(model.normals[v]))
        return false;
    if (!model.has_curvature())
        return true;
    const dvec3 n = model.normals[v], a = model.e1[v], b = model.e2[v];
    const double skew = std::max({std::abs(glm::dot(a, b)), std::abs(glm::dot(a, n)), std::abs(glm::dot(b, n))});
    const double curvature = std::abs(double(model.k1[v])) + std::abs(double(model.k2[v]));
    const vec4 c = model.has_derivative() ? model.derivative[v] : vec4(0);
    return is_zero_or_unit(a) && is_zero_or_unit(b) && skew < 2e-5 && curvature < 1e15 && glm::dot(dvec4(c), dvec4(c)) < 1e30;
}

/// Bounds that no test rejects.
void put_unknown(Column& column)
{
    for (std::size_t row = bound_radius; row < bound_rows; ++row)
        column[row] = std::numeric_limits<float>::quiet_NaN();
}

} // namespace

void write_cluster_bounds(ClusterBounds& bounds, std::size_t cluster, const LineModel& model, std::span<const std::uint32_t> faces,
                          std::size_t candidates, const ClusterBoundOptions& options)
{
    Column column(bounds, cluster, options);
    bool regular = true;
    for_corners(model, faces, [&](std::uint32_t v) { regular = regular && is_regular(model, v); });
    if (!regular)
        return put_unknown(column);
    const dvec3 origin = put_sphere(column, model, faces);
    put_normals(column, model, faces, origin);
    const std::span<const std::uint32_t> chosen = faces.first(candidates);
    if (chosen.empty() || !model.has_derivative()) {
        column[bound_curvature] = -1;
        return;
    }
    put_face_normals(column, model, chosen, origin);
    put_forms(column, model, chosen, origin);
    put_cubics(column, model, chosen);
}

} // namespace limn
