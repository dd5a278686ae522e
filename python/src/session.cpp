// Sessions. The interpreter's lock is free while one renders, and Ctrl-C ends a render.
#include <memory>

#include "elements.h"

namespace diptych::python {

namespace {

constexpr const char* session_doc =
    "A scene on one backend. diptych.Session is this class with keywords for the settings.";

/// What a render reports to, and how it ends early. Called on the thread that renders.
class Reporter {
public:
    explicit Reporter(py::object callback) : callback_(std::move(callback)) {}

    std::stop_token token() const { return stop_.get_token(); }

    void operator()(const Progress& progress) {
        const py::gil_scoped_acquire locked;
        if (raised_) {
            return;
        }
        try {
            if (PyErr_CheckSignals() != 0) {
                throw py::error_already_set();
            }
            if (!callback_.is_none()) {
                callback_(progress);
            }
        } catch (py::error_already_set& error) {
            raised_ = std::make_unique<py::error_already_set>(std::move(error));
            stop_.request_stop();
        }
    }

    /// Raises what a signal's handler or the callback raised. The lock is held.
    void raise_if_any() {
        if (raised_) {
            const std::unique_ptr<py::error_already_set> raised = std::move(raised_);
            raised->restore();
            throw py::error_already_set();
        }
    }

private:
    py::object callback_;
    std::stop_source stop_;
    std::unique_ptr<py::error_already_set> raised_;
};

class BoundSession {
public:
    BoundSession(const Scene& scene, const BackendChoice& backend, const Settings& settings) {
        SessionOptions options{[warnings = warnings_](const std::string& line) { warnings->push_back(line); }};
        {
            const py::gil_scoped_release others_run;
            session_ = std::make_unique<Session>(scene, backend, settings, options);
        }
        issue_warnings();
    }

    /// Calls the function on the session, with the interpreter's lock free. The session is this call's alone meanwhile.
    template <typename Function>
    auto work(Function function) {
        const Use use(*this);
        const auto result = [&] {
            const py::gil_scoped_release others_run;
            return function(*session_);
        }();
        issue_warnings();
        return result;
    }

    RenderResult render(std::uint32_t count, std::optional<std::uint32_t> first, const py::object& progress, double seconds,
                        double relmse) {
        if (count == 0 && !(seconds > 0) && !(relmse > 0)) {
            throw SettingError("count: 0 is no limit, and needs seconds or relmse");
        }
        Reporter reporter(progress);
        const RenderOptions options{std::ref(reporter), reporter.token(), seconds, relmse};
        const RenderResult result = work([&](Session& session) {
            return first ? session.render(*first, count, options) : session.render(count, options);
        });
        reporter.raise_if_any();
        if (PyErr_CheckSignals() != 0) {  // Ctrl-C after the last report
            throw py::error_already_set();
        }
        return result;
    }

    void close() {
        if (session_) {
            const Use use(*this);
            const py::gil_scoped_release others_run;
            session_.reset();
        }
    }

    const Session& idle() {
        const Use use(*this);
        return *session_;
    }

    friend void use_both(BoundSession& a, BoundSession& b, const std::function<void(Session&, Session&)>& function);

private:
    /// Entered and left with the interpreter's lock held, which makes a plain flag safe.
    struct Use {
        explicit Use(BoundSession& of) : session(of) {
            if (!of.session_) {
                throw Error("the session is closed");
            }
            if (of.used_) {
                throw Error("the session is in use: it renders in another thread, or this is its own progress callback");
            }
            of.used_ = true;
        }
        Use(const Use&) = delete;
        ~Use() { session.used_ = false; }
        BoundSession& session;
    };

    void issue_warnings() {
        const std::vector<std::string> lines = std::exchange(*warnings_, {});
        warn(lines, 2);  // the caller of diptych.Session, which calls this
    }

    std::shared_ptr<std::vector<std::string>> warnings_ = std::make_shared<std::vector<std::string>>();
    std::unique_ptr<Session> session_;
    bool used_ = false;
};

void use_both(BoundSession& a, BoundSession& b, const std::function<void(Session&, Session&)>& function) {
    const BoundSession::Use first(a);
    const BoundSession::Use second(b);
    const py::gil_scoped_release others_run;
    function(*a.session_, *b.session_);
}

py::dict replayed(BoundSession& a, BoundSession& b, std::array<int, 2> pixel, std::uint32_t sample, double tolerance) {
    ReplayResult result;
    use_both(a, b, [&](Session& first, Session& second) { result = replay(first, second, {pixel, sample, tolerance}); });
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
        .def_readonly("settings_change", &Capabilities::settings_change, "set_settings keeps what the settings do not touch.")
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
        .def("__repr__", [](const RenderResult& result) { return "RenderResult(spp=" + std::to_string(result.spp) + ")"; });
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
        .def("film", [](S& self) { return self.work([](Session& session) { return session.film(); }); },
             "A copy of what has been rendered.")
        .def(
            "restart",
            [](S& self, std::optional<std::uint32_t> seed) {
                self.work([seed](Session& session) { return session.restart(seed), 0; });
            },
            py::arg("seed") = py::none(), "Empties the film, with another seed where one is given.")
        .def(
            "pose", [](S& self, double seconds) { self.work([=](Session& session) { return session.pose(seconds), 0; }); },
            py::arg("seconds"),
            "Puts the scene at a moment of its animations and begins another picture. Only what moves is updated, and\n"
            "restir goes on from the picture before.")
        .def(
            "set_camera",
            [](S& self, const Element<Camera>& camera) {
                self.work([value = Camera(camera.get())](Session& session) { return session.set_camera(value), 0; });
            },
            py::arg("camera"), "What the scene is seen through from now on; begins another picture.")
        .def(
            "set_settings",
            [](S& self, const Settings& settings) {
                self.work([settings](Session& session) { return session.set_settings(settings), 0; });
            },
            py::arg("settings"))
        .def_property_readonly("settings", [](S& self) { return self.idle().settings(); })
        .def_property_readonly("backend", [](S& self) { return name_of(self.idle().backend()); })
        .def_property_readonly("device", [](S& self) { return self.idle().device(); }, "The device's own name.")
        .def_property_readonly("capabilities", [](S& self) { return self.idle().capabilities(); })
        .def("close", &S::close, "Frees the backend. Films taken before stay.");
    module.def("replay", &replayed);
}

}  // namespace diptych::python
