#include "limn/scene/print_picture.h"

#include <algorithm>
#include <cmath>

#include "limn/base/parallel.h"
#include "limn/pattern/filament.h"
#include "limn/pattern/ground_shadow.h"
#include "limn/pattern/pixel_samples.h"
#include "limn/scene/bead_shader.h"
#include "limn/scene/depth_plane.h"
#include "limn/scene/pattern_light.h"

namespace limn {
namespace {

using namespace formulas;

constexpr float same_surface = 0.9f; ///< cosine between normals

/// What the middle of a pixel sees.
struct PixelView {
    SeenBead seen;
    vec3 surface = vec3(0); ///< normal of what the beads around make together; zero where they make none
    float size = 0;         ///< of the pixel there, in the frame
    float bodies = 1;       ///< how much of the pixel is drawn bead by bead
};

class PrintPainter {
public:
    PrintPainter(const SeenPrint& print, const PrintPath& path, const Camera& camera, const PrintOptions& options,
                 const PatternOptions& pattern, const ShadeOptions& shade)
        : print_(print), options_(options), shade_(shade), camera_(camera),
          pattern_camera_(camera, print.centre, print.scale, PatternFrame()),
          light_(pattern_light(print.centre, print.scale, camera, shade, shade.up)),
          colours_(path, options, pattern.colour.value_or(find_filament(pattern.filament).colour)),
          shader_(print, path, pattern_camera_, pattern, print_finish(pattern), light_, colours_), empty_{nullptr,
                                                                                                          {},
                                                                                                          print.centre,
                                                                                                          print.scale,
                                                                                                          {}},
          sights_(empty_, camera), size_(camera.size), light_places_(even_samples(shade.light_samples, KERNEL_BOX, 1, vec2(0)))
    {
        if (!shade.ground)
            return;
        plane_.emplace(*shade.ground, print.centre, print.scale);
        ground_shadow_.emplace([&](const Ray& ray) { return print.scene.occluded(ray); }, *plane_,
                               light_.place ? glm::normalize(*light_.place) : light_.lighting.to_light);
    }

    Image paint()
    {
        look();
        find_surfaces();
        Image image(size_, 3);
        const std::vector<dvec2> rays = sample_pattern(shade_.samples);
        parallel_each(std::size_t(size_.y), 2, [&](std::size_t row) {
            for (int x = 0; x < size_.x; ++x) {
                const vec3 c = encoded_colour(glm::max(is_on_edge(x, int(row)) ? sampled(x, int(row), rays) : plain(x, int(row)), vec3(0)));
                for (int k = 0; k < 3; ++k)
                    image.at(x, int(row))[k] = c[k];
            }
        });
        return image;
    }

private:
    PixelView& view(int x, int y) { return views_[std::size_t(y) * std::size_t(size_.x) + std::size_t(x)]; }
    const PixelView& view(int x, int y) const { return views_[std::size_t(y) * std::size_t(size_.x) + std::size_t(x)]; }
    template <class F> void each_pixel(F&& f) const
    {
        parallel_each(std::size_t(size_.y), 2, [&](std::size_t row) {
            for (int x = 0; x < size_.x; ++x)
                f(x, int(row));
        });
    }
    /// Calls f(neighbour) for the pixels at most `reach` away, itself too.
    template <class F> void each_around(int x, int y, int reach, F&& f) const
    {
        for (int ny = std::max(0, y - reach); ny <= std::min(size_.y - 1, y + reach); ++ny)
            for (int nx = std::max(0, x - reach); nx <= std::min(size_.x - 1, x + reach); ++nx)
                f(view(nx, ny));
    }

    SeenBead see(const dvec2& pixel) const
    {
        const auto [eye, direction] = sights_.sight(pixel);
        const double skipped = std::max(0.0, -glm::dot(eye, direction) - 1.1); // a far eye costs no precision
        const Ray ray = {vec3(eye + skipped * direction), vec3(direction)};
        const BeadHit hit = print_.scene.closest(ray);
        if (!hit)
            return {};
        return {hit.bead, ray.origin + hit.distance * ray.direction, hit.normal};
    }

    void look()
    {
        views_.resize(std::size_t(size_.x) * std::size_t(size_.y));
        const dvec3 forward = camera_.forward();
        each_pixel([&](int x, int y) {
            PixelView& v = view(x, y);
            v.seen = see({x + 0.5, y + 0.5});
            if (!v.seen.hit())
                return;
            const dvec3 world = print_.centre + print_.scale * dvec3(v.seen.position);
            v.size = float(1 / (camera_.pixels_per_unit(glm::dot(world - camera_.eye, forward)) * print_.scale));
        });
    }

    /// Bodies are far larger than pixels: nobody needs to know what surface they make.
    bool is_near(const PixelView& v) const
    {
        return !v.seen.hit() || !shader_.move(v.seen).extrudes() ||
               print_.scene.beads()[v.seen.bead].height() > 6 * float(options_.detail) * v.size;
    }

