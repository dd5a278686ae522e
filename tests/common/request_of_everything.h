// A request in which every setting differs from its default.
#pragma once

#include "render/request.h"

namespace diptych::core::tests {

inline RenderRequest request_of_everything() {
    RenderRequest request;
    request.scene = "a scene's.gltf";
    request.ignored_extensions = {"EXT_one", "EXT_two"};
    request.allow_external = true;
    request.memory_limit = std::uint64_t{1} << 40;
    request.clip = "slow walk";
    request.output = "out.exr";
    request.backend = "vulkan";
    request.device = "1";
    request.camera = "Front view";
    request.environment = "0.1,0.2,0.3";
    request.tonemap = "aces";
    request.environment_scale = 0.1;
    request.environment_rotation = -30;
    request.lens.radius = 0.01;
    request.lens.focus_distance = 2.5;
    request.viewpoint.eye = glm::dvec3(1, -2.5, 3e-7);
    request.viewpoint.look_at = glm::dvec3(0, 0.1, 0);
    request.viewpoint.up = glm::dvec3(0, 0, 1);
    request.viewpoint.fov = 33.5;
    request.viewpoint.view_height = 4;
    request.sun = Sun{-20, 35.5, 3};
    request.exposure = -1.5;
    request.settings.width = 640;
    request.settings.height = 480;
    request.settings.integrator = Integrator::direct;
    request.settings.brdf = BrdfModel::blinn_phong;
    request.settings.sampler = SamplerKind::hammersley;
    request.settings.sample_count = 256;
    request.settings.mis = MisHeuristic::balance;
    request.settings.light_sampler = LightSampler::uniform;
    request.settings.seed = 4294967295U;
    request.settings.generic = true;
    return request;
}

}  // namespace diptych::core::tests
