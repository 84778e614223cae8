#include "limn/raycast/ray_scene.h"

#include "limn/raycast/embree.h"

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

} // namespace

struct RayScene::Embree : EmbreeScene {};

RayScene::RayScene(std::span<const RayTriangles> objects) : embree_(std::make_unique<Embree>())
{
    // Robust: no ray slips between two triangles. Compact: half the memory for a tenth of the speed.
    embree_->open(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    for (unsigned id = 0; id < objects.size(); ++id) {
        const RayTriangles& object = objects[id];
        const RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, object.positions.data(), 0, sizeof(vec3), object.positions.size());
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, object.triangles.data(), 0, sizeof(uvec3), object.triangles.size());
        embree_->attach(geometry, id);
    }
    embree_->commit();
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
