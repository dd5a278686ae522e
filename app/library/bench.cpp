#include "diptych/bench.h"

#include <fmt/format.h>

#include <algorithm>

#include "library/impl.h"
#include "measure/bench_table.h"

DIPTYCH_BEGIN

namespace {

IntegratorBench result_of(const core::IntegratorBench& bench) {
    IntegratorBench out;
    out.integrator = static_cast<Integrator>(bench.integrator);
    out.milliseconds = bench.milliseconds;
    out.samples_per_second = bench.samples_per_second;
    out.rays_per_second = bench.rays_per_second;
    if (bench.bare) {
        out.bare_rays_per_second = bench.bare->rays_per_second;
        out.share_of_bare = bench.bare->share;
    }
    out.cost_relative_to_brdf = bench.cost_relative_to_brdf;
    out.build_seconds = bench.costs.build_seconds;
    out.compile_seconds = bench.costs.compile_seconds;
    for (const core::PassTime& pass : bench.passes) {
        out.passes.push_back({pass.pass, 1000 * pass.seconds});
    }
    out.bytes = bench.costs.bytes;
    return out;
}

core::BenchSettings settings_of(const BenchOptions& options) {
    constexpr int least_frames = 5, most_frames = 10000;
    constexpr std::uint32_t most_spp = 65536;
    if (options.backend.backend == Backend::oracle) {
        throw SettingError("bench: backend oracle is not measured, but cpu and vulkan are");
    }
    if (options.integrators.empty()) {
        throw SettingError("bench: there are no integrators");
    }
    if (options.spp < 1 || options.spp > most_spp || options.frames < least_frames || options.frames > most_frames) {
        throw SettingError(fmt::format("bench: spp is {} and frames {}; they have to be 1 to {} and {} to {}",
                                       options.spp, options.frames, most_spp, least_frames, most_frames));
    }
    core::BenchSettings settings;
    for (const Integrator integrator : options.integrators) {
        settings.integrators.push_back(static_cast<core::Integrator>(integrator));
    }
    settings.spp = options.spp;
    settings.frames = options.frames;
    return settings;
}

}  // namespace

BenchResult bench(const Scene& scene, const BenchOptions& options) {
    return guarded([&] {
        const std::shared_ptr<const core::Scene> content = Impl::data(scene).snapshot();
        check(options.settings, content->cameras.size());
        check(options.backend);
        const core::BenchSettings settings = settings_of(options);
        core::RenderRequest request =
            measured_request(*content, options.settings, options.backend.device, options.backend.threads);
        request.backend = core_name(options.backend.backend);
        request.validation = options.backend.validation;
        const StopFlag stop(options.stop);
        const StepCount steps(options.progress, core::bench_steps(settings));
        const std::optional<core::BenchResult> found =
            core::bench_integrators(settings, *content, request, open_measured, stop.flag(), steps.hook());
        if (!found) {
            throw Interrupted("bench: stopped before every integrator had a frame");
        }
        BenchResult result{found->backend, found->device, found->frames, {}, {}};
        for (const core::IntegratorBench& integrator : found->integrators) {
            result.integrators.push_back(result_of(integrator));
        }
        result.text = core::bench_table(*found, request.settings.width, request.settings.height);
        return result;
    });
}

DIPTYCH_END
