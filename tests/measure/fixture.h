// A scene, and the CPU's sessions, for engines that are handed both.
#pragma once

#include "backend/cpu_renderer.h"
#include "generate/generate.h"
#include "measure/open_session.h"

namespace diptych::core::measure_tests {

inline Scene cornell() {
    return generate_scene("cornell").scene;
}

inline RenderRequest small_request() {
    RenderRequest request;
    request.settings.width = request.settings.height = 16;
    return request;
}

inline Session open_on_cpu(const Scene& scene, const RenderRequest& request, bool plays) {
    CHECK_FALSE(plays);
    return Session(scene, request.settings, [](const Scene&, const PackedScene& packed, const RenderSettings&) {
        return make_cpu_renderer(packed, 1);
    });
}

}  // namespace diptych::core::measure_tests
