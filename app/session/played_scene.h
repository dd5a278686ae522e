// A scene and the renderer it plays on: moved from frame to frame of a sequence.
#pragma once

#include <atomic>
#include <memory>

#include "pack/packed_scene.h"
#include "render/request.h"
#include "render/renderer.h"
#include "commands/render/picture.h"
#include "scene/scene.h"

namespace diptych::app {

/// A frame that has been begun: where its samples stand, and what it took to get there.
struct BegunFrame {
    PictureChain chain;
    double pack_seconds = 0;
    double move_seconds = 0;  // of the renderer
};

class PlayedScene {
public:
    /// With request.frames above 0 a copy of the scene plays; else `scene` itself is rendered at rest, and must live as
    /// long. Throws NoDevice and Error.
    PlayedScene(const Scene& scene, const RenderRequest& request);
    PlayedScene(const PlayedScene&) = delete;
    PlayedScene& operator=(const PlayedScene&) = delete;

    Renderer& renderer() { return *renderer_; }
    std::uint32_t features() const { return packed_.features; }

    /// Whether every frame goes on from the one before, as restir's do.
    bool chained() const { return chained_; }

    /// Empties the film and shows frame `frame`, the moment start + frame / fps, to be given request.spp samples. A
    /// chain begins with `seed` at frame 0, and plays all frames in order; other pictures begin with it at any frame.
    BegunFrame begin_frame(std::uint32_t frame, std::uint32_t seed);

    /// Gives a begun frame its samples, as render_picture would.
    void render_frame(const BegunFrame& frame, const std::atomic<bool>& cancel);

private:
    Camera& camera();
    void pose(double seconds);

    RenderRequest request_;
    bool chained_;
    std::unique_ptr<Scene> posed_;  // null at rest
    Camera camera_at_rest_;
    glm::dvec3 pivot_{0};
    PackedScene packed_;
    std::unique_ptr<Renderer> renderer_;
};

}  // namespace diptych::app
