#include "print_truth.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "limn/base/parallel.h"
#include "limn/base/random.h"
#include "limn/pattern/filament.h"
#include "limn/pattern/pixel_samples.h"

using namespace limn;
using namespace limn::formulas;

namespace {

/// Any two directions that make a right frame with a unit vector.
std::pair<vec3, vec3> beside(const vec3& n)
{
    const vec3 a = glm::normalize(glm::cross(std::abs(n.x) < 0.9f ? vec3(1, 0, 0) : vec3(0, 1, 0), n));
    return {a, glm::cross(n, a)};
}

/// In the unit disc, evenly.
vec2 in_disc(Random& random)
{
    const float radius = float(std::sqrt(random.uniform())), turn = float(6.283185307179586 * random.uniform());
    return radius * vec2(std::cos(turn), std::sin(turn));
}

/// The level direction in a surface, or any where it is a floor.
vec3 level_along(const vec3& up, const vec3& n)
{
    const vec3 level = glm::cross(up, n);
    return glm::length(level) > 1e-3f ? glm::normalize(level) : beside(n).first;
}

struct Tracer {
    const PrintBody& print;
    const TruthOptions& options;

    bool is_free(const vec3& from, const vec3& direction) const { return !print.hides({from, direction, 0}); }

    vec3 reflected_at(const PrintHit& hit, const vec3& to_eye, Random& random) const
    {
        const Illumination& all = options.light.lighting;
        const vec3 &n = hit.normal, from = hit.place + print.off * hit.face;
        Illumination lamp = all;
        lamp.above = lamp.below = vec3(0);
        lamp.radius = 0;
        const auto [u, v] = beside(all.to_light);
        const vec2 on_light = all.radius * in_disc(random);
        lamp.to_light = glm::normalize(all.to_light + on_light.x * u + on_light.y * v);
        vec3 sum = is_free(from, lamp.to_light) ? reflected(options.finish, n, hit.along, to_eye, 0, lamp) : vec3(0);
        const Finish& f = options.finish;
        const float share =
            f.model == FINISH_GGX ? ggx_ambient(f.f0, std::sqrt(f.along * f.across), glm::clamp(glm::dot(n, to_eye), 0.0f, 1.0f)) : 0;
        const auto [x, y] = beside(n);
        const vec2 disc = in_disc(random); // as often as the cosine is high
        const vec3 around = disc.x * x + disc.y * y + std::sqrt(std::max(0.0f, 1 - glm::dot(disc, disc))) * n;
        if (is_free(from, around))
            sum += f.colour * (1 - share) * radiance_around(all, around);
        const vec3 mirrored = 2 * glm::dot(n, to_eye) * n - to_eye;
        if (share > 0 && is_free(from, mirrored))
            sum += share * radiance_around(all, mirrored);
        return sum;
    }
    /// Radiance, or nothing where the ray meets nothing.
    std::optional<vec3> seen(const Camera::Ray& ray, Random& random) const
    {
        const std::optional<PrintHit> hit = print.first(ray, options.light.lighting.up);
        if (!hit)
            return std::nullopt;
        return reflected_at(*hit, -vec3(ray.direction), random);
    }
};

struct TracedSteps {
    SteppedPrint print;
    RayTriangles triangles;
    RayScene rays;
    explicit TracedSteps(SteppedPrint&& steps) : print(std::move(steps)), triangles(print.rays()), rays({&triangles, 1}) {}

    std::optional<PrintHit> first(const Camera::Ray& ray, const vec3& up) const
    {
        const Hit hit = rays.closest({vec3(ray.origin), vec3(ray.direction)});
        if (!hit)
            return std::nullopt;
        const uvec3& t = print.triangles[hit.triangle];
        const vec3 &a = print.positions[t.x], &b = print.positions[t.y], &c = print.positions[t.z];
        const float w = 1 - hit.u - hit.v;
        const vec3 face = seen_normal(glm::normalize(glm::cross(b - a, c - a)), -vec3(ray.direction));
        vec3 n = glm::normalize(w * print.normals[t.x] + hit.u * print.normals[t.y] + hit.v * print.normals[t.z]);
        if (glm::dot(n, face) < 0)
            n = -n;
        return PrintHit{w * a + hit.u * b + hit.v * c, face, n, level_along(up, n)};
    }
};

} // namespace

PrintBody body_of(SteppedPrint steps)
{
    Bounds bounds;
    for (std::size_t i = 0; i + 1 < steps.positions.size(); ++i)
        bounds.add(dvec3(steps.positions[i]));
    const auto traced = std::make_shared<const TracedSteps>(std::move(steps));
    return {[traced](const Camera::Ray& ray, const vec3& up) { return traced->first(ray, up); },
            [traced](const Ray& ray) { return traced->rays.occluded(ray); }, float(1e-5 * bounds.radius())};
}

PrintBody body_of(const SeenPrint& print)
{
    const auto first = [&print](const Camera::Ray& ray, const vec3& up) -> std::optional<PrintHit> {
        const dvec3 eye = (ray.origin - print.centre) / print.scale;
        const double skipped = std::max(0.0, -glm::dot(eye, ray.direction) - 1.1); // a far eye costs no precision
        const vec3 from(eye + skipped * ray.direction), direction(ray.direction);
        const BeadHit hit = print.scene.closest({from, direction});
        if (!hit)
            return std::nullopt;
        const vec3 along = print.scene.beads()[hit.bead].along(), in_surface = along - glm::dot(along, hit.normal) * hit.normal;
        const float size = glm::length(in_surface);
        return PrintHit{from + hit.distance * direction, hit.normal, hit.normal,
                        size > 1e-3f ? in_surface / size : level_along(up, hit.normal)};
    };
    return {first, [&print](const Ray& ray) { return print.scene.occluded(ray); }, 2e-4f};
}

TracedPrint trace_print(const PrintBody& print, const Camera& camera, const TruthOptions& options)
{
    const Tracer tracer = {print, options};
    const std::vector<vec2> samples = stratified_samples(options.side, KERNEL_GAUSS, options.kernel_width, 1);
    TracedPrint traced = {Image(camera.size, 3), std::vector<std::uint8_t>(std::size_t(camera.size.x) * std::size_t(camera.size.y), 0)};
    parallel_each(std::size_t(camera.size.y), 1, [&](std::size_t y) {
        for (int x = 0; x < camera.size.x; ++x) {
            Random random(2, y * std::size_t(camera.size.x) + std::size_t(x));
            vec3 sum(0);
            float hits = 0;
            for (const vec2& s : samples)
                if (const std::optional<vec3> radiance = tracer.seen(camera.ray(dvec2(x + 0.5, double(y) + 0.5) + dvec2(s)), random)) {
                    sum += *radiance;
                    ++hits;
                }
            const float cover = hits / float(samples.size());
            const vec3 print_colour = hits > 0 ? shown_light(sum / hits) : vec3(0); // light adds up before a picture compresses it
            const vec3 colour = encoded_colour(glm::mix(options.background, print_colour, cover));
            for (int k = 0; k < 3; ++k)
                traced.picture.at(x, int(y))[k] = colour[k];
            traced.filled[y * std::size_t(camera.size.x) + std::size_t(x)] = cover == 1;
        }
    });
    return traced;
}
