#include "flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/base/srgb.h"

using namespace limn;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double colour_power = 0.7, colour_knee = 0.4, knee_value = 0.95, feature_power = 0.5, feature_width = 0.082; // degrees

struct Planes {
    int width, height;
    std::vector<dvec3> values;
    const dvec3& at(int x, int y) const
    {
        return values[std::size_t(std::clamp(y, 0, height - 1)) * std::size_t(width) + std::size_t(std::clamp(x, 0, width - 1))];
    }
};

/// A picture with a value for each pixel of another.
template <class F> Planes each_pixel(int width, int height, F&& value)
{
    Planes result = {width, height, std::vector<dvec3>(std::size_t(width) * std::size_t(height))};
    parallel_each(std::size_t(height), 4, [&](std::size_t y) {
        for (int x = 0; x < width; ++x)
            result.values[y * std::size_t(width) + std::size_t(x)] = value(x, int(y));
    });
    return result;
}

/// XYZ of the primaries of sRGB, by columns, and of its white.
const dmat3& primaries()
{
    static const dmat3 m(dvec3(0.4123865632, 0.2126368150, 0.0193306197), dvec3(0.3575914909, 0.7151829818, 0.1191971609),
                         dvec3(0.1804504912, 0.0721802033, 0.9503725806));
    return m;
}

dvec3 white() { return primaries() * dvec3(1); }

/// The linear opponent space of the authors: luminance, red against green, blue against yellow.
dvec3 opponent(const dvec3& linear)
{
    const dvec3 t = primaries() * linear / white();
    return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}

dvec3 linear_from_opponent(const dvec3& c)
{
    const double y = (c.x + 16) / 116;
    return glm::inverse(primaries()) * (dvec3(y + c.y / 500, y, y - c.z / 200) * white());
}

double lab_curve(double t) { return t > 216.0 / 24389 ? std::cbrt(t) : t * 841 / 108 + 4.0 / 29; }

/// L*a*b*, whose colour fades in the dark (Hunt's effect).
dvec3 lab(const dvec3& linear)
{
    const dvec3 t = primaries() * linear / white();
    const double x = lab_curve(t.x), y = lab_curve(t.y), z = lab_curve(t.z), l = 116 * y - 16;
    return {l, 0.01 * l * 500 * (x - y), 0.01 * l * 200 * (y - z)};
}

double hyab(const dvec3& a, const dvec3& b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

/// A filter over pixels, (2 radius + 1) squared, of three channels.
struct Filter {
    int radius;
    std::vector<dvec3> weights;
};

/// What the eye's contrast sensitivity leaves of each opponent channel: two Gauss functions each.
Filter contrast_filter(double pixels_per_degree)
{
    struct Term {
        double a1, b1, a2, b2;
    };
    constexpr Term terms[3] = {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};
    Filter filter = {int(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * pixels_per_degree)), {}};
    dvec3 sum(0);
    for (int y = -filter.radius; y <= filter.radius; ++y)
        for (int x = -filter.radius; x <= filter.radius; ++x) {
            const double d2 = double(x * x + y * y) / (pixels_per_degree * pixels_per_degree);
            dvec3 w;
            for (int c = 0; c < 3; ++c)
                w[c] = terms[c].a1 * std::sqrt(pi / terms[c].b1) * std::exp(-pi * pi * d2 / terms[c].b1) +
                       terms[c].a2 * std::sqrt(pi / terms[c].b2) * std::exp(-pi * pi * d2 / terms[c].b2);
            sum += w;
            filter.weights.push_back(w);
        }
    for (dvec3& w : filter.weights)
        w /= sum;
    return filter;
}

Planes filtered(const Planes& picture, const Filter& filter)
{
    return each_pixel(picture.width, picture.height, [&](int x, int y) {
        dvec3 sum(0);
        std::size_t k = 0;
        for (int dy = -filter.radius; dy <= filter.radius; ++dy)
            for (int dx = -filter.radius; dx <= filter.radius; ++dx)
                sum += filter.weights[k++] * picture.at(x + dx, y + dy);
        return sum;
    });
}

