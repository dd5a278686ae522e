// `diptych view` in a window of a virtual display, driven by hands and watched by its log.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../app/process.h"
#include "display.h"

namespace diptych::core::tests {

using Event = nlohmann::json;

class DrivenView {
public:
    /// Opens the scene in a window of 640 x 400, under the validation layer where that is installed; `environment`
    /// holds "NAME=VALUE" beside its own.
    DrivenView(const VirtualDisplay& display, const TemporaryFolder& folder, const std::string& scene,
               const std::vector<std::string>& more, const std::vector<std::string>& environment = {});

    /// The first event that `fits` among those that have not been awaited yet; fails the test where none comes. All
    /// before it are passed over.
    Event await(const std::string& name, const std::function<bool(const Event&)>& fits = {});
    /// The latest of all events so far that fits, awaited or not; null where there is none.
    Event latest(const std::string& name, const std::function<bool(const Event&)>& fits = {});
    /// The latest of them once no more come.
    Event last(const std::string& name, const std::function<bool(const Event&)>& fits = {});
    /// Where a control stands, once it stands still.
    Event placed(const std::string& control);

    void key(const std::string& name) const;
    void click(const Event& placed) const;
    void drag(int button, int x, int y, int dx, int dy) const;
    unsigned long window() const { return window_; }

    ProcessResult quit();

private:
    std::vector<Event> events() const;
    [[noreturn]] void give_up(const std::string& what);

    const VirtualDisplay& display_;
    std::string log_;
    Process process_;
    std::size_t passed_ = 0;
    unsigned long window_ = 0;
};

}  // namespace diptych::core::tests
