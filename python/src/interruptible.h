// Long calls of the library: other threads of Python run meanwhile. Ctrl-C ends such a call, and so does what its
// callback raises.
#pragma once

#include <chrono>
#include <future>
#include <memory>
#include <utility>

#include "bindings.h"

namespace diptych::python {

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

/// A call that may be stopped, and its callback of Python, which any thread may call.
class StoppableCall {
public:
    explicit StoppableCall(py::object callback) : callback_(std::move(callback)) {}

    std::stop_token token() const { return stop_.get_token(); }

    template <typename... Arguments>
    void report(Arguments... arguments) {
        const py::gil_scoped_acquire locked;
        if (raised_ || callback_.is_none()) {
            return;
        }
        try {
            callback_(arguments...);
        } catch (py::error_already_set& error) {
            raised_ = std::make_unique<py::error_already_set>(std::move(error));
            stop_.request_stop();
        }
    }

    /// Raises what Ctrl-C or the callback raised, else what the function throws.
    template <typename Function>
    auto run(Function function) {
        try {
            auto result = interruptible(stop_, std::move(function));
            raise_if_any();
            return result;
        } catch (const Interrupted&) {
            raise_if_any();
            throw;
        }
    }

private:
    void raise_if_any() {
        if (raised_) {
            const std::unique_ptr<py::error_already_set> raised = std::move(raised_);
            raised->restore();
            throw py::error_already_set();
        }
    }

    py::object callback_;
    std::stop_source stop_;
    std::unique_ptr<py::error_already_set> raised_;
};

}  // namespace diptych::python
