// Settings in Python: immutable, made of keywords that are named as the command line's options.
#include <algorithm>
#include <charconv>
#include <limits>

#include "setting_kinds.h"

namespace diptych::python {

namespace {

const Choices<Integrator> integrators = {{"brdf", Integrator::brdf},
                                         {"direct", Integrator::direct},
                                         {"path", Integrator::path},
                                         {"ris", Integrator::ris},
                                         {"restir", Integrator::restir}};
const Choices<BrdfModel> brdfs = {{"ggx", BrdfModel::ggx}, {"blinn-phong", BrdfModel::blinn_phong}};
const Choices<NormalMaps> normal_maps = {{"shading", NormalMaps::shading}, {"microfacet", NormalMaps::microfacet}};
const Choices<SamplerKind> samplers = {
    {"independent", SamplerKind::independent}, {"hammersley", SamplerKind::hammersley}, {"sobol", SamplerKind::sobol}};
const Choices<MisHeuristic> heuristics = {{"power", MisHeuristic::power}, {"balance", MisHeuristic::balance}};
const Choices<LightSampler> light_samplers = {
    {"uniform", LightSampler::uniform}, {"power", LightSampler::power}, {"spatial", LightSampler::spatial}};
const Choices<ResamplingMis> resampling_mis = {{"pairwise", ResamplingMis::pairwise},
                                               {"balance", ResamplingMis::balance},
                                               {"1-over-z", ResamplingMis::one_over_z},
                                               {"biased-1-over-m", ResamplingMis::biased_one_over_m}};
const Choices<ResamplingVisibility> resampling_visibility = {{"shading", ResamplingVisibility::shading},
                                                             {"target", ResamplingVisibility::target},
                                                             {"biased-initial", ResamplingVisibility::biased_initial},
                                                             {"biased-final", ResamplingVisibility::biased_final}};

Field size() {
    const auto get = [](const Settings& settings) -> py::object {
        return py::make_tuple(settings.size[0], settings.size[1]);
    };
    const auto set = [](Settings& settings, const py::object& value) {
        if (!py::isinstance<py::sequence>(value) || py::len(value) != 2) {
            throw py::type_error("size: wants (width, height)");
        }
        constexpr long long largest_side = 32768;
        constexpr long long largest_area = 1LL << 28;
        const py::sequence sides = value;
        const long long width = integer_of("size", sides[0]);
        const long long height = integer_of("size", sides[1]);
        if (width < 1 || height < 1 || width > largest_side || height > largest_side) {
            refuse("size", value, "is not (width, height), each from 1 to " + std::to_string(largest_side));
        }
        if (width * height > largest_area) {
            refuse("size", value, "has more than " + std::to_string(largest_area) + " pixels");
        }
        settings.size = {static_cast<int>(width), static_cast<int>(height)};
    };
    return {"size", "(width, height) in pixels.", get, set};
}

const std::vector<Field>& fields() {
    using S = Settings;
    using R = ResamplingSettings;
    // Left to the process's end: the ranges are objects of Python, which is gone when statics are destroyed.
    static const auto* all = new std::vector<Field>{
        choice("integrator", &S::integrator, integrators, "brdf, direct, path, ris or restir; the oracle heeds none."),
        size(),
        integer("max_depth", &S::max_depth, 0, 65535, "Scattering events; 1 is emission and direct light."),
        integer("seed", &S::seed, 0, 0xFFFFFFFFLL, "Another seed gives independent noise."),
        integer("camera", &S::camera, 0, std::numeric_limits<int>::max(), "Index into Scene.cameras."),
        choice("sampler", &S::sampler, samplers, "independent, hammersley or sobol."),
        integer(
            "sample_count", &S::sample_count, 1, 0xFFFFFFFFLL,
            "Samples a pixel that a Hammersley set is laid out for; diptych.render takes spp where it is not given."),
        choice("mis", &S::mis, heuristics, "MIS weights of path: power or balance."),
        choice("light_sampler", &S::light_sampler, light_samplers,
               "How path and direct pick a light: uniform, power or spatial."),
        choice("brdf", &S::brdf, brdfs, "Microfacet model: ggx or blinn-phong."),
        choice("normal_maps", &S::normal_maps, normal_maps, "What a normal map does: shading or microfacet."),
        flag("standard_error", &S::standard_error, "Keep second moments, and so Film.standard_error."),
        flag("first_hit", &S::first_hit, "Keep the layers albedo, normal and depth."),
        integer("candidates", &R::light_candidates, 1, 1024, "ris, restir: light candidates per pixel and frame."),
        number("near_share", &R::near_share, 0, 1,
               "ris, restir: fraction of the candidates picked by power and distance."),
        flag("bsdf_candidate", &R::bsdf_candidate, "ris, restir: add a candidate from BSDF sampling."),
        flag("temporal", &R::temporal, "restir: reuse the reservoirs of the previous frame."),
        integer("spatial_passes", &R::spatial_passes, 0, 8, "restir: number of spatial reuse passes."),
        integer("neighbors", &R::neighbors, 1, 8, "restir: neighbours per spatial pass."),
        number("reuse_radius", &R::radius, positive, unlimited,
               "restir: radius in which neighbours are chosen, pixels."),
        number("confidence_cap", &R::confidence_cap, positive, unlimited,
               "restir: cap on the confidence of the previous frame, in frames."),
        choice("reuse_mis", &R::mis, resampling_mis, "restir: pairwise, balance, 1-over-z or biased-1-over-m."),
        choice("reuse_visibility", &R::visibility, resampling_visibility,
               "ris, restir: shading, target, biased-initial or biased-final."),
    };
    return *all;
}

Settings changed(Settings settings, const py::kwargs& changes) {
    for (const auto& [key, value] : changes) {
        const std::string name = text_of(key);
        const auto field =
            std::find_if(fields().begin(), fields().end(), [&](const Field& each) { return name == each.name; });
        if (field == fields().end()) {
            throw py::type_error("there is no setting " + name);
        }
        field->set(settings, py::reinterpret_borrow<py::object>(value));
    }
    return settings;
}

std::string settings_text(const Settings& settings) {
    std::string parts;
    for (const Field& field : fields()) {
        const py::object value = field.get(settings);
        if (!value.equal(field.get(Settings{}))) {
            parts += (parts.empty() ? "" : ", ") + std::string(field.name) + "=" + std::string(py::repr(value));
        }
    }
    return "Settings(" + parts + ")";
}

}  // namespace

double as_written(float value) {
    char text[32];
    const char* end = std::to_chars(text, text + sizeof text, value).ptr;
    double result = 0;
    std::from_chars(text, end, result);
    return result;
}

BackendChoice choice_of(const std::string& backend, const std::string& device, int threads, bool validation) {
    const BackendChoice choice{backend_from(backend), device, threads, validation};
    const bool vulkan = choice.backend == Backend::vulkan;
    if (!vulkan && !device.empty()) {
        throw SettingError("device: goes with backend vulkan");
    }
    if (!vulkan && validation) {
        throw SettingError("validation: goes with backend vulkan");
    }
    if (vulkan && threads != 0) {
        throw SettingError("threads: goes with backend cpu or oracle");
    }
    return choice;
}

void bind_settings(py::module_& module) {
    py::class_<Settings> settings(module, "Settings",
                                  "How a scene is rendered: immutable. Keywords are the command line's options.\n\n"
                                  ">>> import diptych as dp\n"
                                  ">>> dp.Settings(integrator=\"restir\", size=(640, 360)).replace(seed=7)\n"
                                  "Settings(integrator='restir', size=(640, 360), seed=7)\n");
    settings.def(py::init([](const py::kwargs& values) { return changed(Settings{}, values); }));
    settings.def("replace", &changed, "The same settings but for the changes.");
    settings.def("__repr__", &settings_text);
    settings.def(
        "__eq__", [](const Settings& a, const Settings& b) { return a == b; }, py::is_operator());
    settings.attr("__hash__") = py::none();
    py::dict ranges;
    for (const Field& field : fields()) {
        settings.def_property_readonly(field.name, field.get, field.doc);
        if (!field.range.is_none()) {
            ranges[field.name] = field.range;
        }
    }
    settings.attr("ranges") = ranges;
    module.def("devices", &devices, py::call_guard<py::gil_scoped_release>(),
               "The Vulkan devices that can render, best first; empty where there are none.");
}

}  // namespace diptych::python
