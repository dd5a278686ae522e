#include "embree/embree_scene.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <utility>

#include "error.h"
#include "leaves.h"
#include "pack/emitter_corners.h"
#include "pack/packed_scene.h"

namespace diptych::core {
namespace shared {
namespace {

/// The hooks of hooks.md that a candidate hit needs.
struct AlphaKernel {
    const PackedScene& packed;

    bool feature(uint bit) const { return (packed.features & bit) != 0; }

#define DEFINE_LOAD(Type, name)                                                                                        \
    const Type& load_##name(uint index) const {                                                                        \
        return packed.name[index];                                                                                     \
    }
    SCENE_BUFFERS(DEFINE_LOAD)
#undef DEFINE_LOAD

#include "geometry/alpha.kernel.h"
};

}  // namespace
}  // namespace shared

namespace {

#if DIPTYCH_EMBREE_VERSION >= 4
using BaseContext = RTCRayQueryContext;
#else
using BaseContext = RTCIntersectContext;
#endif

/// What a filter is told beside the ray.
struct RayContext {
    BaseContext base;
    std::uint32_t alpha_key;
};

RayContext make_context(std::uint32_t alpha_key) {
    RayContext context;
#if DIPTYCH_EMBREE_VERSION >= 4
    rtcInitRayQueryContext(&context.base);
#else
    rtcInitIntersectContext(&context.base);
#endif
    context.alpha_key = alpha_key;
    return context;
}

void set_ray(RTCRay& ray, const glm::vec3& origin, const glm::vec3& direction, float t_max) {
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.tnear = 0;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.time = 0;
    ray.tfar = t_max;
    ray.mask = ~0U;
    ray.id = 0;
    ray.flags = 0;
}

void filter_alpha(const RTCFilterFunctionNArguments* args) {
    const auto* context = reinterpret_cast<const RayContext*>(args->context);
    shared::AlphaKernel kernel{*static_cast<const PackedScene*>(args->geometryUserPtr)};
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) {
            continue;
        }
        const glm::vec2 barycentrics(RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i));
        const bool accepted =
            kernel.accepts_hit(RTCHitN_instID(args->hit, args->N, i, 0), RTCHitN_geomID(args->hit, args->N, i),
                               RTCHitN_primID(args->hit, args->N, i), barycentrics, context->alpha_key);
        args->valid[i] = accepted ? -1 : 0;
    }
}

bool count_memory(void* counter, ssize_t bytes, bool) {
    static_cast<std::atomic<std::int64_t>*>(counter)->fetch_add(bytes);
    return true;
}

}  // namespace

std::string embree_version() {
    return RTC_VERSION_STRING;
}

EmbreeScene::EmbreeScene(const PackedScene& packed)
    : bytes_(std::make_unique<std::atomic<std::int64_t>>(0)), device_(rtcNewDevice(nullptr)) {
    if (!device_) {
        throw Error("Embree: no device: error " + std::to_string(rtcGetDeviceError(nullptr)));
    }
    rtcSetDeviceMemoryMonitorFunction(device_.get(), count_memory, bytes_.get());
    for (std::size_t mesh = 0; mesh < packed.meshes.size(); ++mesh) {
        meshes_.push_back(build_mesh(packed, mesh));
    }
    root_ = build_root(packed);
    if (packed.keeps_previous) {
        previous_ = build_root(packed);
    }
    place_emitters(packed);
    check("build");
}

void EmbreeScene::check(const char* what) const {
    const RTCError error = rtcGetDeviceError(device_.get());
    if (error != RTC_ERROR_NONE) {
        throw Error(std::string("Embree: ") + what + ": error " + std::to_string(error));
    }
}

EmbreeScene::ScenePtr EmbreeScene::build_mesh(const PackedScene& packed, std::size_t mesh) const {
    const MeshRange range = packed.meshes[mesh];
    if (range.geometry_count == 0) {
        return nullptr;
    }
    ScenePtr scene(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    for (std::uint32_t i = 0; i < range.geometry_count; ++i) {
        const shared::Geometry& g = packed.geometries[range.first_geometry + i];
        const GeometryExtent& extent = packed.geometry_extents[range.first_geometry + i];
        RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, packed.positions.data(),
                                   g.first_vertex * sizeof(glm::vec3), sizeof(glm::vec3), extent.vertex_count);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, packed.triangles.data(),
                                   g.first_triangle * sizeof(glm::uvec3), sizeof(glm::uvec3), extent.triangle_count);
        if (MUTANT(EMBREE_ALPHA_IGNORED, extent.alpha, false)) {
            rtcSetGeometryUserData(geometry, const_cast<PackedScene*>(&packed));
            rtcSetGeometryIntersectFilterFunction(geometry, filter_alpha);
            rtcSetGeometryOccludedFilterFunction(geometry, filter_alpha);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene.get(), geometry, i);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene.get());
    check("mesh");
    return scene;
}

EmbreeScene::Placement EmbreeScene::placement(const PackedScene& packed, std::size_t instance) {
    const shared::Instance& i = packed.instances[instance];
    // Of what does not show Embree still takes the inverse.
    return is_shown(packed, instance)
               ? Placement{{i.row_0, i.row_1, i.row_2}, true}
               : Placement{{glm::vec4(1, 0, 0, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, 0, 1, 0)}, false};
}

void EmbreeScene::place(RTCGeometry geometry, const Placement& placement) {
    const RTCFormat format = MUTANT(EMBREE_TRANSPOSED, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR);
    rtcSetGeometryTransform(geometry, 0, format, placement.rows.data());
    if (placement.shown) {
        rtcEnableGeometry(geometry);
    } else {
        rtcDisableGeometry(geometry);
    }
    rtcCommitGeometry(geometry);
}

