#include "print_truth.h"

#include <cmath>

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

struct Tracer {
    const SteppedPrint& print;
    const TruthOptions& options;
    RayScene rays;
    float off; ///< of the surface, where rays begin

    bool is_free(const vec3& from, const vec3& direction) const { return !rays.occluded({from, direction, 0}); }

    vec3 reflected_at(const vec3& place, const vec3& face, const vec3& n, const vec3& to_eye, Random& random) const
    {
        const Illumination& all = options.light.lighting;
        const vec3 from = place + off * face, level = glm::cross(all.up, n);
        const vec3 t = glm::length(level) > 1e-3f ? glm::normalize(level) : beside(n).first;
        Illumination lamp = all;
        lamp.above = lamp.below = vec3(0);
        lamp.radius = 0;
        const auto [u, v] = beside(all.to_light);
        const vec2 on_light = all.radius * in_disc(random);
        lamp.to_light = glm::normalize(all.to_light + on_light.x * u + on_light.y * v);
        vec3 sum = is_free(from, lamp.to_light) ? reflected(options.finish, n, t, to_eye, 0, lamp) : vec3(0);
        const Finish& f = options.finish;
        const float share = f.model == FINISH_GGX ? ggx_ambient(f.f0, std::sqrt(f.along * f.across), glm::clamp(glm::dot(n, to_eye), 0.0f, 1.0f)) : 0;
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
    vec3 seen(const Camera::Ray& ray, Random& random) const
    {
        const Hit hit = rays.closest({vec3(ray.origin), vec3(ray.direction)});
        if (!hit)
            return options.background;
        const uvec3& t = print.triangles[hit.triangle];
        const vec3 &a = print.positions[t.x], &b = print.positions[t.y], &c = print.positions[t.z], to_eye = -vec3(ray.direction);
        const float w = 1 - hit.u - hit.v;
        const vec3 face = seen_normal(glm::normalize(glm::cross(b - a, c - a)), to_eye);
        vec3 n = glm::normalize(w * print.normals[t.x] + hit.u * print.normals[t.y] + hit.v * print.normals[t.z]);
        if (glm::dot(n, face) < 0)
            n = -n;
        return shown_light(reflected_at(w * a + hit.u * b + hit.v * c, face, n, to_eye, random));
    }
};

} // namespace

Image trace_print(const SteppedPrint& print, const Camera& camera, const TruthOptions& options)
{
    Bounds bounds;
    for (std::size_t i = 0; i + 1 < print.positions.size(); ++i)
        bounds.add(dvec3(print.positions[i]));
    const RayTriangles triangles = print.rays();
    const Tracer tracer = {print, options, RayScene({&triangles, 1}), float(1e-5 * bounds.radius())};
    const std::vector<vec2> samples = stratified_samples(options.side, KERNEL_GAUSS, options.kernel_width, 1);
    Image image(camera.size, 3);
    parallel_each(std::size_t(camera.size.y), 1, [&](std::size_t y) {
        for (int x = 0; x < camera.size.x; ++x) {
            Random random(2, y * std::size_t(camera.size.x) + std::size_t(x));
            vec3 sum(0);
            for (const vec2& s : samples)
                sum += tracer.seen(camera.ray(dvec2(x + 0.5, double(y) + 0.5) + dvec2(s)), random);
            const vec3 colour = encoded_colour(sum / float(samples.size()));
            for (int k = 0; k < 3; ++k)
                image.at(x, int(y))[k] = colour[k];
        }
    });
    return image;
}
