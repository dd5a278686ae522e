#include "window/view_log.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "error.h"
#include "settings/names.h"
#include "view/shown_names.h"

namespace diptych::core::app {

void ViewLog::Closer::operator()(std::FILE* file) const {
    if (file != stdout) {
        std::fclose(file);
    }
}

ViewLog::ViewLog(const std::string& file) {
    if (file == "-") {
        file_.reset(stdout);
    } else if (!file.empty()) {
        file_.reset(std::fopen(file.c_str(), "w"));
        if (file_ == nullptr) {
            throw Error(fmt::format("--log {}: {}", file, std::strerror(errno)));
        }
    }
}

void ViewLog::write(const char* event, nlohmann::ordered_json details) {
    if (file_ == nullptr) {
        return;
    }
    nlohmann::ordered_json line = {{"event", event}, {"seconds", std::max(now_ - std::max(begin_, 0.0), 0.0)}};
    line.update(details);
    const std::string text = line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    std::fputs(text.c_str(), file_.get());  // an event that cannot be written is dropped
    std::fflush(file_.get());
}

void ViewLog::follow(const InterfaceFacts& facts, const ViewState& state, const InterfaceState& interface, double now) {
    if (file_ == nullptr) {
        return;
    }
    begin_ = begin_ < 0 ? now : begin_;
    now_ = now;
    const auto note = [&](const char* event, std::string& kept, const char* name) {
        if (kept != name) {
            kept = name;
            write(event, {{"name", kept}});
        }
    };
    note("panel", panel_, name_of(state.shown.panel));
    note("layer", layer_, name_of(state.shown.layer));
    const RenderSettings& settings = state.rendered.request.settings;
    note("integrator", integrator_, core::name_of(settings.integrator));
    if (width_ != settings.width || height_ != settings.height) {
        width_ = settings.width;
        height_ = settings.height;
        write("resized", {{"width", width_}, {"height", height_}});
    }
    for (const auto& [name, at] : interface.places) {
        ImVec2& known = placed_[name];
        if (known.x != at.x || known.y != at.y) {
            known = at;
            write("placed", {{"name", name}, {"x", at.x}, {"y", at.y}});
        }
    }
    for (std::size_t i = 0; i < facts.panels.size(); ++i) {
        if (facts.panels[i].shot == nullptr) {
            continue;
        }
        const PanelShot& shot = *facts.panels[i].shot;
        Seen& seen = seen_[i];
        const nlohmann::ordered_json which = {{"panel", shot.backend},
                                              {"version", shot.version},
                                              {"width", shot.width},
                                              {"height", shot.height},
                                              {"divisor", shot.divisor},
                                              {"spp", shot.spp},
                                              {"integrator", core::name_of(shot.state.request.settings.integrator)},
                                              {"scene", shot.state.scene}};
        if (shot.version != seen.version || shot.divisor != seen.divisor) {
            seen = {shot.version, 0, shot.divisor};
            write("applied", which);
        }
        if (shot.spp >= 2 * seen.spp && shot.spp > 0) {
            seen.spp = shot.spp;
            write("spp", which);
        }
    }
}

}  // namespace diptych::core::app
