// Sessions. The interpreter's lock is free while one renders, and Ctrl-C ends a render.
#pragma once

#include <memory>
#include <utility>

#include "bindings.h"

namespace diptych::python {

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

    RenderResult render(std::uint32_t count, std::optional<std::uint32_t> first, const py::object& progress,
                        double seconds, double relmse) {
        if (count == 0 && !(seconds > 0) && !(relmse > 0)) {
            throw SettingError("count: 0 is no limit, and needs seconds or relmse");
        }
        Reporter reporter(progress);
        const RenderOptions options{std::ref(reporter), reporter.token(), seconds, relmse};
        const RenderResult result = work([&](Session& session) {
            return first ? session.render_range(*first, count, options) : session.render(count, options);
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

    /// As work, on two sessions.
    template <typename Function>
    static auto work_on_both(BoundSession& a, BoundSession& b, Function function) {
        const Use first(a);
        const Use second(b);
        const py::gil_scoped_release others_run;
        return function(*a.session_, *b.session_);
    }

private:
    /// Entered and left with the interpreter's lock held, which makes a plain flag safe.
    struct Use {
        explicit Use(BoundSession& of) : session(of) {
            if (!of.session_) {
                throw Error("the session is closed");
            }
            if (of.used_) {
                throw Error(
                    "the session is in use: it renders in another thread, or this is its own progress callback");
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

}  // namespace diptych::python
