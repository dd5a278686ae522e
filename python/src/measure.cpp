// The comparisons. Results are dicts, which the package's dataclasses are made of.
#include <future>

#include "bindings.h"

namespace diptych::python {

namespace {

/// Runs the function on a thread of its own, while this one, which is Python's, looks for Ctrl-C. The function gets a
/// token that Ctrl-C stops.
template <typename Function>
auto interruptible(std::stop_source& stop, Function function) {
    auto result = std::async(std::launch::async, std::move(function));
    bool interrupted = false;
    const auto finished = [&] {
        const py::gil_scoped_release others_run;
        return result.wait_for(std::chrono::milliseconds(100)) == std::future_status::ready;
    };
    while (!finished()) {
        if (!interrupted && PyErr_CheckSignals() != 0) {
            interrupted = true;
            stop.request_stop();
        }
    }
    if (!interrupted) {
        return result.get();
    }
    const py::error_already_set raised;  // takes the pending exception; the work's own end is no news
    throw raised;
}

py::dict verified(const Scene& scene, const VerifyOptions& wanted, const py::object& progress) {
    VerifyOptions options = wanted;
    std::stop_source stop;
    std::unique_ptr<py::error_already_set> raised;
    options.stop = stop.get_token();
    if (!progress.is_none()) {
        options.progress = [&](std::uint32_t run, std::uint32_t runs) {
            const py::gil_scoped_acquire locked;
            try {
                progress(run, runs);
            } catch (py::error_already_set& error) {
                raised = std::make_unique<py::error_already_set>(std::move(error));
                stop.request_stop();
            }
        };
    }
    const auto raise_if_any = [&] {
        if (raised) {
            raised->restore();
            raised.reset();
            throw py::error_already_set();
        }
    };
    Verdict verdict;
    try {
        verdict = interruptible(stop, [&] { return verify(scene, options); });
    } catch (const Interrupted&) {
        raise_if_any();
        throw;
    }
    raise_if_any();
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
    Side side{backend_named(text.substr(0, colon))};
    if (colon != std::string::npos) {
        try {
            side.integrator = integrator_from(text.substr(colon + 1));
        } catch (const Error& error) {
            throw SettingError(error.what());
        }
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
