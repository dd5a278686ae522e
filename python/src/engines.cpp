// bench and converge. Results are dicts, which the package's dataclasses are made of.
#include "interruptible.h"

namespace diptych::python {

namespace {

py::dict to_dict(const IntegratorBench& bench) {
    py::dict members;
    members["integrator"] = name_of(bench.integrator);
    members["milliseconds"] = bench.milliseconds;
    members["samples_per_second"] = bench.samples_per_second;
    members["rays_per_second"] = bench.rays_per_second;
    members["bare_rays_per_second"] = bench.bare_rays_per_second;
    members["share_of_bare"] = bench.share_of_bare;
    members["cost_relative_to_brdf"] = bench.cost_relative_to_brdf;
    members["build_seconds"] = bench.build_seconds;
    members["compile_seconds"] = bench.compile_seconds;
    py::dict passes;
    for (const PassTime& pass : bench.passes) {
        passes[py::str(pass.pass)] = pass.milliseconds;
    }
    members["passes"] = passes;
    members["bytes"] = bench.bytes;
    return members;
}

py::dict benched(const Scene& scene, const std::vector<std::string>& integrators, std::uint32_t spp, int frames,
                 const std::string& backend, const std::string& device, int threads, const Settings& settings,
                 const py::object& progress) {
    StoppableCall call(progress);
    BenchOptions options;
    options.integrators.clear();
    for (const std::string& name : integrators) {
        options.integrators.push_back(integrator_from(name));
    }
    options.spp = spp;
    options.frames = frames;
    options.backend = choice_of(backend, device, threads, false);
    options.settings = settings;
    options.stop = call.token();
    options.progress = [&](const std::string& step, int done, int steps) { call.report(step, done, steps); };
    const BenchResult result = call.run([&] { return bench(scene, options); });
    py::dict members;
    members["backend"] = result.backend;
    members["device"] = result.device;
    members["frames"] = result.frames;
    py::list rates;
    for (const IntegratorBench& integrator : result.integrators) {
        rates.append(to_dict(integrator));
    }
    members["integrators"] = rates;
    members["text"] = result.text;
    return members;
}

py::tuple to_tuple(const Estimate& estimate) {
    return py::make_tuple(estimate.value, estimate.low, estimate.high);
}

py::dict to_dict(const ConvergeMethod& method) {
    const char* const targets[] = {"reached", "earlier", "later", "unknown"};
    py::dict members;
    members["method"] = method.method;
    members["device"] = method.device;
    members["runs"] = method.runs;
    members["slope_mse"] = to_tuple(method.slope_mse);
    members["slope_relmse"] = to_tuple(method.slope_relmse);
    members["bias_p"] = method.bias_p;
    members["bias_significant"] = method.bias_significant;
    members["bias_text"] = method.bias_text;
    members["target"] = targets[static_cast<int>(method.target)];
    members["target_seconds"] = method.target_seconds;
    return members;
}

py::dict to_dict(const ConvergeResult& result) {
    py::dict members;
    members["scene"] = result.scene;
    members["size"] = py::make_tuple(result.width, result.height);
    py::list methods;
    for (const ConvergeMethod& method : result.methods) {
        methods.append(to_dict(method));
    }
    members["methods"] = methods;
    members["reference"] = result.reference;
    members["reference_spp"] = result.reference_spp;
    members["reference_relmse"] = result.reference_relmse;
    members["target_relmse"] = result.target_relmse;
    py::dict columns;
    columns["method"] = py::module_::import("numpy").attr("array")(result.table.method);
    for (const ConvergeColumn& column : result.table.columns) {
        columns[py::str(column.name)] = array_of(column.values, {static_cast<py::ssize_t>(column.values.size())});
    }
    members["columns"] = columns;
    members["text"] = result.text;
    members["html"] = result.page;
    return members;
}

py::dict converged(const Scene& scene, const std::vector<std::string>& methods, double seconds, std::uint32_t spp_max,
                   std::uint32_t runs, const py::object& reference, double target_relmse, double picture_seconds,
                   const std::string& device, int threads, const Settings& settings, const py::object& progress) {
    StoppableCall call(progress);
    ConvergeOptions options;
    options.methods = methods;
    options.seconds = seconds;
    options.spp_max = spp_max;
    options.runs = runs;
    if (py::isinstance<Film>(reference)) {
        options.reference_film = reference.cast<Film>();
    } else {
        options.reference = path_of(reference);
    }
    options.target_relmse = target_relmse;
    options.picture_seconds = picture_seconds;
    options.device = device;
    options.threads = threads;
    options.settings = settings;
    options.stop = call.token();
    options.progress = [&](const std::string& step, int done, int steps) { call.report(step, done, steps); };
    return to_dict(call.run([&] { return converge(scene, options); }));
}

}  // namespace

void bind_engines(py::module_& module) {
    module.def("bench", &benched);
    module.def("converge", &converged);
}

}  // namespace diptych::python
