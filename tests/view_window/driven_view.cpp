#include "driven_view.h"

#include <chrono>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace diptych::core::tests {

namespace {

constexpr double patience = 60;  // seconds, for one event

std::vector<std::string> arguments(const std::string& scene, const std::string& log, const std::string& shots,
                                   const std::vector<std::string>& more) {
    std::vector<std::string> all = {"view", scene, "--size", "640x400", "--log", log, "--shots", shots};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

std::vector<std::string> environment_on(const VirtualDisplay& display, const std::vector<std::string>& more) {
    // GLFW 3.4 would prefer a Wayland desktop to the virtual display.
    std::vector<std::string> all = {"DISPLAY=" + display.name(), "WAYLAND_DISPLAY=", "XDG_RUNTIME_DIR="};
    const std::vector<std::string> validation = validation_environment();
    all.insert(all.end(), validation.begin(), validation.end());
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

}  // namespace

DrivenView::DrivenView(const VirtualDisplay& display, const TemporaryFolder& folder, const std::string& scene,
                       const std::vector<std::string>& more, const std::vector<std::string>& environment)
    : display_(display), log_(folder.file("log")),
      process_(folder, arguments(scene, log_, folder.path().string(), more), environment_on(display, environment)) {
    await("opened");
    const std::string found = display.hand({"search", "--name", "diptych"});
    window_ = found.empty() ? 0 : std::stoul(found.substr(0, found.find('\n')));
    // Without a window manager keys go where the input focus was put.
    display.hand({"windowfocus", "--sync", std::to_string(window_)});
}

std::vector<Event> DrivenView::events() const {
    std::vector<Event> all;
    std::istringstream text(file_text(log_));
    for (std::string line; std::getline(text, line);) {
        const Event event = Event::parse(line, nullptr, false);
        if (!event.is_discarded()) {  // the last line may be half written
            all.push_back(event);
        }
    }
    return all;
}

void DrivenView::give_up(const std::string& what) {
    process_.send(9);
    throw std::runtime_error(what + "\nlog:\n" + file_text(log_) + "\nstderr:\n" + process_.finish().err);
}

Event DrivenView::await(const std::string& name, const std::function<bool(const Event&)>& fits) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience);
    while (std::chrono::steady_clock::now() < deadline) {
        const std::vector<Event> all = events();
        for (std::size_t i = passed_; i < all.size(); ++i) {
            if (all[i]["event"] == name && (!fits || fits(all[i]))) {
                passed_ = i + 1;
                return all[i];
            }
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    give_up("no event '" + name + "' came");
}

Event DrivenView::latest(const std::string& name, const std::function<bool(const Event&)>& fits) {
    Event found;
    for (const Event& event : events()) {
        if (event["event"] == name && (!fits || fits(event))) {
            found = event;
        }
    }
    return found;
}

Event DrivenView::last(const std::string& name, const std::function<bool(const Event&)>& fits) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience);
    while (std::chrono::steady_clock::now() < deadline) {
        const Event seen = latest(name, fits);
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
        if (!seen.is_null() && seen == latest(name, fits)) {
            return seen;
        }
    }
    give_up("events '" + name + "' did not come, or did not end");
}

Event DrivenView::placed(const std::string& control) {
    return last("placed", [&](const Event& event) { return event["name"] == control; });
}

void DrivenView::key(const std::string& name) const {
    display_.hand({"key", name});
}

void DrivenView::click(const Event& placed) const {
    const auto at = [&](const char* axis) { return std::to_string(static_cast<int>(placed[axis].get<double>())); };
    display_.hand(
        {"mousemove", "--sync", at("x"), at("y"), "sleep", "0.2", "mousedown", "1", "sleep", "0.2", "mouseup", "1"});
}

void DrivenView::drag(int button, int x, int y, int dx, int dy) const {
    const std::string which = std::to_string(button);
    std::vector<std::string> words = {"mousemove", "--sync", std::to_string(x), std::to_string(y),
                                      "sleep",     "0.2",    "mousedown",       which};
    constexpr int steps = 4;
    for (int i = 1; i <= steps; ++i) {
        for (const std::string& word :
             {std::string("mousemove"), std::to_string(x + dx * i / steps), std::to_string(y + dy * i / steps),
              std::string("sleep"), std::string("0.15")}) {
            words.push_back(word);
        }
    }
    words.insert(words.end(), {"mouseup", which});
    display_.hand(words);
}

ProcessResult DrivenView::quit() {
    key("ctrl+q");
    await("quit");
    return process_.finish();
}

}  // namespace diptych::core::tests
