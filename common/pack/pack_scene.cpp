#include <atomic>
#include <cmath>
#include <utility>

#include "error.h"
#include "pack/features.h"
#include "pack/pack_parts.h"
#include "pose/pose.h"

namespace diptych::core {
namespace {

const Camera* rendered_camera(const Scene& scene, const RenderSettings& settings) {
    return scene.cameras.empty() ? nullptr : &scene.cameras[static_cast<std::size_t>(settings.camera)];
}

glm::dvec3 rebase_origin(const Scene& scene, const RenderSettings& settings) {
    const Camera* camera = rendered_camera(scene, settings);
    return camera == nullptr ? glm::dvec3(0) : glm::dvec3(camera->camera_to_world[3]);
}

}  // namespace

void keep_previous(PackedScene& packed) {
    if (!shared::reuses_reservoirs(packed.constants.integrator)) {
        return;
    }
    packed.constants.previous_camera = packed.constants.camera;
    if ((packed.features & shared::FEATURE_MOTION) == 0) {
        return;
    }
    const auto copy = [](const auto& now, std::uint64_t revision, auto& before, std::uint64_t& revision_before) {
        if (MUTANT(PREVIOUS_ARRAYS_STAY, revision == 0 || revision != revision_before, before.empty())) {
            before = now;
            revision_before = revision;
        }
    };
    Revisions& r = packed.revisions;
    copy(packed.instances, r.instances, packed.previous_instances, r.previous_instances);
    copy(packed.emissive_triangles, r.emissive_triangles, packed.previous_emissive_triangles,
         r.previous_emissive_triangles);
    copy(packed.punctual_lights, r.punctual_lights, packed.previous_punctual_lights, r.previous_punctual_lights);
}

std::uint64_t new_revision() {
    static std::atomic<std::uint64_t> last = 0;
    return ++last;
}

void require_indexable(const Scene& scene, std::size_t size, const char* what) {
    if (size >= shared::NONE) {
        throw Error(scene.name + ": " + what + ": " + std::to_string(size) + " are more than 32-bit indices can name");
    }
}

std::uint64_t buffer_bytes(const PackedScene& packed) {
    std::uint64_t bytes = 0;
#define ADD_BYTES(Type, name) bytes += packed.name.size() * sizeof(packed.name[0]);
    SCENE_BUFFERS(ADD_BYTES)
#undef ADD_BYTES
    return bytes;
}

PackedScene pack_scene(const Scene& scene, const RenderSettings& settings) {
    check_atlas(settings);
    PackedScene packed;
    packed.features = needed_features(scene, settings);
    pack_settings(settings, packed.constants);
    packed.origin = rebase_origin(scene, settings);
    packed.moves = moves(scene);
    packed.keeps_previous = settings.moves;
    pack_materials(scene, packed);
    MeshPlan plan = plan_meshes(scene, packed.origin, rendered_camera(scene, settings));
    packed.reach = plan.reach;
    packed.warnings = std::move(plan.warnings);
    pack_meshes(scene, plan, packed);
    pack_instances(scene, plan, packed);
    pack_camera(scene, settings, packed);
    pack_environment(scene, settings, packed);
    pack_lights(scene, settings, packed);
    // A reader of the last vertex may fetch 16 bytes at once, as Embree does.
    packed.positions.emplace_back(0.0F);
#define NAME_CONTENTS(Type, name) packed.revisions.name = new_revision();
    SCENE_BUFFERS(NAME_CONTENTS)
#undef NAME_CONTENTS
    keep_previous(packed);
    return packed;
}

namespace {

void forget_previous(PackedScene& packed) {
    packed.constants.previous_camera = {};
    packed.previous_instances.clear();
    packed.previous_emissive_triangles.clear();
    packed.previous_punctual_lights.clear();
    packed.revisions.previous_instances = new_revision();
    packed.revisions.previous_emissive_triangles = new_revision();
    packed.revisions.previous_punctual_lights = new_revision();
}

/// Clusters where they are wanted, and else none.
void recluster(PackedScene& packed, bool wanted) {
    packed.part_of_light.clear();
    packed.constants.light_cluster_count = 0;
    if (wanted) {
        cluster_lights(packed);
    }
    weigh_clusters(packed);
    packed.revisions.emissive_triangles = new_revision();
    packed.revisions.punctual_lights = new_revision();
    packed.revisions.light_clusters = new_revision();
    packed.revisions.cluster_picks = new_revision();
}

}  // namespace

bool repack_settings(const Scene& scene, const RenderSettings& settings, PackedScene& packed) {
    check_atlas(settings);
    constexpr std::uint32_t of_arrays =
        shared::FEATURE_TEXTURES | shared::FEATURE_NORMAL_MAPS | shared::FEATURE_SECOND_UV;
    const std::uint32_t features = needed_features(scene, settings);
    const bool lays_out_lights = samples_lights(settings.integrator);
    const bool forms_tree = settings.light_sampler == LightSampler::spatial && !packed.tree_was_sought;
    if (((features ^ packed.features) & of_arrays) != 0 || (forms_tree && packed.moves) ||
        lays_out_lights != shared::samples_lights(packed.constants.integrator) ||
        environment_tint(scene.environment) != packed.environment_tint ||
        scene.lights.size() != packed.punctual_lights.size()) {
        return false;
    }
    const bool resampled = shared::resamples_lights(packed.constants.integrator);
    pack_moment(scene, settings, packed);
    packed.features = features;
    packed.keeps_previous = settings.moves;
    pack_settings(settings, packed.constants);
    if (resamples(settings.integrator) != resampled) {
        recluster(packed, resamples(settings.integrator));
    }
    choose_light_sampler(settings.light_sampler, packed);
    forget_previous(packed);
    keep_previous(packed);
    return true;
}

}  // namespace diptych::core
