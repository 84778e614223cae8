#include "limn/raycast/bead_scene.h"

#include <algorithm>
#include <cmath>

#include "limn/raycast/embree.h"

namespace limn {
namespace {

/// A slanted bead is put into the hierarchy in parts: the box around all of it would be mostly empty. At most this many.
constexpr int most_parts = 64;
constexpr float widths_of_part = 8; ///< a part reaches about so many widths along the shorter side of the box

int parts_of(const BeadShape& bead)
{
    const vec3 way = 2 * bead.half_length() * glm::abs(bead.along());
    return std::clamp(int(std::min(way.x, way.y) / (widths_of_part * std::max(bead.width(), bead.height()))), 1, most_parts);
}

} // namespace

struct BeadScene::Embree : EmbreeScene {
    std::vector<BeadShape> beads;
    std::vector<std::uint32_t> first_part;   ///< of each bead, and the total; empty: every bead is one part
    std::vector<std::uint32_t> bead_of_part; ///< empty as above

    std::uint32_t bead_at(unsigned part) const { return bead_of_part.empty() ? part : bead_of_part[part]; }

    void divide()
    {
        std::vector<std::uint32_t> first = {0};
        first.reserve(beads.size() + 1);
        for (const BeadShape& bead : beads)
            first.push_back(first.back() + std::uint32_t(parts_of(bead)));
        if (first.back() == beads.size())
            return;
        bead_of_part.resize(first.back());
        for (std::size_t i = 0; i < beads.size(); ++i)
            std::fill(bead_of_part.begin() + first[i], bead_of_part.begin() + first[i + 1], std::uint32_t(i));
        first_part = std::move(first);
    }

    static void bounds(const RTCBoundsFunctionArguments* arguments)
    {
        const auto& self = *static_cast<const Embree*>(arguments->geometryUserPtr);
        const std::uint32_t bead = self.bead_at(arguments->primID);
        const BeadShape& shape = self.beads[bead];
        vec3 middle = shape.middle();
        float part = 1;
        if (!self.first_part.empty()) {
            const std::uint32_t first = self.first_part[bead], count = self.first_part[bead + 1] - first;
            part = 1 / float(count);
            middle += shape.half_length() * (2 * (float(arguments->primID - first) + 0.5f) * part - 1) * shape.along();
        }
        const vec3 half = shape.half_box(part) * 1.0001f;
        RTCBounds& box = *arguments->bounds_o;
        box.lower_x = middle.x - half.x, box.lower_y = middle.y - half.y, box.lower_z = middle.z - half.z;
        box.upper_x = middle.x + half.x, box.upper_y = middle.y + half.y, box.upper_z = middle.z + half.z;
    }

    /// The nearest place so far is moved nearer where a bead is met before it.
    bool meet(unsigned part, const RTCRay& ray, float& distance, vec3& normal) const
    {
        const BeadShape& shape = beads[bead_at(part)];
        distance = shape.meet({ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z}, ray.tnear, ray.tfar, normal);
        return distance >= ray.tnear;
    }

    static void intersect(const RTCIntersectFunctionNArguments* arguments)
    {
        if (arguments->valid[0] == 0)
            return;
        const auto& self = *static_cast<const Embree*>(arguments->geometryUserPtr);
        auto& query = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
        float distance = 0;
        vec3 normal;
        if (!self.meet(arguments->primID, query.ray, distance, normal))
            return;
        query.ray.tfar = distance;
        query.hit.primID = arguments->primID;
        query.hit.geomID = arguments->geomID;
        query.hit.Ng_x = normal.x, query.hit.Ng_y = normal.y, query.hit.Ng_z = normal.z;
    }

    static void occluded(const RTCOccludedFunctionNArguments* arguments)
    {
        if (arguments->valid[0] == 0)
            return;
        const auto& self = *static_cast<const Embree*>(arguments->geometryUserPtr);
        auto& ray = *reinterpret_cast<RTCRay*>(arguments->ray);
        float distance = 0;
        vec3 normal;
        if (self.meet(arguments->primID, ray, distance, normal))
            ray.tfar = -std::numeric_limits<float>::infinity();
    }
};

BeadScene::BeadScene(std::vector<BeadShape> beads) : embree_(std::make_unique<Embree>())
{
    Embree& e = *embree_;
    e.beads = std::move(beads);
    e.divide();
    e.open(RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(e.device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, unsigned(e.bead_of_part.empty() ? e.beads.size() : e.bead_of_part.size()));
    rtcSetGeometryUserData(geometry, &e);
    rtcSetGeometryBoundsFunction(geometry, Embree::bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, Embree::intersect);
    rtcSetGeometryOccludedFunction(geometry, Embree::occluded);
    e.attach(geometry, 0);
    e.commit();
}

BeadScene::~BeadScene() = default;
BeadScene::BeadScene(BeadScene&&) noexcept = default;
BeadScene& BeadScene::operator=(BeadScene&&) noexcept = default;

BeadHit BeadScene::closest(const Ray& ray) const
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
    return {embree_->bead_at(query.hit.primID), query.ray.tfar, vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z)};
}

bool BeadScene::occluded(const Ray& ray) const
{
    if (!traceable(ray))
        return false;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay query = to_embree(ray);
    rtcOccluded1(embree_->scene, &context, &query);
    return query.tfar < 0;
}

const std::vector<BeadShape>& BeadScene::beads() const { return embree_->beads; }

} // namespace limn