/// Strength of edges (first derivative) and points (second) of luminance, by filters whose positive and negative parts are 1 each.
struct Features {
    double edges, points;
};

struct FeatureFilter {
    int radius;
    std::vector<double> edge, point; ///< across; the same turned is up
};

void normalise(std::vector<double>& weights)
{
    double positive = 0, negative = 0;
    for (const double w : weights)
        (w > 0 ? positive : negative) += std::abs(w);
    for (double& w : weights)
        w /= w > 0 ? positive : negative;
}

FeatureFilter feature_filter(double pixels_per_degree)
{
    const double sigma = 0.5 * feature_width * pixels_per_degree;
    FeatureFilter filter = {int(std::ceil(3 * sigma)), {}, {}};
    for (int y = -filter.radius; y <= filter.radius; ++y)
        for (int x = -filter.radius; x <= filter.radius; ++x) {
            const double g = std::exp(-(x * x + y * y) / (2 * sigma * sigma));
            filter.edge.push_back(-x * g);
            filter.point.push_back((x * x / (sigma * sigma) - 1) * g);
        }
    normalise(filter.edge);
    normalise(filter.point);
    return filter;
}

Features features_at(const Planes& opponents, const FeatureFilter& filter, int x, int y)
{
    const int side = 2 * filter.radius + 1;
    dvec2 edge(0), point(0);
    for (int dy = 0; dy < side; ++dy)
        for (int dx = 0; dx < side; ++dx) {
            const double v = (opponents.at(x + dx - filter.radius, y + dy - filter.radius).x + 16) / 116;
            const std::size_t across = std::size_t(dy * side + dx), up = std::size_t(dx * side + dy);
            edge += v * dvec2(filter.edge[across], filter.edge[up]);
            point += v * dvec2(filter.point[across], filter.point[up]);
        }
    return {glm::length(edge), glm::length(point)};
}

Planes opponents_of(const Image& image)
{
    return each_pixel(image.width, image.height, [&](int x, int y) {
        const float* s = image.at(x, y);
        return opponent({double(linear_from_srgb(s[0])), double(linear_from_srgb(s[1])), double(linear_from_srgb(s[2]))});
    });
}

/// In [0,1]: small differences of colour take up most of it.
double spread_out(double difference, double most)
{
    const double knee = colour_knee * most;
    return difference < knee ? knee_value / knee * difference : knee_value + (difference - knee) / (most - knee) * (1 - knee_value);
}

} // namespace

double flip(const Image& a, const Image& b, double pixels_per_degree)
{
    if (a.width != b.width || a.height != b.height || a.channels < 3 || b.channels < 3)
        throw Error::Input("pictures of several sizes cannot be compared");
    const Planes first = opponents_of(a), second = opponents_of(b);
    const Filter contrast = contrast_filter(pixels_per_degree);
    const Planes seen = filtered(first, contrast), other = filtered(second, contrast);
    const FeatureFilter features = feature_filter(pixels_per_degree);
    const double most = std::pow(hyab(lab({0, 1, 0}), lab({0, 0, 1})), colour_power);
    const Planes errors = each_pixel(a.width, a.height, [&](int x, int y) {
        const auto colour = [&](const Planes& p) { return lab(glm::clamp(linear_from_opponent(p.at(x, y)), 0.0, 1.0)); };
        const double colours = spread_out(std::pow(hyab(colour(seen), colour(other)), colour_power), most);
        const Features f = features_at(first, features, x, y), g = features_at(second, features, x, y);
        const double feature =
            std::pow(std::max(std::abs(f.edges - g.edges), std::abs(f.points - g.points)) / std::sqrt(2.0), feature_power);
        return dvec3(std::pow(colours, 1 - std::min(feature, 1.0)), 0, 0);
    });
    double sum = 0;
    for (const dvec3& e : errors.values)
        sum += e.x;
    return sum / double(errors.values.size());
}
