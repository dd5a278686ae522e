#include "passes/pass_table.h"

#include <algorithm>
#include <initializer_list>

#include "language/compat.h"
#include "error.h"
#include "shader_binaries.h"

namespace diptych::core {
namespace {

using enum Resource;
using List = std::initializer_list<Resource>;

PassUses pass(std::string_view shader, List reads, List writes, List appends = {}) {
    PassUses pass{.shader = shader, .uses = {}};
    const Unit unit = shader.ends_with(".comp") ? Unit::compute : Unit::trace;
    const auto add = [&](List resources, Effect effect) {
        for (const Resource resource : resources) {
            pass.uses.push_back({resource, unit, effect});
        }
    };
    add(reads, Effect::read);
    add(writes, Effect::write);
    add(appends, Effect::append);
    return pass;
}

// Only a variant of the shaders records rays. That adds no barrier, because appends commute.
std::vector<PassUses> make_table() {
    return {
        // Paths in waves: shadow rays are traced while the paths trace their next rays.
        pass("wave_begin.comp", {scene}, {wave_paths, wave_radiance, wave_queues}),
        pass("wave_rays.rgen", {scene, structures, wave_paths, wave_queues}, {wave_hits}, {recorded_rays}),
        pass("wave_shadows.rgen",
             {scene, structures, MUTANT(SHADOW_RAYS_UNDECLARED, wave_shadows, structures), wave_radiance},
             {wave_radiance}, {recorded_rays}),
        pass("wave_shade.comp", {scene, wave_paths, wave_radiance, wave_queues, wave_hits, wave_counts},
             {wave_paths, wave_radiance, wave_queues, wave_shadows, wave_counts, wave_first_hits}),
        pass("wave_film.comp", {scene, wave_paths, wave_radiance, wave_first_hits, film}, {film}),
        // Resampling
        pass("restir_first_hits.rgen", {scene, structures}, {first_vertices}, {recorded_rays}),
        pass("restir_candidates.comp", {scene, first_vertices},
             {first_vertices, reservoirs, reuse_surfaces, candidate_list}),
        pass("restir_share_picked.rgen", {scene, structures, candidate_list, first_vertices, reservoirs},
             {first_vertices, reservoirs}),
        pass("restir_bsdf_candidates.rgen", {scene, structures, candidate_list, first_vertices, reservoirs},
             {first_vertices, reservoirs}),
        pass("restir_candidate_shadows.rgen", {scene, structures, first_vertices, reservoirs},
             {first_vertices, reservoirs}, {recorded_rays}),
        pass("restir_temporal.comp", {scene, first_vertices, reservoirs, reuse_surfaces}, {reservoirs}),
        pass("restir_temporal.rgen", {scene, structures, first_vertices, reservoirs, reuse_surfaces},
             {first_vertices, reservoirs}, {recorded_rays}),
        pass("restir_spatial.comp", {scene, reservoirs, reuse_surfaces}, {reservoirs}),
        pass("restir_spatial.rgen", {scene, structures, first_vertices, reservoirs, reuse_surfaces},
             {first_vertices, reservoirs}, {recorded_rays}),
        pass("restir_shadows.rgen", {scene, structures, first_vertices, reservoirs}, {first_vertices, reservoirs},
             {recorded_rays}),
        pass("restir_shade.comp", {scene, first_vertices, reservoirs, film},
             {film, wave_paths, wave_radiance, wave_first_hits, wave_queues, wave_counts}),
        // Records of paths, and the bench of recorded rays
        pass("record.rgen", {scene, structures, path_queries}, {path_records}, {recorded_rays}),
        pass("bare.rgen", {scene, structures, recorded_rays}, {recorded_rays}),
        // The picture of a window; its image has barriers of its own
        pass("display.comp", {film, reservoirs}, {histogram}),
    };
}

}  // namespace

std::span<const PassUses> pass_table() {
    static const std::vector<PassUses> table = make_table();
    return table;
}

std::span<const Use> uses_of(Spirv shader) {
    const std::span<const PassUses> table = pass_table();
    const auto found = std::find_if(table.begin(), table.end(), [&](const PassUses& pass) {
        return shader_binary(pass.shader).data() == shader.data();
    });
    if (found == table.end()) {
        throw Error("a shader that begins a pass is not in the table of passes (vk_backend/passes/pass_table.cpp)");
    }
    return found->uses;
}

}  // namespace diptych::core
