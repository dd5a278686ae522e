// The classes around sessions, and replay.
#include "bound_session.h"
#include "elements.h"

namespace diptych::python {

namespace {

constexpr const char* session_doc =
    "A scene on one backend. diptych.Session is this class with keywords for the settings.";

py::dict replayed(BoundSession& a, BoundSession& b, std::array<int, 2> pixel, std::uint32_t sample, double tolerance) {
    const ReplayResult result = BoundSession::work_on_both(a, b, [&](Session& first, Session& second) {
        return replay(first, second, {pixel, sample, tolerance});
    });
    py::dict members;
    members["radiance"] = py::make_tuple(to_python(result.radiance[0]), to_python(result.radiance[1]));
    members["vertices"] = py::make_tuple(result.vertices[0], result.vertices[1]);  // lists of ReplayVertex
    members["parts_at"] = result.parts_at;
    members["text"] = result.text;
    return members;
}

}  // namespace

void bind_session(py::module_& module) {
    py::class_<Capabilities>(module, "Capabilities", "What a backend can do beside rendering a picture at rest.")
        .def_readonly("temporal_reuse", &Capabilities::temporal_reuse, "restir goes on from moment to moment.")
        .def_readonly("settings_change", &Capabilities::settings_change,
                      "set_settings keeps what the settings do not touch.")
        .def_readonly("replay", &Capabilities::replay, "Paths can be recorded.");
    py::class_<Progress>(module, "Progress", "How far a render is.")
        .def_readonly("spp", &Progress::spp, "Done, of every pixel.")
        .def_readonly("seconds", &Progress::seconds)
        .def_readonly("eta_seconds", &Progress::eta_seconds, "Infinite while unknown.")
        .def_readonly("samples_per_second", &Progress::samples_per_second)
        .def_readonly("rays_per_second", &Progress::rays_per_second)
        .def_readonly("relmse", &Progress::relmse, "An estimate, or None.");
    py::class_<RenderResult>(module, "RenderResult", "What one call of Session.render did.")
        .def_readonly("spp", &RenderResult::spp, "Samples that every pixel was given by this call.")
        .def_readonly("seconds", &RenderResult::seconds)
        .def("__repr__",
             [](const RenderResult& result) { return "RenderResult(spp=" + std::to_string(result.spp) + ")"; });
    py::class_<ReplayVertex>(module, "ReplayVertex", "Where a path met a surface, or left the scene.")
        .def_property_readonly(
            "position", [](const ReplayVertex& vertex) { return to_python(vertex.position); },
            "(x, y, z), metres, world space of the file: where the ray ended.")
        .def_property_readonly(
            "emission", [](const ReplayVertex& vertex) { return to_python(vertex.emission); },
            "(r, g, b) that it adds to the path's radiance, throughput and MIS weight included.")
        .def_property_readonly(
            "throughput", [](const ReplayVertex& vertex) { return to_python(vertex.throughput); },
            "(r, g, b), of what comes after.");
    using S = BoundSession;
    py::class_<S>(module, "Session", session_doc)
        .def(py::init([](const Scene& scene, const std::string& backend, const std::string& device, int threads,
                         bool validation, const Settings& settings) {
            return std::make_unique<S>(scene, choice_of(backend, device, threads, validation), settings);
        }))
        .def("render", &S::render, py::arg("count"), py::arg("first"), py::arg("progress"), py::arg("seconds"),
             py::arg("relmse"))
        .def(
            "film", [](S& self) { return self.work([](Session& session) { return session.film(); }); },
            "A copy of what has been rendered.")
        .def(
            "resume",
            [](S& self, const Film& film) { self.work([&](Session& session) { return session.resume(film), 0; }); },
            py::arg("film"),
            "Goes on from a film of this very picture, rendered or loaded: the session has its samples from then on,\n"
            "and the next ones follow them, to the bits of a session that took them all. Raises Error where the film\n"
            "is of another picture or seed, or has no sums.")
        .def(
            "restart",
            [](S& self, std::optional<std::uint32_t> seed) {
                self.work([seed](Session& session) { return session.restart(seed), 0; });
            },
            py::arg("seed") = py::none(), "Empties the film, with another seed where one is given.")
        .def(
            "pose",
            [](S& self, std::optional<double> seconds) {
                self.work([=](Session& session) { return session.pose(seconds), 0; });
            },
            py::arg("seconds"),
            "Puts the scene at a moment of its animations, or back at rest (None), and begins another picture. Only\n"
            "what moves is updated, and restir goes on from the picture before.")
        .def(
            "set_camera",
            [](S& self, const Element<Camera>* camera) {
                const std::optional<Camera> value = camera == nullptr ? std::nullopt : std::optional(camera->get());
                self.work([value](Session& session) { return session.set_camera(value), 0; });
            },
            py::arg("camera"),
            "What the scene is seen through from now on; None is the camera of the settings. Begins another picture.")
        .def(
            "set_settings",
            [](S& self, const Settings& settings) {
                self.work([settings](Session& session) { return session.set_settings(settings), 0; });
            },
            py::arg("settings"))
        .def_property_readonly("settings", [](S& self) { return self.idle().settings(); })
        .def_property_readonly("backend", [](S& self) { return name_of(self.idle().backend()); })
        .def_property_readonly(
            "device", [](S& self) { return self.idle().device(); }, "The device's own name.")
        .def_property_readonly("capabilities", [](S& self) { return self.idle().capabilities(); })
        .def("close", &S::close, "Frees the backend. Films taken before stay.");
    module.def("replay", &replayed);
}

}  // namespace diptych::python
