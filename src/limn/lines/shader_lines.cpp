#include "limn/lines/shader_lines.h"

#include <cmath>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/formulas/formulas.h"
#include "limn/lines/bar_texture.h"
#include "limn/lines/face_point.h"
#include "limn/lines/projector.h"

namespace limn {
namespace {

using O = ShaderLineOptions;

/// What the vertex shader hands on: n.v/|v|, kr, D kr and sin^2(theta) D kr.
vec4 quantities_at(const LineModel& m, const View& view, std::uint32_t i)
{
    const formulas::RadialTerms t = formulas::radial_terms(view.to_eye(m.positions[i]), m.normals[i], m.e1[i], m.e2[i], m.k1[i], m.k2[i]);
    const float along = formulas::radial_curvature_derivative(t, m.k1[i], m.k2[i], m.derivative[i]);
    return {t.nv / std::sqrt(t.vv), formulas::radial_curvature(t, m.k1[i], m.k2[i]), along, formulas::suggestive_strength(t, along, 1, 0)};
}

/// The quantities over the plane of one face.
class FaceQuantities {
public:
    FaceQuantities(const LineModel& model, const View& view, const Projector& projector, std::uint32_t face) : model_(model), projector_(projector), face_(face)
    {
        for (int k = 0; k < 3; ++k)
            corners_[k] = quantities_at(model, view, model.faces[face][k]);
    }
    /// Where the ray through the centre of a pixel meets the plane, beyond the face too.
    vec4 at(int x, int y) const
    {
        const vec3 w = weights_at_pixel(model_, projector_, face_, {x + 0.5, y + 0.5});
        return w.x * corners_[0] + w.y * corners_[1] + w.z * corners_[2];
    }

private:
    const LineModel& model_;
    const Projector& projector_;
    std::uint32_t face_;
    vec4 corners_[3];
};

float width_ink(const vec4& q, float per_unit, const ShaderLineOptions& options)
{
    if (options.naive)
        return std::abs(q.x) < 0.1f * options.contour_width ? 1.0f : 0.0f;
    return formulas::shader_ink(q.x, q.y, q.z, per_unit, options.contour_width, options.suggestive_width, options.least_strength());
}

/// Both textures of ShaderMethod::texture.
struct Bars {
    std::vector<Image> contour, suggestive;
};

/// The ink at a place, whose neighbours to the side and above or below are given too.
float look_up(const std::vector<Image>& bar, const vec2& place, const vec2& dx, const vec2& dy)
{
    return filtered(bar, place, formulas::texture_level(dx, dy, float(bar[0].width)));
}

float texture_ink(const FaceQuantities& face, int x, int y, ivec2 size, const Bars& bars, const ShaderLineOptions& options)
{
    // Differences within blocks of 2 x 2 pixels, counted from the bottom left, as devices have them.
    const int left = x & ~1, low = size.y - 1 - ((size.y - 1 - y) & ~1);
    const vec4 q = face.at(x, y), dx = face.at(left + 1, y) - face.at(left, y), dy = face.at(x, low - 1) - face.at(x, low);
    const auto contour = [](const vec4& p) { return formulas::contour_place(p.x); };
    const auto suggestive = [&](const vec4& p) { return formulas::suggestive_place(p.y, p.w, options.feature_size, options.suggestive_limit); };
    // Places are linear in the quantities, but for what they add.
    const float ink = look_up(bars.contour, contour(q), contour(dx) - contour(vec4(0)), contour(dy) - contour(vec4(0)));
    if (!options.suggestive || !(q.x > 0))
        return ink;
    return std::max(ink, look_up(bars.suggestive, suggestive(q), suggestive(dx) - suggestive(vec4(0)), suggestive(dy) - suggestive(vec4(0))));
}

} // namespace

Image find_shader_lines(const LineModel& model, const GBuffer& seen, const Camera& camera, const ShaderLineOptions& options)
{
    if (model.normals.empty() || !model.has_derivative())
        throw Error::Input("lines of the fragment shader need curvature and its derivative, which this surface has not");
    Image ink(seen.size, 1);
    if (options.method == ShaderMethod::off)
        return ink;
    const View view = model.view(camera);
    const Projector projector(model, camera);
    const Bars bars = {bar_texture(options.texture_size, options.contour_bar()), bar_texture(options.texture_size, options.suggestive_bar())};
    parallel_each(std::size_t(seen.size.y), 4, [&](std::size_t y) {
        for (int x = 0; x < seen.size.x; ++x) {
            const std::size_t i = seen.index(x, int(y));
            if (seen.triangles[i] == none)
                continue;
            const FaceQuantities face(model, view, projector, seen.triangles[i]);
            const float per_unit = float(view.orthographic ? projector.scale : projector.scale / projector.depth(seen.positions[i]));
            *ink.at(x, int(y)) = options.method == ShaderMethod::texture ? texture_ink(face, x, int(y), seen.size, bars, options)
                                                                         : width_ink(face.at(x, int(y)), per_unit, options);
        }
    });
    return ink;
}

const OptionTable<ShaderLineOptions>& shader_line_option_table()
{
    static const OptionTable<ShaderLineOptions> table = {
        choice_row<O, ShaderMethod>("shader-lines", {{"none", ShaderMethod::off}, {"width", ShaderMethod::width}, {"texture", ShaderMethod::texture}},
                                    "contours and suggestive contours decided pixel by pixel from the surface, 2 px wide, under those of --lines", &O::method),
        choice_row<O, int>("texture-size", {{"32", 32}, {"64", 64}, {"128", 128}, {"256", 256}, {"512", 512}, {"1024", 1024}},
                           "texture: texels along an edge; more hold the width over more zoom", &O::texture_size),
    };
    return table;
}

} // namespace limn
