// All of a frame but window and widgets: the state, the panels at work on it, the scene that they show.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "view/loader.h"
#include "view/panel_worker.h"
#include "view/verification_light.h"
#include "view/view_state.h"

namespace diptych::core::app {

enum class Panel { cpu, vulkan };

/// How the panels are made; a factory that is empty leaves its panel out.
struct FrameLoopOptions {
    RendererFactory cpu;
    RendererFactory vulkan;
};

class FrameLoop {
public:
    /// The state begins as the request of the scene has it, at its film size.
    FrameLoop(const FrameLoopOptions& options, LoadedScene scene);

    ViewState& state() { return state_; }
    const LoadedScene& scene() const { return scene_; }

    /// Once a frame, `now` in seconds of a steady clock: plays the animation, takes over a scene that has loaded, posts
    /// the state to the panels that are shown where it changed. A panel that is not shown rests.
    void step(double now);

    /// Loads another file, or a panorama as light of the present one, whose camera stays. The present scene stays until
    /// then, and where that fails.
    void open_scene(const std::string& path);
    void open_environment(const std::string& path);

    /// Back to the camera of the scene with that index, where its animation has it now, as the file has it.
    void show_camera(int index);

    bool has(Panel panel) const { return worker(panel) != nullptr; }
    bool shows(Panel panel) const;
    PanelWorker* worker(Panel panel) const { return workers_[static_cast<std::size_t>(panel)].get(); }
    /// Null where the panel is left out.
    std::shared_ptr<const PanelShot> shot(Panel panel) const;

    const VerificationLight& light() const { return light_; }
    const ErrorHistory& history(Panel panel) const { return histories_[static_cast<std::size_t>(panel)]; }

    /// The newest version posted, and whether it asks for previews.
    std::uint64_t version() const { return version_; }
    bool moving() const { return moving_; }

    /// Errors met since the last call, one line each: scenes that did not load, panels that stand still.
    std::vector<std::string> take_errors();

    /// File that is being loaded; empty when idle.
    std::string loading() const { return loader_.loading(); }

    /// The command that renders this picture to the file that `output` names, with as many samples as the panel has.
    std::string repeat_command(Panel panel, const std::string& output) const;

private:
    /// What, beside the state, a job says; of the latest.
    struct Posting {
        bool moving = false;
        bool paused = false;
        bool keeps_hidden = false;
        ShownPanel shown = ShownPanel::cpu;
        double frames_per_second = 0;

        bool operator==(const Posting&) const = default;
    };

    template <class Work>
    void guarded(const Work& work);
    void adopt(LoadedScene scene);
    void place_seen();
    void play(double seconds);
    void post(double now);
    void post_to(Panel panel, bool rests);

    SceneLoader loader_;
    LoadedScene scene_;
    ViewState state_;
    std::array<std::unique_ptr<PanelWorker>, 2> workers_;
    std::array<ErrorHistory, 2> histories_;
    VerificationLight light_;
    std::optional<RenderedState> posted_;
    Posting posting_;
    std::array<bool, 2> resting_ = {true, true};
    std::uint64_t version_ = 0;
    bool moving_ = false;
    double last_step_ = 0;
    double last_single_ = -1e9;  // change that nothing held
    bool in_burst_ = false;
    std::vector<std::string> errors_;
    std::array<std::string, 2> reported_;  // panels' errors
};

}  // namespace diptych::core::app
