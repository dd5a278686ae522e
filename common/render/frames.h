// What a request makes of its scene: the light on it, and the frames of a sequence as moments of it.
#pragma once

#include "render/moment.h"
#include "render/request.h"

namespace diptych::core {

/// The scene at rest under the request's scale and turn of the environment and its sun.
Moment requested_lights(const RenderRequest& request);

class FrameMoments {
public:
    /// By the request's start, rate and orbit. `scene` is at rest.
    FrameMoments(const Scene& scene, const RenderRequest& request);

    /// Frame 0 is that at request.start, kept or not.
    Moment at(std::uint32_t frame) const;

private:
    double start_;
    double fps_;
    double degrees_;  // a frame
    glm::dvec3 pivot_{0};
};

}  // namespace diptych::core
