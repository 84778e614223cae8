#pragma once

#include <cmath>
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/raycast/ray_scene.h"

// What the scenes of this room share of Embree; for their .cpp files.

namespace limn {

/// Owns a device with one scene on it.
struct EmbreeScene {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    EmbreeScene() = default;
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;
    ~EmbreeScene()
    {
        if (scene)
            rtcReleaseScene(scene);
        if (device)
            rtcReleaseDevice(device);
    }

    /// @throws Error::Device where there is no device
    void open(int flags)
    {
        device = rtcNewDevice(nullptr);
        if (!device)
            throw Error::Device(fmt::format("the ray tracer (Embree) cannot start: error {}", int(rtcGetDeviceError(nullptr))));
        scene = rtcNewScene(device);
        rtcSetSceneFlags(scene, RTCSceneFlags(flags));
    }
    /// Adds what is built, under a number of its own.
    void attach(RTCGeometry geometry, unsigned id)
    {
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, id);
        rtcReleaseGeometry(geometry);
    }
    /// @throws Error::Device where the hierarchy cannot be built
    void commit()
    {
        rtcCommitScene(scene);
        if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
            throw Error::Device(fmt::format("the ray tracer (Embree) cannot build its hierarchy: error {}{}", int(error),
                                            error == RTC_ERROR_OUT_OF_MEMORY ? " (out of memory)" : ""));
    }
};

inline RTCRay to_embree(const Ray& ray)
{
    RTCRay r = {};
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.tnear = ray.near, r.tfar = ray.far;
    r.mask = 0xFFFFFFFFu;
    return r;
}

/// Embree ends the process over rays that hold NaN or numbers near the end of float. They meet nothing.
inline bool traceable(const Ray& ray)
{
    constexpr float most = 1e18f;
    const auto fits = [](const vec3& v) { return std::abs(v.x) <= most && std::abs(v.y) <= most && std::abs(v.z) <= most; };
    return fits(ray.origin) && fits(ray.direction) && !std::isnan(ray.near) && !std::isnan(ray.far);
}

} // namespace limn
