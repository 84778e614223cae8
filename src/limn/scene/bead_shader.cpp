#include "limn/scene/bead_shader.h"

#include <algorithm>
#include <cmath>

namespace limn {
namespace {

using namespace formulas;

const vec3 up = {0, 0, 1};
constexpr float floor_from = 0.9f;         ///< of the normal, upright: treads are as wide as a bead from there on
constexpr float mixed_until = 1.5f;        ///< times the detail, from where on beads are drawn one by one alone
constexpr float from_behind = 0.25f;       ///< facing, below which steps come to be seen from behind: the filter knows only treads there
constexpr float furthest_shift = 4;        ///< of a bead from the one that hides something of it
constexpr float rare_layers = 40;          ///< pixels from step to step: a pixel in a floor that sees none
constexpr float corner_area = 0.21460184f; ///< 1 - pi/4

/// From middle to middle of beads side by side, whose sections fill the space.
float spacing_of(const BeadShape& shape) { return std::max(shape.width() - corner_area * shape.height(), 0.5f * shape.width()); }

/// How far the round sides of beads stand out, by half their height.
float edge_bulge(const BeadShape& shape) { return std::min(1.0f, shape.width() / shape.height()); }

float period(const PatternPoint& p, const vec3& direction, float length)
{
    const float change = glm::length(change_per_pixel(p, direction));
    return change > 1e-12f ? length / change : 1e12f;
}

} // namespace

float BeadPeriods::least() const
{
    if (!level)
        return layers;
    return layers < rare_layers ? std::max(layers, beads) : beads;
}

float BeadPeriods::bodies(float detail) const
{
    const float large = detail > 0 ? glm::smoothstep(detail, mixed_until * detail, least()) : 1;
    return level ? large : std::max(large, 1 - glm::smoothstep(0.0f, from_behind, facing));
}

BeadShader::BeadShader(const SeenPrint& print, const PrintPath& path, const PatternCamera& camera, const PatternOptions& options,
                       const Finish& finish, const PatternLight& light, const BeadColours& colours)
    : print_(print), path_(path), camera_(camera), finish_(finish), light_(light), colours_(colours),
      kernel_(options.filter == PatternFilter::box ? KERNEL_BOX : KERNEL_GAUSS),
      width_(kernel_ == KERNEL_BOX ? float(options.filter_box) : float(options.filter_width)), variety_(float(options.variety))
{
}

/// The groove that a place lies in: with the bead above or below it, or with the one beside, whichever is so near that it hides something of it.
BeadShader::Groove BeadShader::groove(const SeenBead& seen) const
{
    const BeadShape& shape = print_.scene.beads()[seen.bead];
    const vec3 &n = seen.normal, from = seen.position + 0.02f * shape.height() * n;
    // How far the middle of the bead that is near lies behind this one's, in the lengths of BeadFrame; both sides are round.
    const auto near = [&](const vec3& out, const vec3& towards, float reach) -> Groove {
        const BeadHit hit = print_.scene.closest({from, towards, 0, reach});
        if (!hit)
            return {};
        const vec3 middle = from + hit.distance * towards - print_.scene.beads()[hit.bead].round() * hit.normal,
                   own = seen.position - shape.round() * n;
        return {true, out, towards, glm::clamp(glm::dot(own - middle, out) / shape.round(), -furthest_shift, furthest_shift)};
    };
    const vec3 rise = n.z < 0 ? -up : up, level = vec3(n.x, n.y, 0);
    const float size = glm::length(level);
    const vec3 out = size > 1e-3f ? level / size : shape.aside();
    Groove found;
    if (std::abs(n.z) > 0.02f)
        found = near(out, rise, shape.height());
    if (found.shift < 0 && size <= 1e-3f) // on a flat top the way out leads away from what is near
        found = {true, -found.out, found.towards, -found.shift};
    if (!found.narrow && size > 0.05f)
        found = near(rise, out, 0.6f * shape.height());
    return found;
}

vec3 BeadShader::own(const SeenBead& seen, float share) const
{
    Finish finish = finish_;
    finish.colour = colour(seen);
    const PrintMove& of = move(seen);
    if (of.extrudes())
        finish.colour *= 1 + variety_ * (number_of(int(of.layer)) - 0.5f);
    const Illumination lit = light_.at(seen.position, share);
    const BeadShape& shape = print_.scene.beads()[seen.bead];
    const vec3 to_eye = camera_.to_eye(seen.position);
    const vec3 in_surface = shape.along() - glm::dot(shape.along(), seen.normal) * seen.normal; // around ends beads turn
    const float size = glm::length(in_surface);
    const vec3 along = size > 1e-3f ? in_surface / size : shape.aside();
    const Groove in = of.extrudes() ? groove(seen) : Groove();
    if (!in.narrow)
        return reflected(finish, seen.normal, along, to_eye, 0, lit);
    BeadFrame frame = bead_frame(edge_bulge(shape), in.shift, in.out, in.towards, lit);
    frame.along = along;
    const vec2 n = glm::normalize(vec2(glm::dot(seen.normal, in.out), glm::dot(seen.normal, in.towards)));
    return groove_reflected(frame, finish, n, 0, n, n, groove_share(frame.shift, frame.light, n, n, frame.soft), to_eye,
                            groove_ambient(frame, lit, n, n), lit);
}

/// The pixel's place on the plane that touches the outermost places of the beads, where layers are told apart.
PatternPoint BeadShader::point(const SeenBead& seen, const vec3& surface, const BeadShape& shape) const
{
    const vec3 off = seen.position - shape.middle();
    const float along = glm::clamp(glm::dot(off, shape.along()), -shape.half_length(), shape.half_length());
    const float side = glm::dot(surface, shape.aside());
    const vec3 core = shape.middle() + along * shape.along() + std::copysign(shape.flat(), side) * shape.aside();
    const vec3 to_eye = camera_.to_eye(seen.position);
    const float gap = glm::dot(core + shape.round() * surface - seen.position, surface) / std::max(glm::dot(to_eye, surface), 0.05f);
    const float most = 4 * shape.round();
    const vec3 position = seen.position + glm::clamp(gap, -most, most) * to_eye;
    return camera_.point({position, surface, surface, to_eye});
}

BeadPeriods BeadShader::periods(const SeenBead& seen, const vec3& surface) const
{
    const BeadShape& shape = print_.scene.beads()[seen.bead];
    const PatternPoint p = camera_.point({seen.position, surface, surface, camera_.to_eye(seen.position)});
    const float out = glm::length(vec2(surface));
    const float facing = out > 0 && surface.z * p.to_eye.z > 0 ? glm::dot(vec2(surface), vec2(p.to_eye)) / out : 1;
    return {period(p, up, shape.height()), period(p, shape.aside(), spacing_of(shape)), std::abs(surface.z) > floor_from, facing};
}

/// Radiance of a level floor of beads side by side: flat on top, and rounded where two meet.
vec3 BeadShader::floor(const PatternPoint& seen, const BeadShape& shape, const Finish& finish, const Illumination& lit) const
{
    PatternPoint point = seen;
    point.normal = seen.normal.z < 0 ? -up : up;
    const float spacing = spacing_of(shape), flat = glm::clamp(2 * shape.flat() / spacing, 0.0f, 1.0f);
    const LayerPattern side_by_side = {LAYERS_BEAD, shape.aside(), 0, 0, 1, 0, vec3(0), 1};
    const float at = glm::dot(point.position - shape.middle(), shape.aside()) / spacing + 0.5f;
    const vec3 grooves =
        layers_through(side_by_side, finish, point, {at, spacing, change_per_pixel(point, shape.aside()) / spacing}, kernel_, width_, lit);
    return flat * reflected(finish, point.normal, shape.along(), point.to_eye, 0, lit) + (1 - flat) * grooves;
}

vec3 BeadShader::filtered(const SeenBead& seen, const vec3& surface, const vec3& colour, float share) const
{
    const BeadShape& shape = print_.scene.beads()[seen.bead];
    const PatternPoint p = point(seen, surface, shape);
    Finish finish = finish_;
    finish.colour = colour;
    const Illumination lit = light_.at(p.position, share);
    const LayerPattern layers = {LAYERS_BEAD, up, 0, 0, edge_bulge(shape), variety_, vec3(0), 1};
    const float at = float(move(seen).layer) + 0.5f + (p.position.z - shape.middle().z) / shape.height();
    const vec3 steps =
        layers_through(layers, finish, p, {at, shape.height(), change_per_pixel(p, up) / shape.height()}, kernel_, width_, lit);
    // Treads as wide as several beads have grooves of their own.
    const vec4 out = outward(surface, up);
    const float rise = std::abs(surface.z), tread = shape.height() * rise / std::max(out.w, 1e-6f),
                wide = glm::clamp(tread / spacing_of(shape) - 1, 0.0f, 1.0f);
    if (wide <= 0)
        return steps;
    const BeadView view = bead_view(layers.bulge, out.w, surface.z, glm::dot(p.to_eye, vec3(out)), p.to_eye.z);
    const float treads = view.only == 1 ? 1 : glm::clamp(1 - (view.to - view.from) / view.period, 0.0f, 1.0f);
    const vec3 flat = reflected(finish, surface.z < 0 ? -up : up, shape.along(), p.to_eye, 0, lit);
    return glm::max(steps + wide * treads * (floor(p, shape, finish, lit) - flat), vec3(0));
}

} // namespace limn
