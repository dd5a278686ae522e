#include "oracle/traversal.h"

#include <atomic>
#include <cmath>
#include <string>
#if DIPTYCH_EMBREE_VERSION >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "error.h"
#include "oracle/random.h"
#include "oracle/surface.h"

namespace diptych::core::oracle {

namespace {

#if DIPTYCH_EMBREE_VERSION >= 4
using BaseContext = RTCRayQueryContext;
constexpr auto init_context = rtcInitRayQueryContext;
#else
using BaseContext = RTCIntersectContext;
constexpr auto init_context = rtcInitIntersectContext;
#endif

/// In front of the origin by more than double's own rounding, relative to the scene.
constexpr double least_t = 1e-11;
/// How far behind its origin Embree's ray starts, and how far beyond its end it goes, relative to the scene. Float's
/// rounding is 6e-8 of the largest coordinate across a surface, and 1 / cos of that along a ray that grazes it.
constexpr double head_start = 1e-5;
constexpr double run_out = 1e-3;
/// How far apart two surfaces may be, relative to the scene, for float to take one for the other.
constexpr double float_blur = 2e-5;

struct RayContext {
    BaseContext base;  // first, so that Embree's pointer leads back here
    const World* world;
    const Ray* ray;
    std::optional<Hit>* nearest = nullptr;  // where every candidate is to be seen: the nearest of them, in double
};

bool count_memory(void* counter, ssize_t bytes, bool) {
    static_cast<std::atomic<std::int64_t>*>(counter)->fetch_add(bytes);
    return true;
}

void refuse_false_candidates(const RTCFilterFunctionNArguments* args) {
    const auto& context = *reinterpret_cast<const RayContext*>(args->context);
    const std::size_t index = RTCHitN_primID(args->hit, args->N, 0);
    const Ray& ray = *context.ray;
    if (index == ray.from || index == ray.to) {
        args->valid[0] = 0;
        return;
    }
    const std::optional<Hit> hit = cross_plane(context.world->triangles[index], index, ray);
    if (!hit || !(hit->t > least_t * context.world->extent && hit->t < ray.t_max) ||
        !is_there(*context.world, ray, *hit)) {
        args->valid[0] = 0;
        return;
    }
    if (context.nearest != nullptr) {
        if (!*context.nearest || hit->t < (*context.nearest)->t) {
            *context.nearest = hit;
        }
        args->valid[0] = 0;  // so that Embree goes on
    }
}

}  // namespace

struct Traversal::Structures {
    const World* world;
    std::atomic<std::int64_t> bytes = 0;  // outlives the device, which counts here
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    explicit Structures(const World& w) : world(&w) {}
    Structures(const Structures&) = delete;
    Structures& operator=(const Structures&) = delete;
    ~Structures() {
        if (scene != nullptr) {
            rtcReleaseScene(scene);
        }
        if (device != nullptr) {
            rtcReleaseDevice(device);
        }
    }

    void build() {
        device = rtcNewDevice(nullptr);
        if (device == nullptr) {
            throw Error("oracle: Embree: no device: error " + std::to_string(rtcGetDeviceError(nullptr)));
        }
        rtcSetDeviceMemoryMonitorFunction(device, count_memory, &bytes);
        scene = rtcNewScene(device);
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        if (!world->triangles.empty()) {
            add_triangles();
        }
        rtcCommitScene(scene);
        const RTCError error = rtcGetDeviceError(device);
        if (error != RTC_ERROR_NONE) {
            throw Error("oracle: Embree: build: error " + std::to_string(error));
        }
    }

