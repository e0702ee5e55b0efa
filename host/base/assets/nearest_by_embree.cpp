// SPDX-License-Identifier: MIT
#include "nearest_by_embree.hpp"

#include <embree3/rtcore.h>

#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

namespace tactus::host
{

namespace
{
/// Beyond this distance from the mesh, in multiples of its size, floats cannot tell one triangle from another.
constexpr double farthest = 1e5;

/// An upper bound on the error of rounding points to float and of Embree's own sums, for sizes around 1. A
/// float is precise to 6e-8.
constexpr double blur = 1e-6;

struct Search
{
    const Mesh& mesh;
    const Vec3& p;
    double scale;   // from metres to the units of the index
    double slack;
    double least = std::numeric_limits<double>::infinity();   // smallest squared distance so far, in m^2
    int best = 0;
};

/// Embree calls this for each triangle whose bounding box is within the radius.
bool compare (RTCPointQueryFunctionArguments* found)
{
    auto& search = *static_cast<Search*> (found->userPtr);
    const int triangle = static_cast<int> (found->primID);
    const double distance2 = (nearestOn (search.mesh, triangle, search.p).point - search.p).squaredNorm();
    if (distance2 > search.least || (distance2 == search.least && triangle > search.best)) return false;
    search.best = triangle;
    search.least = distance2;

    // Wide enough to include every triangle at this distance.
    const auto radius = static_cast<float> (std::sqrt (distance2) * search.scale * (1.0 + blur) + search.slack);
    if (radius >= found->query->radius) return false;
    found->query->radius = radius;
    return true;
}

class EmbreeTriangles final : public NearestTriangle
{
public:
    explicit EmbreeTriangles (std::shared_ptr<const Mesh> m) : mesh (std::move (m)), device (rtcNewDevice ("threads=1"), rtcReleaseDevice)
    {
        if (! device) throw std::runtime_error ("cannot start Embree");
        scene.reset (rtcNewScene (device.get()));
        fit();

        auto* geometry = rtcNewGeometry (device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* at =
            static_cast<float*> (rtcSetNewGeometryBuffer (geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof (float), mesh->points.size()));
        auto* corner = static_cast<unsigned*> (
            rtcSetNewGeometryBuffer (geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof (unsigned), mesh->triangles.size()));
        if (at == nullptr || corner == nullptr) throw std::bad_alloc();
        for (const auto& point : mesh->points)
            for (const double coordinate : Vec3 ((point - centre) * scale))
                *at++ = static_cast<float> (coordinate);
        for (const auto& triangle : mesh->triangles)
            for (const int number : triangle)
                *corner++ = static_cast<unsigned> (number);

        rtcSetGeometryBuildQuality (geometry, RTC_BUILD_QUALITY_MEDIUM);
        rtcCommitGeometry (geometry);
        rtcAttachGeometry (scene.get(), geometry);
        rtcReleaseGeometry (geometry);
        rtcCommitScene (scene.get());
        if (rtcGetDeviceError (device.get()) != RTC_ERROR_NONE) throw std::bad_alloc();
    }

    int operator() (const Vec3& p) const noexcept override
    {
        const Vec3 at = (p - centre) * scale;
        const double away = at.norm();
        if (! (away < farthest)) return nearestOfAll (*mesh, p);

        Search search { *mesh, p, scale, blur * (1.0 + away) };
        RTCPointQuery query { static_cast<float> (at.x()), static_cast<float> (at.y()), static_cast<float> (at.z()), 0.0f,
                              std::numeric_limits<float>::infinity() };
        RTCPointQueryContext context;
        rtcInitPointQueryContext (&context);
        rtcPointQuery (scene.get(), &query, &context, compare, &search);
        return search.best;
    }

private:
    std::shared_ptr<const Mesh> mesh;
    std::unique_ptr<RTCDeviceTy, void (*) (RTCDevice)> device;
    std::unique_ptr<RTCSceneTy, void (*) (RTCScene)> scene { nullptr, rtcReleaseScene };
    Vec3 centre = Vec3::Zero();
    double scale = 1.0;

    /// Finds the centre and size of the mesh, so that floats are precise wherever the mesh is and however small it is.
    void fit()
    {
        Vec3 low = mesh->points.front(), high = low;
        for (const auto& point : mesh->points)
        {
            low = low.cwiseMin (point);
            high = high.cwiseMax (point);
        }
        centre = 0.5 * low + 0.5 * high;
        if (const double size = (high - low).maxCoeff(); size > 1e-300) scale = 1.0 / size;
    }
};
}   // namespace

std::unique_ptr<NearestTriangle> nearestByEmbree (std::shared_ptr<const Mesh> mesh) { return std::make_unique<EmbreeTriangles> (std::move (mesh)); }

}   // namespace tactus::host
