#include "verify_sides.h"

#include "backend.h"
#include "pack/packed_scene.h"

namespace diptych::app {

VerifySide::VerifySide(const SideName& name, const Scene& scene, const VerifyOptions& options, std::uint32_t first_seed,
                       std::uint32_t sample_count)
    : name_(name), tile_(options.tile), first_seed_(first_seed), runs_(options.runs) {
    RenderRequest request = options.arguments.request;
    request.backend = name.backend;
    request.settings.integrator = name.integrator;
    request.oracle_mode = name.oracle_mode;
    request.settings.seed = first_seed;
    request.settings.sample_count = sample_count;
    if (name.backend == "vulkan") {
        request.threads = 0;
    } else {
        request.device.clear();
        request.validation = false;
    }
    packed_ = std::make_unique<PackedScene>(pack_scene(scene, request.settings));
    renderer_ = make_renderer(scene, *packed_, request);
}

bool VerifySide::extend(std::uint32_t samples, const std::atomic<bool>& cancel, const RunHook& hook) {
    for (std::uint32_t run = 0; run < runs_.size(); ++run) {
        hook(name_, run);
        renderer_->restart(first_seed_ + run);
        renderer_->render(spp_, samples, cancel);
        if (cancel) {
            return false;
        }
        const Film film = renderer_->film();
        nonfinite_ += film_totals(film).nonfinite;
        const RunMeans means = tile_means(film, tile_);
        runs_[run] = spp_ == 0 ? means : merge_means(runs_[run], spp_, means, samples);
    }
    spp_ += samples;
    return true;
}

}  // namespace diptych::app
