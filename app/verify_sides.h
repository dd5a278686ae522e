// The renders that `verify` compares: every side renders its runs, each with a seed of its own.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "pack/packed_scene.h"
#include "render/film_tiles.h"
#include "render/renderer.h"
#include "scene/scene.h"
#include "verify_options.h"

namespace diptych::app {

/// Called before each run of a side.
using RunHook = std::function<void(const SideName& side, std::uint32_t run)>;

class VerifySide {
public:
    /// Run k has the seed first_seed + k. `sample_count` is what a Hammersley set is laid out for. Throws NoDevice and
    /// Error.
    VerifySide(const SideName& name, const Scene& scene, const VerifyOptions& options, std::uint32_t first_seed,
               std::uint32_t sample_count);

    /// Adds so many samples a pixel to every run; false, and of no use any more, where `cancel` came in between.
    bool extend(std::uint32_t samples, const std::atomic<bool>& cancel, const RunHook& hook);

    const SideName& name() const { return name_; }
    const std::vector<RunMeans>& runs() const { return runs_; }
    std::uint32_t spp() const { return spp_; }
    std::uint64_t nonfinite() const { return nonfinite_; }  // samples dropped, over all runs
    std::string device() const { return renderer_->device(); }

private:
    SideName name_;
    int tile_;
    std::uint32_t first_seed_;
    std::unique_ptr<PackedScene> packed_;  // outlives the renderer, which may read it
    std::unique_ptr<Renderer> renderer_;
    std::vector<RunMeans> runs_;
    std::uint32_t spp_ = 0;
    std::uint64_t nonfinite_ = 0;
};

}  // namespace diptych::app
