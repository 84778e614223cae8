#include "pattern_subjects.h"

#include <cmath>
#include <functional>
#include <utility>

#include "limn/pattern/antialias.h"
#include "limn/pattern/filament.h"

using namespace limn;
using namespace limn::formulas;

namespace {

constexpr float gauss_width = 0.5f, box_width = 2;

PatternLight usual_light()
{
    return {{glm::normalize(vec3(-0.4f, 0.8f, 0.7f)), vec3(2), 0.1f, {0, 1, 0}, vec3(0.3f), vec3(0.1f)}, {}, {}, {}};
}

std::vector<vec2> samples_of(PatternMethod method)
{
    switch (method) {
    case PatternMethod::four: return {{-0.125f, -0.375f}, {0.375f, -0.125f}, {-0.375f, 0.125f}, {0.125f, 0.375f}};
    case PatternMethod::seed: return seed_samples(50, box_width, 1);
    case PatternMethod::even: return even_samples(50, KERNEL_GAUSS, gauss_width, vec2(0.5f));
    case PatternMethod::gauss_reference: return stratified_samples(32, KERNEL_GAUSS, gauss_width, 1);
    case PatternMethod::box_reference: return stratified_samples(32, KERNEL_BOX, box_width, 2);
    case PatternMethod::pixel_reference: return stratified_samples(32, KERNEL_BOX, 1, 3);
    default: return {};
    }
}

vec3 over_white(const vec4& c) { return vec3(c) + (1 - c.w); }

/// Share of a pulse by smoothsteps as wide as the coordinate changes across a pixel.
float derivative_pulse(float x, float start, float length, const vec2& change)
{
    const float width = 0.7f * glm::length(change), f = (x - start) - std::floor(x - start);
    const auto edge = [&](float at) { return glm::smoothstep(at - width, at + width, f); };
    return width > 0 ? edge(0) - edge(length) + edge(1) : (f < length ? 1.0f : 0.0f);
}

vec4 by_derivatives(const BrickShader& s, const PatternPoint& p)
{
    const vec3 m = mortar_part(s.pattern), at = brick_place(s.pattern, p.position);
    const vec2 x = change_per_pixel(p, {1 / s.pattern.cell.x, 0, 0}), y = change_per_pixel(p, {0, 1 / s.pattern.cell.y, 0});
    Finish own = s.finish;
    own.colour = glm::mix(s.pattern.mortar, s.pattern.brick,
                          derivative_pulse(at.x, m.x, 1 - 2 * m.x, x) * derivative_pulse(at.y, m.y, 1 - 2 * m.y, y));
    const vec3 n = bumped(p.normal, brick_gradient(s.pattern, p.position));
    return vec4(reflected(own, n, glm::normalize(glm::cross(vec3(0, 1, 0), n)), p.to_eye, 0, s.light.at(p.position)), 1);
}

vec4 by_derivatives(const ThreadShader& s, const PatternPoint& p)
{
    const vec3 n = glm::normalize(p.position - s.centre);
    const float cell = s.pattern.hole + s.pattern.thread, m = thread_part(s.pattern);
    const vec2 at = sphere_place(n) / cell, right = sphere_change(n, p.right / s.radius) / cell,
               down = sphere_change(n, p.down / s.radius) / cell;
    const float upright = derivative_pulse(at.x, -m, 2 * m, {right.x, down.x}),
                level = derivative_pulse(at.y, -m, 2 * m, {right.y, down.y});
    const Illumination lit = s.light.at(p.position);
    const vec3 colour = level * thread_lit(s.pattern, level_tangent(n), n, p.to_eye, lit) +
                        (1 - level) * upright * thread_lit(s.pattern, upright_tangent(n), n, p.to_eye, lit);
    return vec4(colour, level + (1 - level) * upright);
}

vec4 by_derivatives(const LayerShader& s, const PatternPoint& p)
{
    const vec2 change = change_per_pixel(p, s.pattern.up);
    const LayerPlace place = s.stack.place(glm::dot(p.position, s.pattern.up), change, 0.5f);
    if (s.pattern.model == LAYERS_BEAD) // no edges: there is nothing to widen
        return s.at(p, KERNEL_NONE, 0);
    const float eye_up = glm::dot(p.to_eye, s.pattern.up);
    const bool slope = s.pattern.model == LAYERS_SLOPE;
    const float share = slope ? tread_share(glm::dot(p.normal, s.pattern.up), eye_up, glm::dot(p.normal, p.to_eye)) : std::abs(eye_up);
    const float treads = derivative_pulse(place.at, slope ? -0.5f * share : eye_up > 0 ? 0 : 1 - share, share, place.change);
    const Illumination lit = s.light.at(p.position);
    return vec4(treads * layer_state(s.pattern, s.finish, p, 1, 0, lit) + (1 - treads) * layer_state(s.pattern, s.finish, p, 0, 0, lit), 1);
}

/// The same pattern so fine that a pixel sees its mean.
constexpr float fine = 1e-3f;
BrickShader finer(BrickShader s)
{
    s.pattern.cell *= fine;
    s.pattern.joint *= fine;
    return s;
}
ThreadShader finer(ThreadShader s)
{
    s.pattern.hole *= fine;
    s.pattern.thread *= fine;
    return s;
}
LayerShader finer(LayerShader s)
{
    s.stack = s.stack.scaled(double(fine), 0);
    return s;
}

struct Spot {
    vec2 pixel;
    PatternSpot spot;
};

vec4 sampled(const ThreadShader& shader, const PatternCamera& camera, const Spot& at, std::span<const vec2> samples)
{
    return supersample_sphere(shader, camera, false, at.pixel, samples);
}

template <class Shader> vec4 sampled(const Shader& shader, const PatternCamera& camera, const Spot& at, std::span<const vec2> samples)
{
    return supersample(shader, camera, at.spot, at.pixel, samples);
}

template <class Shader> class Subject : public PatternSubject {
public:
    Subject(std::string name, Shader shader, const PatternCamera& camera, std::vector<Spot> spots)
        : name_(std::move(name)), shader_(std::move(shader)), camera_(camera), spots_(std::move(spots))
    {
    }
    const std::string& name() const override { return name_; }
    std::vector<vec3> draw(PatternMethod method) const override
    {
        const std::vector<vec2> samples = samples_of(method);
        switch (method) {
        case PatternMethod::centre: return each([&](const Spot& s) { return shader_.at(camera_.point(s.spot), KERNEL_NONE, 0); });
        case PatternMethod::derivative: return each([&](const Spot& s) { return by_derivatives(shader_, camera_.point(s.spot)); });
        case PatternMethod::gauss: return each([&](const Spot& s) { return shader_.at(camera_.point(s.spot), KERNEL_GAUSS, gauss_width); });
        case PatternMethod::box: return each([&](const Spot& s) { return shader_.at(camera_.point(s.spot), KERNEL_BOX, box_width); });
        default: return each([&](const Spot& s) { return sampled(shader_, camera_, s, samples); });
        }
    }
    std::vector<vec3> mean() const override
    {
        return each([shader = finer(shader_), this](const Spot& s) { return shader.at(camera_.point(s.spot), KERNEL_GAUSS, gauss_width); });
    }

private:
    template <class F> std::vector<vec3> each(F&& value) const
    {
        std::vector<vec3> colours;
        colours.reserve(spots_.size());
        for (const Spot& spot : spots_)
            colours.push_back(over_white(value(spot)));
        return colours;
    }
    std::string name_;
    Shader shader_;
    PatternCamera camera_;
    std::vector<Spot> spots_;
};

Camera picture(int edge, bool flat)
{
    Camera camera;
    camera.eye = {0.9, 1.6, 5};
    camera.size = {edge, edge};
    camera.orthographic = flat;
    return camera;
}

/// A plane that leans back and is turned a little, so that no line runs along pixels.
std::vector<Spot> plane_spots(const PatternCamera& camera, int edge)
{
    const vec3 n = glm::normalize(vec3(0.1f, 0.5f, 1));
    const vec2 middle = vec2(0.5f * float(edge));
    const PatternSpot origin = {vec3(0), n, n, camera.to_eye(vec3(0))};
    std::vector<Spot> spots;
    for (int i = 0; i < edge * edge; ++i) {
        const vec2 pixel = {float(i % edge) + 0.5f, float(i / edge) + 0.5f};
        const vec3 place = camera.on_plane(origin, middle, pixel);
        spots.push_back({pixel, {place, n, n, camera.to_eye(place)}});
    }
    return spots;
}

/// A unit sphere around the origin, without its outline and poles, where samples of a pixel may miss it.
std::vector<Spot> sphere_spots(const PatternCamera& camera, int edge)
{
    std::vector<Spot> spots;
    for (int i = 0; i < edge * edge; ++i) {
        const vec2 pixel = {float(i % edge) + 0.5f, float(i / edge) + 0.5f};
        vec3 place;
        if (camera.on_sphere(vec3(0), 1, false, pixel, place) && glm::dot(place, camera.to_eye(place)) > 0.3f && std::abs(place.y) < 0.95f)
            spots.push_back({pixel, {place, place, place, camera.to_eye(place)}});
    }
    return spots;
}

/// How much a coordinate changes in a pixel in the middle of the picture.
float change_in_middle(const PatternCamera& camera, const std::vector<Spot>& spots, const vec3& gradient)
{
    return glm::length(change_per_pixel(camera.point(spots[spots.size() / 2].spot), gradient));
}

} // namespace

