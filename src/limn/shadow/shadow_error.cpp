#include "limn/shadow/shadow_error.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "limn/base/error.h"
#include "limn/base/random.h"

namespace limn {
namespace {

vec3 random_direction(Random& random)
{
    while (true) {
        const double z = random.normal(), y = random.normal(), x = random.normal(); // in an order that no compiler chooses
        const dvec3 v(x, y, z);
        if (const double length = glm::length(v); length > 1e-6)
            return vec3(v / length);
    }
}

dvec3 random_in_ball(Random& random)
{
    while (true) {
        const double z = random.uniform(-1, 1), y = random.uniform(-1, 1), x = random.uniform(-1, 1);
        const dvec3 v(x, y, z);
        if (glm::dot(v, v) < 1)
            return v;
    }
}

struct Picture {
    vec3 eye, right, above, forward;
    float spread; ///< of the picture's side at distance 1, halved
    vec4 lamp;
};

Picture random_picture(const ObjectErrorOptions& options, int number)
{
    Random random(options.seed, std::uint64_t(number));
    Picture picture;
    picture.eye = random_direction(random);
    picture.forward = -picture.eye;
    const vec3 other = std::abs(picture.forward.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0);
    picture.right = glm::normalize(glm::cross(picture.forward, other));
    picture.above = glm::cross(picture.right, picture.forward);
    picture.spread = float(std::tan(options.fov_degrees * std::numbers::pi / 360));
    const vec3 direction = random_direction(random);
    picture.lamp = vec4(float(random.uniform(options.nearest, options.farthest)) * direction, 1);
    return picture;
}

/// The places of one picture to ask about; counts its pixels.
std::vector<ShadowQuery> facing_places(const CasterRays& truth, const Picture& picture, int size, ObjectShadowError& counts)
{
    std::vector<ShadowQuery> places;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const float u = (2 * (float(x) + 0.5f) / float(size) - 1) * picture.spread, v = (1 - 2 * (float(y) + 0.5f) / float(size)) * picture.spread;
            const vec3 direction = glm::normalize(picture.forward + u * picture.right + v * picture.above);
            ++counts.pixels;
            const Hit hit = truth.rays().closest({picture.eye, direction});
            if (!hit)
                continue;
            ++counts.object;
            const uvec3& t = truth.triangle(hit.triangle);
            const vec3 &a = truth.positions()[t.x], &b = truth.positions()[t.y], &c = truth.positions()[t.z];
            const vec3 place = (1 - hit.u - hit.v) * a + hit.u * b + hit.v * c, normal = glm::cross(b - a, c - a);
            const vec3 seen = glm::dot(normal, direction) > 0 ? -normal : normal;
            if (glm::dot(seen, vec3(picture.lamp) - place) <= 0)
                continue;
            ++counts.facing;
            places.push_back({place, picture.lamp});
        }
    return places;
}

void add(ObjectShadowError& sum, const ObjectShadowError& more)
{
    sum.pixels += more.pixels, sum.object += more.object, sum.facing += more.facing;
    sum.wrong += more.wrong, sum.unknown += more.unknown;
}

} // namespace

ObjectShadowError object_shadow_error(const CasterRays& truth, const AskShadows& ask, const ObjectErrorOptions& options)
{
    if (options.images < 1 || options.size < 1)
        throw Error::Input("no pictures to measure the error of shadows in");
    if (!(options.nearest > 1 && options.farthest >= options.nearest))
        throw Error::Input("lamps to measure the error of shadows with have to be outside the object's sphere");
    std::vector<ObjectShadowError> parts(std::size_t(options.images));
    parallel_each(parts.size(), 1, [&](std::size_t i) {
        const std::vector<ShadowQuery> places = facing_places(truth, random_picture(options, int(i)), options.size, parts[i]);
        std::vector<Verdict> verdicts(places.size());
        ask(places, verdicts);
        for (std::size_t k = 0; k < places.size(); ++k) {
            parts[i].unknown += verdicts[k] == Verdict::unknown;
            parts[i].wrong += verdicts[k] != Verdict::unknown && verdicts[k] != truth.at(places[k]);
        }
    });
    ObjectShadowError sum;
    for (const ObjectShadowError& part : parts)
        add(sum, part);
    return sum;
}

FloorShadowError floor_shadow_error(const CasterRays& truth, const AskShadows& ask, const FloorErrorOptions& options)
{
    if (options.rays < 1)
        throw Error::Input("no rays to measure the error of shadows with");
    Random random(options.seed);
    std::vector<ShadowQuery> queries;
    for (int i = 0; i < options.rays; ++i) {
        vec3 up = random_direction(random);
        up.y = std::abs(up.y);
        const dvec3 lamp = random.uniform(2, 4) * dvec3(up), along = random_in_ball(random) - lamp;
        if (!(along.y < 0))
            continue;
        const dvec3 place = lamp + (-1 - lamp.y) / along.y * along;
        if (std::abs(place.x) <= 4 && std::abs(place.z) <= 4)
            queries.push_back({vec3(place), vec4(vec3(lamp), 1)});
    }
    std::vector<Verdict> verdicts(queries.size());
    ask(queries, verdicts);
    FloorShadowError error;
    error.queries = queries.size();
    for (std::size_t k = 0; k < queries.size(); ++k)
        error.wrong += verdicts[k] != truth.at(queries[k]);
    return error;
}

} // namespace limn
