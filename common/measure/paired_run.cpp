#include "measure/paired_run.h"

#include <algorithm>

namespace diptych::core {

namespace {

constexpr std::size_t paths_at_a_time = std::size_t{1} << 18U;

/// Walks all samples of all pixels, `spp` of one pixel after another.
std::vector<shared::PathQuery> list_paths(std::uint64_t first, std::size_t count, std::uint32_t width,
                                          std::uint32_t spp) {
    std::vector<shared::PathQuery> queries(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t index = first + i;
        const auto pixel = static_cast<std::uint32_t>(index / spp);
        queries[i] = {{pixel % width, pixel / width}, static_cast<std::uint32_t>(index % spp)};
    }
    return queries;
}

}  // namespace

PairedRun compare_all_paths(Session& a, Session& b, std::uint32_t spp, const std::atomic<bool>& cancel) {
    const RenderSettings& settings = a.settings();
    PairedRun run;
    run.integrator = settings.integrator;
    run.devices = {a.renderer().device(), b.renderer().device()};
    run.differing = make_image(settings.width, settings.height, 1);
    PairedTest test;
    const auto width = static_cast<std::uint32_t>(settings.width);
    const std::uint64_t all =
        static_cast<std::uint64_t>(settings.width) * static_cast<std::uint64_t>(settings.height) * spp;
    for (std::uint64_t first = 0; first < all && !cancel; first += paths_at_a_time) {
        const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(paths_at_a_time, all - first));
        const std::vector<shared::PathQuery> queries = list_paths(first, count, width, spp);
        const std::vector<bool> differs =
            test.add(queries, a.renderer().summarize_paths(queries), b.renderer().summarize_paths(queries));
        for (std::size_t i = 0; i < count; ++i) {
            if (differs[i]) {
                run.differing.at(static_cast<int>(queries[i].pixel.x), static_cast<int>(queries[i].pixel.y), 0) +=
                    1.0F / static_cast<float>(spp);
            }
        }
    }
    run.report = test.report();
    return run;
}

}  // namespace diptych::core