    void find_surfaces()
    {
        DepthPicture depths(camera_, print_.scale);
        const vec3 forward(camera_.forward()), eye((camera_.eye - print_.centre) / print_.scale);
        each_pixel([&](int x, int y) {
            const PixelView& v = view(x, y);
            if (v.seen.hit() && shader_.move(v.seen).extrudes())
                depths.depth(x, y) = glm::dot(v.seen.position - eye, forward);
        });
        std::vector<vec3> raw(views_.size());
        each_pixel([&](int x, int y) {
            const PixelView& v = view(x, y);
            if (is_near(v))
                return;
            const float height = print_.scene.beads()[v.seen.bead].height(), thick = 0.8f * height + 0.5f * v.size;
            const int radius = std::clamp(int(2.5f * height / v.size) + 2, 4, 10);
            vec3& n = raw[std::size_t(&v - views_.data())];
            n = depths.normal_at(x, y, radius, thick);
            if (n == vec3(0)) // at the rim of a surface
                n = depths.normal_at(x, y, radius / 2, thick);
        });
        each_pixel([&](int x, int y) {
            PixelView& v = view(x, y);
            if (is_near(v))
                return;
            v.surface = smooth_normal(x, y, raw);
            if (v.surface != vec3(0))
                v.bodies = shader_.periods(v.seen, v.surface).bodies(float(options_.detail));
        });
    }

    /// The mean of the normals around that belong to the same surface. A pixel without one, or with one that few around agree with, has that of those whose
    /// planes its place is near to.
    vec3 smooth_normal(int x, int y, const std::vector<vec3>& raw) const
    {
        constexpr int reach = 2, far_reach = 5;
        const PixelView& v = view(x, y);
        const vec3& own = raw[std::size_t(&v - views_.data())];
        const float thick = 0.6f * print_.scene.beads()[v.seen.bead].height() + 0.5f * v.size;
        vec3 same(0), others(0);
        int same_count = 0, other_count = 0;
        each_around(x, y, own == vec3(0) ? far_reach : reach, [&](const PixelView& other) {
            const vec3& n = raw[std::size_t(&other - views_.data())];
            if (n == vec3(0))
                return;
            if (glm::dot(own, n) > same_surface) {
                same += n;
                ++same_count;
            } else if (std::abs(glm::dot(v.seen.position - other.seen.position, n)) < thick) {
                others += n;
                ++other_count;
            }
        });
        const vec3 sum = other_count > 2 * same_count ? others : same;
        const float size = glm::length(sum);
        return size > 0 ? sum / size : vec3(0);
    }

    /// Whether neighbours differ so that a pixel between them needs more than one ray.
    bool differ(const PixelView& a, const PixelView& b) const
    {
        if (a.seen.hit() != b.seen.hit())
            return true;
        if (!a.seen.hit())
            return false;
        const bool bodies = a.bodies > 0 || b.bodies > 0;
        const vec3 &na = a.bodies < 1 ? a.surface : a.seen.normal, &nb = b.bodies < 1 ? b.surface : b.seen.normal;
        const vec3 step = b.seen.position - a.seen.position;
        const float off = std::min(std::abs(glm::dot(step, na)), std::abs(glm::dot(step, nb)));
        const float size = std::max(a.size, b.size);
        if (!bodies)
            return glm::dot(na, nb) < 0.85f || off > 3 * size + 0.5f * print_.scene.beads()[a.seen.bead].height();
        return a.seen.bead != b.seen.bead ? glm::dot(a.seen.normal, b.seen.normal) < 0.99f || off > 0.3f * size
                                          : glm::dot(a.seen.normal, b.seen.normal) < 0.9f;
    }
    bool is_on_edge(int x, int y) const
    {
        bool edge = false;
        const PixelView& v = view(x, y);
        each_around(x, y, 1, [&](const PixelView& other) { edge = edge || differ(v, other); });
        return edge;
    }

    /// How much of the light nothing hides, by `count` of its places.
    float unhidden(const SeenBead& seen, const vec3& surface, const dvec2& pixel, std::size_t count) const
    {
        if (!shade_.occlusion)
            return 1;
        const vec3 n = surface == vec3(0) ? seen.normal : surface;
        const vec3 from = seen.position + 1.2f * print_.scene.beads()[seen.bead].height() * n; // out of the beads' own grooves
        return light_share(*shade_.occlusion, light_, {light_places_.data(), count}, from, vec2(pixel));
    }

