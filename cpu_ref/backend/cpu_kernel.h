// The shared kernels, as C++ over Embree.
#pragma once

#include <cassert>
#include <vector>

#include "backend/resampling_films.h"
#include "embree/embree_scene.h"
#include "leaves.h"
#include "pack/packed_scene.h"

namespace diptych::core {

/// One ray as an integrator traced it.
struct TracedRay {
    glm::vec3 origin;
    glm::vec3 direction;
    float t_max;  // infinite for a nearest-hit query
    bool any;
    std::uint32_t alpha_key;
};

/// Traces over Embree and does nothing else.
struct PlainTracer {
    static constexpr bool records_paths = false;
    const EmbreeScene& scene;

    EmbreeHit closest(const glm::vec3& origin, const glm::vec3& direction, std::uint32_t alpha_key) const {
        return scene.closest(origin, direction, alpha_key);
    }
    EmbreeHit emitter(const glm::vec3& origin, const glm::vec3& direction, float t_max) const {
        return scene.emitter(origin, direction, t_max);
    }
    bool any(const glm::vec3& origin, const glm::vec3& direction, float t_max, std::uint32_t alpha_key) const {
        return scene.any(origin, direction, t_max, alpha_key);
    }
    bool any_previous(const glm::vec3& origin, const glm::vec3& direction, float t_max, std::uint32_t alpha_key) const {
        return scene.any_previous(origin, direction, t_max, alpha_key);
    }
};

/// Also keeps every ray, in the order in which they were traced.
struct RecordingTracer {
    static constexpr bool records_paths = false;
    const EmbreeScene& scene;
    std::vector<TracedRay>& rays;

    EmbreeHit closest(const glm::vec3& origin, const glm::vec3& direction, std::uint32_t alpha_key) const {
        rays.push_back({origin, direction, shared::INFINITE_DISTANCE, false, alpha_key});
        return scene.closest(origin, direction, alpha_key);
    }
    bool any(const glm::vec3& origin, const glm::vec3& direction, float t_max, std::uint32_t alpha_key) const {
        rays.push_back({origin, direction, t_max, true, alpha_key});
        return scene.any(origin, direction, t_max, alpha_key);
    }
};

/// Also begins a record for every vertex, which RECORD then fills.
struct PathRecorder {
    static constexpr bool records_paths = true;
    const EmbreeScene& scene;
    std::vector<shared::PathVertexRecord>& vertices;

    EmbreeHit closest(const glm::vec3& origin, const glm::vec3& direction, std::uint32_t alpha_key) const {
        const EmbreeHit h = scene.closest(origin, direction, alpha_key);
        const shared::Hit hit{h.instance, h.geometry, h.primitive, glm::vec2(h.u, h.v), h.t};
        vertices.push_back(shared::begin_vertex_record(direction, hit));
        return h;
    }
    bool any(const glm::vec3& origin, const glm::vec3& direction, float t_max, std::uint32_t alpha_key) const {
        const bool blocked = scene.any(origin, direction, t_max, alpha_key);
        vertices.back().shadow = blocked ? shared::SHADOW_BLOCKED : shared::SHADOW_FREE;
        return blocked;
    }
};

namespace shared {

/// The hooks of hooks.md, and the integrators as members. Code behind features outside ALLOWED is left out; the scene
/// must not need them.
template <class Tracer, uint ALLOWED>
struct CpuKernel {
    const PackedScene& packed;
    const RenderConstants& constants;
    Tracer tracer;
    ResamplingFilms* films = nullptr;  // only resampling asks for them

    bool feature(uint bit) const { return (features() & bit) != 0; }
    uint features() const { return packed.features & ALLOWED; }

#define DEFINE_LOAD(Type, name)                                                                                        \
    const Type& load_##name(uint index) const {                                                                        \
        assert(index < packed.name.size());                                                                            \
        return packed.name[index];                                                                                     \
    }
    SCENE_BUFFERS(DEFINE_LOAD)
#undef DEFINE_LOAD

    Hit trace_closest(vec3 origin, vec3 direction, uint alpha_key) const {
        return hit_of(tracer.closest(origin, direction, alpha_key));
    }
    LightPoint trace_emitters(vec3 origin, vec3 direction, float t_max) const {
        const EmbreeHit h = tracer.emitter(origin, direction, t_max);
        return {h.primitive, vec2(h.u, h.v)};
    }
    static Hit hit_of(const EmbreeHit& h) {
        return {h.instance, h.geometry, h.primitive, vec2(h.u, h.v), h.t};
    }
    bool trace_any(vec3 origin, vec3 direction, float t_max, uint alpha_key) const {
        return tracer.any(origin, direction, t_max, alpha_key);
    }
    bool trace_any_previous(vec3 origin, vec3 direction, float t_max, uint alpha_key) const {
        return tracer.any_previous(origin, direction, t_max, alpha_key);
    }

    const FirstVertex& load_first_vertex(uint index) const {
        return films->first_vertices[index];
    }
    void store_first_vertex(uint index, const FirstVertex& vertex) const {
        films->first_vertices[index] = vertex;
    }
    const Reservoir& load_reservoir(uint set, uint index) const {
        return films->reservoirs[set * films->pixels + index];
    }
    void store_reservoir(uint set, uint index, const Reservoir& r) const {
        films->reservoirs[set * films->pixels + index] = r;
    }
    const ReuseSurface& load_reuse_surface(uint set, uint index) const {
        return films->surfaces[set * films->pixels + index];
    }
    void store_reuse_surface(uint set, uint index, const ReuseSurface& s) const {
        films->surfaces[set * films->pixels + index] = s;
    }

#define RECORD(field, value)                                                                                           \
    if constexpr (Tracer::records_paths) {                                                                             \
        tracer.vertices.back().field = (value);                                                                        \
    }
#include "restir/restir.kernel.h"
#include "path/trace_path.kernel.h"
#undef RECORD
};

}  // namespace shared
}  // namespace diptych::core
