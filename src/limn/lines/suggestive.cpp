#include "limn/lines/suggestive.h"

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/lines/suggestive_face.h"

namespace limn {
namespace {

constexpr std::size_t vertex_grain = 16384, face_grain = 8192;

/// Curvature below this (per model radius) is flat within rounding: the sign of the product k1 k2 says nothing.
constexpr float flat_curvature = 1e-6f;

/// +1 and -1 for convex and concave vertices of positive Gaussian curvature, 0 for all others.
int convexity(float k1, float k2)
{
    if (k1 > flat_curvature && k2 > flat_curvature)
        return 1;
    return k1 < -flat_curvature && k2 < -flat_curvature ? -1 : 0;
}

bool keeps_one_sign(const LineModel& model, const uvec3& t)
{
    const int c = convexity(model.k1[t.x], model.k2[t.x]);
    return c != 0 && c == convexity(model.k1[t.y], model.k2[t.y]) && c == convexity(model.k1[t.z], model.k2[t.z]);
}

bool one_sign(std::span<const std::uint8_t> codes, const uvec3& t)
{
    return (((codes[t.x] ^ codes[t.y]) | (codes[t.x] ^ codes[t.z])) & radially_concave) == 0;
}

/// One extraction: what is read of the model, and which tests run.
class Extraction {
public:
    Extraction(const LineModel& model, const View& view, std::span<const std::uint8_t> codes, const SuggestiveOptions& options, const SuggestiveFaces* faces)
        : model_(model), view_(view), codes_(codes), options_(options), faces_(faces)
    {
    }

    std::vector<Segment> run(SuggestiveCounts& counts) const
    {
        const bool candidates_only = faces_ && options_.shortcuts.skip_convex;
        const std::size_t n = candidates_only ? faces_->candidates.size() : model_.faces.size();
        std::vector<SuggestiveCounts> parts((n + face_grain - 1) / face_grain);
        std::vector<Segment> segments = parallel_collect<Segment>(n, face_grain, [&](std::size_t begin, std::size_t end, std::vector<Segment>& out) {
            SuggestiveCounts& part = parts[begin / face_grain];
            for (std::size_t i = begin; i < end; ++i)
                visit(candidates_only ? faces_->candidates[i] : std::uint32_t(i), out, part);
        });
        for (const SuggestiveCounts& part : parts)
            counts += part;
        counts.faces += model_.faces.size();
        counts.tested += n;
        return segments;
    }

private:
    bool turned_away(std::uint32_t face) const
    {
        if (!options_.shortcuts.front_only)
            return false;
        const uvec3& t = model_.faces[face];
        if (faces_ && options_.shortcuts.stored_normals)
            return !(glm::dot(faces_->normals[face], view_.to_eye(model_.positions[t.x])) > 0);
        return !faces_eye(model_.positions[t.x], model_.positions[t.y], model_.positions[t.z], view_);
    }

    void visit(std::uint32_t face, std::vector<Segment>& out, SuggestiveCounts& counts) const
    {
        const uvec3& t = model_.faces[face];
        if (!options_.shortcuts.sign_first && turned_away(face)) {
            ++counts.turned_away;
            return;
        }
        if (one_sign(codes_, t)) {
            ++counts.one_sign;
            return;
        }
        if (options_.shortcuts.sign_first && turned_away(face)) {
            ++counts.turned_away;
            return;
        }
        const SuggestiveCorner corners[3] = {suggestive_corner(model_, view_, t.x, options_), suggestive_corner(model_, view_, t.y, options_),
                                             suggestive_corner(model_, view_, t.z, options_)};
        if (options_.shortcuts.strength_test && !any_strong(corners)) {
            ++counts.too_weak;
            return;
        }
        Segment segment;
        const bool drawn = trim_suggestive(model_, face, corners, options_, segment);
        ++(drawn ? counts.drawn : counts.trimmed);
        if (drawn)
            out.push_back(segment);
    }

    const LineModel& model_;
    const View& view_;
    std::span<const std::uint8_t> codes_;
    const SuggestiveOptions& options_;
    const SuggestiveFaces* faces_;
};

} // namespace

SuggestiveCounts& SuggestiveCounts::operator+=(const SuggestiveCounts& other)
{
    faces += other.faces;
    tested += other.tested;
    one_sign += other.one_sign;
    turned_away += other.turned_away;
    too_weak += other.too_weak;
    trimmed += other.trimmed;
    drawn += other.drawn;
    return *this;
}

SuggestiveFaces find_suggestive_faces(const LineModel& model)
{
    SuggestiveFaces faces;
    faces.candidates = parallel_collect<std::uint32_t>(model.faces.size(), face_grain, [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& out) {
        for (std::size_t f = begin; f < end; ++f)
            if (!keeps_one_sign(model, model.faces[f]))
                out.push_back(std::uint32_t(f));
    });
    faces.normals.resize(model.faces.size());
    parallel_each(model.faces.size(), face_grain, [&](std::size_t f) {
        const vec3 &p0 = model.positions[model.faces[f].x], &p1 = model.positions[model.faces[f].y], &p2 = model.positions[model.faces[f].z];
        faces.normals[f] = glm::cross(p1 - p0, p2 - p0);
    });
    return faces;
}

std::vector<std::uint8_t> view_codes(const LineModel& model, const View& view)
{
    std::vector<std::uint8_t> codes(model.vertex_count());
    parallel_each(codes.size(), vertex_grain, [&](std::size_t v) { codes[v] = view_code(radial_terms_of(model, view, std::uint32_t(v))); });
    return codes;
}

std::vector<Segment> extract_suggestive(const LineModel& model, const View& view, std::span<const std::uint8_t> codes, const SuggestiveOptions& options,
                                        const SuggestiveFaces* faces, SuggestiveCounts* counts)
{
    if (!model.has_derivative())
        throw Error::Input("suggestive lines need the derivative of curvature, which the surface does not hold");
    SuggestiveCounts sum;
    std::vector<Segment> segments = Extraction(model, view, codes, options, faces).run(sum);
    if (counts)
        *counts += sum;
    return segments;
}

std::vector<Segment> extract_suggestive(const LineModel& model, const View& view, const SuggestiveOptions& options)
{
    if (!model.has_derivative())
        throw Error::Input("suggestive lines need the derivative of curvature, which the surface does not hold");
    return extract_suggestive(model, view, view_codes(model, view), options);
}

} // namespace limn
