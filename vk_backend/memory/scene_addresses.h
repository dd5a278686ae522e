// Where the shaders find everything: the uniform block SceneAddresses of shaders/scene_hooks.glsl.
#pragma once

#include <cstdint>

#include "language/scene_buffers.h"

namespace diptych {

/// Device addresses; 0 where there is no such buffer.
struct SceneAddresses {
#define DECLARE_ADDRESS(Type, name) std::uint64_t name = 0;
    SCENE_BUFFERS(DECLARE_ADDRESS)
#undef DECLARE_ADDRESS
    std::uint64_t film_pixels = 0;
    std::uint64_t film_moments = 0;
    std::uint64_t film_first_hits = 0;
    std::uint64_t first_vertices = 0;
    std::uint64_t reservoirs = 0;
    std::uint64_t reuse_surfaces = 0;
    std::uint64_t candidate_list = 0;
    std::uint64_t recorded_rays = 0;
    std::uint64_t ray_counters = 0;
    std::uint64_t path_queries = 0;
    std::uint64_t path_vertices = 0;
    std::uint64_t path_summaries = 0;
    std::uint64_t grouped_geometries = 0;
    std::uint64_t wave_paths = 0;
    std::uint64_t wave_first_hits = 0;
    std::uint64_t wave_queues = 0;
    std::uint64_t wave_hits = 0;
    std::uint64_t wave_shadows = 0;
    std::uint64_t wave_counts = 0;
};

}  // namespace diptych
