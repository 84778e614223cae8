#include "limn/raycast/ray_scene.h"

#include <cmath>
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

/// What the filter below needs besides Embree's own context; the context comes first so that the two can be cast.
struct FilterContext {
    RTCIntersectContext base;
    bool (*accept)(void*, const Hit&);
    void* context;
};

void filter(const RTCFilterFunctionNArguments* arguments)
{
    const auto* context = reinterpret_cast<const FilterContext*>(arguments->context);
    if (arguments->valid[0] == 0)
        return;
    const auto* ray = reinterpret_cast<const RTCRay*>(arguments->ray);
    const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
    const Hit found = {hit->geomID, hit->primID, ray->tfar, hit->u, hit->v};
    if (!context->accept(context->context, found))
        arguments->valid[0] = 0;
}

RTCRay to_embree(const Ray& ray)
{
    RTCRay r = {};
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.tnear = ray.near, r.tfar = ray.far;
    r.mask = 0xFFFFFFFFu;
    return r;
}

/// Embree ends the process over rays that hold NaN or numbers near the end of float. They meet nothing.
bool traceable(const Ray& ray)
{
    constexpr float most = 1e18f;
    const auto fits = [](const vec3& v) { return std::abs(v.x) <= most && std::abs(v.y) <= most && std::abs(v.z) <= most; };
    return fits(ray.origin) && fits(ray.direction) && !std::isnan(ray.near) && !std::isnan(ray.far);
}

} // namespace

struct RayScene::Embree {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    Embree() = default;
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;
    ~Embree()
    {
        if (scene)
            rtcReleaseScene(scene);
        if (device)
            rtcReleaseDevice(device);
    }
};

RayScene::RayScene(std::span<const RayTriangles> objects) : embree_(std::make_unique<Embree>())
{
    embree_->device = rtcNewDevice(nullptr);
    if (!embree_->device)
        throw Error::Device(fmt::format("the ray tracer (Embree) cannot start: error {}", int(rtcGetDeviceError(nullptr))));
    embree_->scene = rtcNewScene(embree_->device);
    // Robust: no ray slips between two triangles. Compact: half the memory for a tenth of the speed.
    rtcSetSceneFlags(embree_->scene, RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    for (unsigned id = 0; id < objects.size(); ++id) {
        const RayTriangles& object = objects[id];
        const RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, object.positions.data(), 0, sizeof(vec3), object.positions.size());
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, object.triangles.data(), 0, sizeof(uvec3), object.triangles.size());
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(embree_->scene, geometry, id);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(embree_->scene);
    if (const RTCError error = rtcGetDeviceError(embree_->device); error != RTC_ERROR_NONE)
        throw Error::Device(fmt::format("the ray tracer (Embree) cannot build its hierarchy: error {}{}", int(error),
                                        error == RTC_ERROR_OUT_OF_MEMORY ? " (out of memory)" : ""));
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

Hit RayScene::closest(const Ray& ray) const
{
    if (!traceable(ray))
        return {};
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query = {};
    query.ray = to_embree(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return {};
    return {query.hit.geomID, query.hit.primID, query.ray.tfar, query.hit.u, query.hit.v};
}

bool RayScene::occluded(const Ray& ray) const
{
    if (!traceable(ray))
        return false;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay query = to_embree(ray);
    rtcOccluded1(embree_->scene, &context, &query);
    return query.tfar < 0;
}

bool RayScene::occluded_by(const Ray& ray, bool (*accept)(void*, const Hit&), void* context) const
{
    if (!traceable(ray))
        return false;
    FilterContext filtered = {{}, accept, context};
    rtcInitIntersectContext(&filtered.base);
    filtered.base.filter = filter;
    RTCRay query = to_embree(ray);
    rtcOccluded1(embree_->scene, &filtered.base, &query);
    return query.tfar < 0;
}

} // namespace limn