EmbreeScene::Root EmbreeScene::build_root(const PackedScene& packed) const {
    Root root;
    root.scene.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(root.scene.get(), RTC_SCENE_FLAG_ROBUST);
    for (std::size_t i = 0; i < packed.instances.size(); ++i) {
        RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, meshes_[packed.instance_meshes[i]].get());
        root.placements.push_back(placement(packed, i));
        place(geometry, root.placements.back());
        rtcAttachGeometryByID(root.scene.get(), geometry, static_cast<unsigned>(i));
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(root.scene.get());
    root.revision = packed.revisions.instances;
    return root;
}

void EmbreeScene::require_instances(const PackedScene& packed) const {
    if (packed.instances.size() != root_.placements.size()) {
        throw Error("Embree: " + std::to_string(packed.instances.size()) + " instances where the moment before had " +
                    std::to_string(root_.placements.size()));
    }
}

void EmbreeScene::place_all(const PackedScene& packed, Root& root) {
    const std::uint64_t revision = std::exchange(root.revision, packed.revisions.instances);
    if (revision != 0 && revision == root.revision) {
        return;
    }
    bool moved = false;
    for (std::size_t i = 0; i < packed.instances.size(); ++i) {
        const Placement next = placement(packed, i);
        if (next != root.placements[i]) {
            root.placements[i] = next;
            place(rtcGetGeometry(root.scene.get(), static_cast<unsigned>(i)), next);
            moved = true;
        }
    }
    if (moved) {
        rtcCommitScene(root.scene.get());
    }
}

void EmbreeScene::place_emitters(const PackedScene& packed) {
    if (!searches_emitters(packed)) {
        emitters_.reset();
        return;
    }
    const bool known = emitter_revision_ != 0 && emitter_revision_ == packed.revisions.emissive_triangles;
    if (emitters_ && MUTANT(EMBREE_EMITTERS_STAY, known, true)) {
        return;
    }
    const std::vector<shared::vec3> corners = emitter_corners(packed);
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                             corners.size());
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                            corners.size() / 3);
    check("emitters");
    std::copy(corners.begin(), corners.end(), static_cast<glm::vec3*>(vertices));
    std::iota(static_cast<std::uint32_t*>(indices), static_cast<std::uint32_t*>(indices) + corners.size(), 0U);
    rtcCommitGeometry(geometry);
    ScenePtr scene(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    check("emitters");
    emitters_ = std::move(scene);
    emitter_revision_ = packed.revisions.emissive_triangles;
}

void EmbreeScene::move_to(const PackedScene& moment) {
    require_instances(moment);
    if (moment.keeps_previous &&
        MUTANT(EMBREE_PREVIOUS_STAYS, true, moment.revisions.instances != root_.revision)) {
        std::swap(root_, previous_);
    }
    place_all(moment, root_);
    place_emitters(moment);
    check("move");
}

void EmbreeScene::reconfigure(const PackedScene& packed) {
    require_instances(packed);
    for (std::size_t mesh = 0; mesh < meshes_.size(); ++mesh) {
        const MeshRange range = packed.meshes[mesh];
        for (std::uint32_t i = 0; i < range.geometry_count; ++i) {
            if (packed.geometry_extents[range.first_geometry + i].alpha) {
                rtcSetGeometryUserData(rtcGetGeometry(meshes_[mesh].get(), i), const_cast<PackedScene*>(&packed));
            }
        }
    }
    place_all(packed, root_);
    if (!packed.keeps_previous) {
        previous_ = {};
    } else if (previous_.scene) {
        place_all(packed, previous_);
    } else {
        previous_ = build_root(packed);
    }
    place_emitters(packed);
    check("reconfigure");
}

namespace {

EmbreeHit nearest(RTCScene scene, const glm::vec3& origin, const glm::vec3& direction, float t_max,
                  std::uint32_t alpha_key) {
    RayContext context = make_context(alpha_key);
    RTCRayHit query;
    set_ray(query.ray, origin, direction, t_max);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.primID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if DIPTYCH_EMBREE_VERSION >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context.base;
    rtcIntersect1(scene, &query, &arguments);
#else
    rtcIntersect1(scene, &context.base, &query);
#endif
    return {query.hit.instID[0], query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar};
}

}  // namespace

EmbreeHit EmbreeScene::closest(const glm::vec3& origin, const glm::vec3& direction, std::uint32_t alpha_key) const {
    return nearest(root_.scene.get(), origin, direction, std::numeric_limits<float>::infinity(), alpha_key);
}

EmbreeHit EmbreeScene::emitter(const glm::vec3& origin, const glm::vec3& direction, float t_max) const {
    assert(emitters_);
    return nearest(emitters_.get(), origin, direction, t_max, 0);
}

bool EmbreeScene::any(const glm::vec3& origin, const glm::vec3& direction, float t_max, std::uint32_t alpha_key) const {
    return occluded(root_.scene.get(), origin, direction, t_max, alpha_key);
}

bool EmbreeScene::any_previous(const glm::vec3& origin, const glm::vec3& direction, float t_max,
                               std::uint32_t alpha_key) const {
    return occluded(previous_.scene ? previous_.scene.get() : root_.scene.get(), origin, direction, t_max, alpha_key);
}

bool EmbreeScene::occluded(RTCScene root, const glm::vec3& origin, const glm::vec3& direction, float t_max,
                           std::uint32_t alpha_key) const {
    RayContext context = make_context(alpha_key);
    RTCRay ray;
    set_ray(ray, origin, direction, t_max);
#if DIPTYCH_EMBREE_VERSION >= 4
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context.base;
    rtcOccluded1(root, &ray, &arguments);
#else
    rtcOccluded1(root, &context.base, &ray);
#endif
    return ray.tfar < 0;
}

}  // namespace diptych::core