std::vector<std::unique_ptr<PatternSubject>> pattern_subjects(double periods_per_pixel, int edge, bool flat)
{
    const PatternCamera camera(picture(edge, flat), dvec3(0), 1, {});
    const std::vector<Spot> plane = plane_spots(camera, edge);
    const float wanted = float(periods_per_pixel);
    std::vector<std::unique_ptr<PatternSubject>> subjects;
    const auto add = [&]<class Shader>(std::string name, const Shader& shader, const PatternCamera& seen_by,
                                       const std::vector<Spot>& spots) {
        subjects.push_back(std::make_unique<Subject<Shader>>(std::move(name), shader, seen_by, spots));
    };

    // The seed's bricks, whose coarsest wave goes over a brick across and two rows up.
    const vec3 cell = vec3(0.52f, 0.18f, 0.21f);
    const float unit = change_in_middle(camera, plane, {1 / cell.x, 0.5f / cell.y, 0}) / wanted;
    const vec3 height = vec3(0.006f) / cell;
    add("bricks",
        BrickShader{
            {cell * unit, 0.02f * unit, 2, height, linear_colour(vec3(0.66f, 0.32f, 0.22f)), linear_colour(vec3(0.75f, 0.73f, 0.7f)), 0, 0},
            {FINISH_MATTE, vec3(1), 0, 1, 1, 1, 0},
            usual_light()},
        camera, plane);

    Camera on_sphere = picture(edge, flat);
    on_sphere.eye = flat ? dvec3(0.3, 0.5, 5) : dvec3(0.5, 1, 5);
    on_sphere.fov_degrees = 23;
    on_sphere.ortho_height = 0.35; // nearly flat
    const PatternCamera near(on_sphere, dvec3(0), 1, {});
    const std::vector<Spot> sphere = sphere_spots(near, edge);
    const float around = change_in_middle(near, sphere, {1 / 6.2831853f, 0, 0}) / wanted;
    const float whole = 1 / std::round(1 / std::min(around, 0.2f)); // of the way around: whole cells
    add("thread", ThreadShader{{0.6f * whole, 0.4f * whole, vec3(0.05f, 0.12f, 0.35f), 0.3f, 20, -1, 1, 0}, usual_light(), vec3(0), 1},
        near, sphere);

    const vec3 up = glm::normalize(vec3(0.12f, 1, 0));
    const LayerStack stack(double(change_in_middle(camera, plane, up) / wanted), -20);
    const Finish shiny = {FINISH_BLINN_PHONG, vec3(0.6f), 0.1f, 100, 1, 1, 0};
    add("layers, seed", LayerShader{{LAYERS_SEED, up, 0, 0.2f, 0.5f, 0, vec3(1, 0, 0), 1}, shiny, usual_light(), stack}, camera, plane);
    add("layers, slope", LayerShader{{LAYERS_SLOPE, up, 0, 0.2f, 0.5f, 0, vec3(1, 0, 0), 1}, shiny, usual_light(), stack}, camera, plane);
    add("layers, beads",
        LayerShader{{LAYERS_BEAD, up, 0, 0.2f, 0.5f, 0, vec3(1, 0, 0), 1}, finish_of(find_filament("pla-grey")), usual_light(), stack},
        camera, plane);
    return subjects;
}