    /// The mean colour of the beads that a pixel and its neighbours see of one surface.
    vec3 colour_around(int x, int y) const
    {
        const PixelView& v = view(x, y);
        if (options_.colour == PrintColour::filament)
            return shader_.colour(v.seen);
        vec3 sum(0);
        float count = 0;
        each_around(x, y, 1, [&](const PixelView& other) {
            if (!other.seen.hit() || other.bodies >= 1 || glm::dot(other.surface, v.surface) < same_surface)
                return;
            sum += shader_.colour(other.seen);
            ++count;
        });
        return count > 0 ? sum / count : shader_.colour(v.seen);
    }

    vec3 backdrop(const dvec2& pixel) const
    {
        const vec3 background = linear_colour(shade_.background);
        if (!plane_)
            return background;
        const GroundPlane::Point ground = plane_->meet(sights_.sight(pixel));
        if (!(ground.cover > 0))
            return background;
        return glm::mix(background, linear_colour(shade_.ground->material.colour) * ground_shadow_->light(ground.position), ground.cover);
    }

    /// Radiance of a place, as the pixel around has it. @param view  of the pixel whose surface the place belongs to
    vec3 radiance(const SeenBead& seen, const dvec2& pixel, const PixelView& of, const vec3& colour, std::size_t light_places) const
    {
        const float share = unhidden(seen, of.surface, pixel, light_places);
        vec3 sum(0);
        if (of.bodies > 0)
            sum += of.bodies * shader_.own(seen, share);
        if (of.bodies < 1)
            sum += (1 - of.bodies) * shader_.filtered(seen, of.surface, colour, share);
        return sum;
    }

    vec3 plain(int x, int y) const
    {
        const PixelView& v = view(x, y);
        const dvec2 pixel = {x + 0.5, y + 0.5};
        if (!v.seen.hit())
            return backdrop(pixel);
        return formulas::shown_light(radiance(v.seen, pixel, v, v.bodies < 1 ? colour_around(x, y) : vec3(0), light_places_.size()));
    }

    /// The pixel around whose surface holds a place that a ray through this one sees: itself, or a neighbour.
    const PixelView& owner(int x, int y, const SeenBead& seen) const
    {
        const PixelView* best = &view(x, y);
        float least = std::numeric_limits<float>::infinity();
        const auto off = [&](const PixelView& v) {
            const vec3 step = seen.position - v.seen.position;
            const vec3& n = v.bodies < 1 ? v.surface : v.seen.normal;
            return std::abs(glm::dot(step, n)) + 0.2f * glm::length(step) +
                   (shader_.move(v.seen).extrudes() == shader_.move(seen).extrudes() ? 0.0f : 10.0f);
        };
        each_around(x, y, 1, [&](const PixelView& v) {
            if (!v.seen.hit())
                return;
            const float distance = off(v);
            if (distance < least) {
                least = distance;
                best = &v;
            }
        });
        return *best;
    }

    vec3 sampled(int x, int y, const std::vector<dvec2>& rays) const
    {
        const std::size_t few = (light_places_.size() - 1) / rays.size() + 1;
        vec3 lit(0), behind(0);
        float hits = 0;
        for (const dvec2& offset : rays) {
            const dvec2 pixel = {x + offset.x, y + offset.y};
            const SeenBead seen = see(pixel);
            if (!seen.hit()) {
                behind += backdrop(pixel);
                continue;
            }
            static const PixelView body; // where no neighbour knows more
            const PixelView& found = owner(x, y, seen);
            const PixelView& of = found.seen.hit() && (shader_.move(seen).extrudes() || found.bodies >= 1) ? found : body;
            lit += radiance(seen, pixel, of, shader_.colour(seen), few);
            ++hits;
        }
        const float all = float(rays.size());
        return (hits > 0 ? formulas::shown_light(lit / hits) * (hits / all) : vec3(0)) + behind / all;
    }

    const SeenPrint& print_;
    const PrintOptions& options_;
    const ShadeOptions& shade_;
    const Camera camera_;
    const PatternCamera pattern_camera_;
    const PatternLight light_;
    const BeadColours colours_;
    const BeadShader shader_;
    const SeenScene empty_; ///< only its frame, for lines of sight
    const FragmentTracer sights_;
    const ivec2 size_;
    const std::vector<vec2> light_places_; ///< in a unit square around its middle
    std::optional<GroundPlane> plane_;
    std::optional<GroundShadow> ground_shadow_;
    std::vector<PixelView> views_;
};

} // namespace

Image paint_print(const SeenPrint& print, const PrintPath& path, const Camera& camera, const PrintOptions& options,
                  const PatternOptions& pattern, const ShadeOptions& shade)
{
    check(shade, 1);
    return PrintPainter(print, path, camera, options, pattern, shade).paint();
}

Ground plate_under(const SeenPrint& print)
{
    Ground ground;
    ground.middle = {print.centre.x, print.centre.y, print.bounds.low.z};
    ground.up = {0, 0, 1};
    ground.radius = print.scale;
    return ground;
}

} // namespace limn
