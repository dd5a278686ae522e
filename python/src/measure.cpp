// The comparisons. Results are dicts, which the package's dataclasses are made of.
#include "interruptible.h"

namespace diptych::python {

namespace {

py::dict verified(const Scene& scene, const VerifyOptions& wanted, const py::object& progress) {
    StoppableCall call(progress);
    VerifyOptions options = wanted;
    options.stop = call.token();
    options.progress = [&](std::uint32_t run, std::uint32_t runs) { call.report(run, runs); };
    Verdict verdict = call.run([&] { return verify(scene, options); });
    py::dict members;
    const char* const names[] = {"PASS", "FAIL", "INCONCLUSIVE"};
    members["verdict"] = names[static_cast<int>(verdict.verdict)];
    members["reason"] = verdict.reason;
    members["bias_percent"] = verdict.bias_percent;
    members["ci95"] = verdict.ci95;
    members["p"] = verdict.p;
    members["min_detectable_percent"] = verdict.min_detectable_percent;
    members["p_values"] = array_of(std::move(verdict.p_values), {verdict.tiles_y, verdict.tiles_x});
    return members;
}

Side side_of(const std::string& text) {
    const std::size_t colon = text.find(':');
    Side side{backend_from(text.substr(0, colon))};
    if (colon != std::string::npos) {
        side.integrator = integrator_from(text.substr(colon + 1));
    }
    return side;
}

py::dict to_dict(const Comparison& comparison) {
    py::dict members;
    members["mse"] = comparison.mse;
    members["relmse"] = comparison.relmse;
    members["mean_ratio"] = py::tuple(py::cast(comparison.mean_ratio));
    members["z"] = py::tuple(py::cast(comparison.z));
    members["fraction_equal"] = comparison.fraction_equal;
    members["nonfinite"] = comparison.nonfinite;
    return members;
}

}  // namespace

void bind_measure(py::module_& module) {
    module.def("verify",
               [](const Scene& scene, const std::string& a, const std::string& b, std::uint32_t runs, std::uint32_t spp,
                  const Settings& settings, double alpha, double max_half_width, double max_tile_half_width, int tile,
                  const std::string& device, int threads, const py::object& progress) {
                   VerifyOptions options;
                   options.a = side_of(a);
                   options.b = side_of(b);
                   options.runs = runs;
                   options.spp = spp;
                   options.settings = settings;
                   options.alpha = alpha;
                   options.max_half_width = max_half_width;
                   options.max_tile_half_width = max_tile_half_width;
                   options.tile = tile;
                   options.device = device;
                   options.threads = threads;
                   return verified(scene, options, progress);
               });
    module.def("compare", [](const Film& a, const Film& b) { return to_dict(compare(a, b)); });
    module.def("compare", [](const std::string& a, const std::string& b) { return to_dict(compare(a, b)); });
}

}  // namespace diptych::python
