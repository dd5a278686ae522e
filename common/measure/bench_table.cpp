#include "measure/bench_table.h"

#include <fmt/format.h>

#include "settings/names.h"

namespace diptych::core {

std::string bench_table(const BenchResult& result, int width, int height) {
    std::string text = fmt::format("{} at {}x{}, {}\n", result.backend, width, height, result.device);
    text += fmt::format("{:<10} {:>10} {:>12} {:>10} {:>12} {:>10} {:>10}\n", "integrator", "ms/frame", "Msamples/s",
                        "Mray/s", "bare Mray/s", "of bare", "of brdf");
    for (const IntegratorBench& bench : result.integrators) {
        text += fmt::format("{:<10} {:>10.3f} {:>12.3f} {:>10.2f} {:>12} {:>10} {:>10}\n", name_of(bench.integrator),
                            bench.milliseconds, bench.samples_per_second / 1e6, bench.rays_per_second / 1e6,
                            bench.bare ? fmt::format("{:.2f}", bench.bare->rays_per_second / 1e6) : "-",
                            bench.bare ? fmt::format("{:.1f}%", 100 * bench.bare->share) : "-",
                            bench.cost_relative_to_brdf ? fmt::format("{:.2f}x", *bench.cost_relative_to_brdf) : "-");
        for (const PassTime& pass : bench.passes) {
            text += fmt::format("  {:<18} {:>10.3f}\n", pass.pass, 1000 * pass.seconds);
        }
    }
    return text;
}

}  // namespace diptych::core
