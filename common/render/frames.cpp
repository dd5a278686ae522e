#include "render/frames.h"

#include "scene/orbit.h"

namespace diptych::core {

Moment requested_lights(const RenderRequest& request) {
    Moment moment;
    moment.environment_scale = request.environment_scale;
    moment.environment_rotation = request.environment_rotation;
    moment.sun = request.sun;
    return moment;
}

FrameMoments::FrameMoments(const Scene& scene, const RenderRequest& request)
    : start_(request.start), fps_(request.fps), degrees_(request.orbit) {
    if (degrees_ != 0) {
        pivot_ = orbit_pivot(scene, scene.cameras[static_cast<std::size_t>(request.settings.camera)]);
    }
}

Moment FrameMoments::at(std::uint32_t frame) const {
    Moment moment;
    moment.seconds = start_ + frame / fps_;
    if (degrees_ != 0) {
        moment.orbit = Orbit{pivot_, degrees_ * fps_ * *moment.seconds};
    }
    return moment;
}

}  // namespace diptych::core