    /// Vertices are not shared, yet those that are one in the scene have the same bits.
    void add_triangles() {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        const std::size_t count = world->triangles.size();
        auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), 3 * count));
        auto* indices = static_cast<glm::uvec3*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), count));
        if (vertices == nullptr || indices == nullptr) {
            rtcReleaseGeometry(geometry);
            throw Error("oracle: Embree: out of memory for " + std::to_string(count) + " triangles");
        }
        for (std::size_t i = 0; i < count; ++i) {
            const Triangle& triangle = world->triangles[i];
            vertices[3 * i] = glm::vec3(triangle.a);
            vertices[3 * i + 1] = glm::vec3(triangle.b);
            vertices[3 * i + 2] = glm::vec3(triangle.c);
            indices[i] = glm::uvec3(3 * i, 3 * i + 1, 3 * i + 2);
        }
        rtcSetGeometryIntersectFilterFunction(geometry, refuse_false_candidates);
        rtcSetGeometryOccludedFilterFunction(geometry, refuse_false_candidates);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
    }

    RTCRay float_ray(const Ray& ray) const {
        const double largest_coordinate = glm::max(world->extent, length(ray.origin));
        const double back = head_start * largest_coordinate;
        const dvec3 start = ray.origin - back * ray.direction;
        RTCRay query;
        query.org_x = float(start.x);
        query.org_y = float(start.y);
        query.org_z = float(start.z);
        query.dir_x = float(ray.direction.x);
        query.dir_y = float(ray.direction.y);
        query.dir_z = float(ray.direction.z);
        query.tnear = 0;
        query.tfar = float(ray.t_max + run_out * largest_coordinate);
        query.time = 0;
        query.mask = ~0U;
        query.id = 0;
        query.flags = 0;
        return query;
    }

    void intersect(RayContext& context, RTCRayHit& query) const {
        init_context(&context.base);
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if DIPTYCH_EMBREE_VERSION >= 4
        RTCIntersectArguments arguments;
        rtcInitIntersectArguments(&arguments);
        arguments.context = &context.base;
        rtcIntersect1(scene, &query, &arguments);
#else
        rtcIntersect1(scene, &context.base, &query);
#endif
    }
};

std::optional<Hit> cross_plane(const Triangle& triangle, std::size_t index, const Ray& ray) {
    // Möller and Trumbore 1997.
    const dvec3 p = cross(ray.direction, triangle.ac);
    const double determinant = dot(triangle.ab, p);
    if (determinant == 0) {
        return std::nullopt;
    }
    const dvec3 s = ray.origin - triangle.a;
    const dvec3 q = cross(s, triangle.ab);
    return Hit{index, dvec2(dot(s, p), dot(ray.direction, q)) / determinant, dot(triangle.ac, q) / determinant};
}

namespace {

/// Rounding in float lets rays hit just beside a triangle, which closes the cracks between neighbours.
dvec2 held_inside(dvec2 uv) {
    const dvec2 positive = max(uv, dvec2(0));
    return positive / glm::max(1.0, positive.x + positive.y);
}

}  // namespace

bool is_there(const World& world, const Ray& ray, const Hit& hit) {
    const Triangle& triangle = world.triangles[hit.triangle];
    if (triangle.material->alpha_mode == AlphaMode::opaque) {
        return true;
    }
    const double coin = double(scatter_bits(ray.coin ^ scatter_bits(hit.triangle)) >> 11U) * 0x1p-53;
    return coin < coverage(world, triangle, held_inside(hit.barycentrics));
}

Traversal::Traversal(const World& world) : structures_(std::make_unique<Structures>(world)) {
    structures_->build();
}

Traversal::~Traversal() = default;

std::uint64_t Traversal::bytes() const {
    return std::uint64_t(structures_->bytes.load());
}

std::optional<Hit> Traversal::closest(const Ray& ray) const {
    RayContext context{{}, structures_->world, &ray};
    RTCRayHit query;
    query.ray = structures_->float_ray(ray);
    structures_->intersect(context, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return std::nullopt;
    }
    const std::size_t index = query.hit.primID;
    std::optional<Hit> hit = cross_plane(structures_->world->triangles[index], index, ray);
    // The sheets of a flattened shape are so close that float may have met the farther one: once more about there.
    const double found = double(query.ray.tfar);
    const double blur = float_blur * glm::max(structures_->world->extent, length(ray.origin));
    query.ray = structures_->float_ray(ray);
    query.ray.tnear = float(glm::max(found - blur, 0.0));
    query.ray.tfar = float(found + blur);
    context.nearest = &hit;
    structures_->intersect(context, query);
    hit->barycentrics = held_inside(hit->barycentrics);
    return hit;
}

bool Traversal::any(const Ray& ray) const {
    RayContext context{{}, structures_->world, &ray};
    init_context(&context.base);
    RTCRay query = structures_->float_ray(ray);
#if DIPTYCH_EMBREE_VERSION >= 4
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context.base;
    rtcOccluded1(structures_->scene, &query, &arguments);
#else
    rtcOccluded1(structures_->scene, &context.base, &query);
#endif
    return query.tfar < 0;
}

}  // namespace diptych::core::oracle
