// A view in its window: what it owns, the loop of its frames, and what hands and controls make of it.
#pragma once

#include <atomic>
#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "view/frame_loop.h"
#include "window/camera_hand.h"
#include "window/film_source.h"
#include "window/imgui_context.h"
#include "window/interface.h"
#include "window/legend.h"
#include "window/picture_saver.h"
#include "window/pixel_replay.h"
#include "window/presenter.h"
#include "window/view_log.h"
#include "window/view_window.h"
#include "window/window.h"

namespace diptych::core::app {

class OpenView {
public:
    OpenView(const WindowOptions& options, LoadedScene scene);

    /// Until the window is closed, or an interrupt comes; true where that was it.
    bool run();

private:
    static std::string title_of(const std::string& scene);
    Panel main_panel() const;
    void open_device();
    void begin_loop(LoadedScene scene);
    void recover();
    void say(const std::string& text);
    void report(const std::string& text);

    double await_frame();
    void fit_film();
    void draw_widgets(double passed);
    void step();
    void draw();
    InterfaceFacts facts() const;

    void read_input(double timeout);
    void take_drops();
    void move_camera(double seconds);
    void grant_wishes();
    void save_picture();
    void save_radiance();
    void take_answers();

    ViewState& state() { return loop_->state(); }

    WindowOptions options_;
    RenderRequest request_;
    ViewLog log_;
    Window window_;
    ImguiContext imgui_;
    std::shared_ptr<Gpu> gpu_;
    std::unique_ptr<Presenter> presenter_;
    std::unique_ptr<FilmSource> films_;
    std::atomic<bool> news_ = true;  // a panel has something new
    std::unique_ptr<FrameLoop> loop_;
    CameraHand hand_;
    InterfaceState interface_;
    PixelReplay replay_;
    std::optional<shared::PathQuery> asked_;  // to be replayed
    Legend legend_;
    WindowInput input_;
    FilmSaver saver_;
    std::future<KeptFilm> focus_film_;  // F was pressed: its depth under the pointer is wanted
    glm::dvec2 focus_point_{0};
    std::set<int> chords_;  // keys last pressed with Ctrl: one that is let go after Ctrl does not fly
    double last_frame_ = 0;
    double frame_seconds_ = 0;  // averaged
    int frames_owed_ = 0;       // at once, after input: what opens takes a frame to be laid out and one to be seen
    bool settings_held_ = false;
    bool opened_ = false;
    std::uint64_t generation_ = 1;  // of the scene that the title names
};

}  // namespace diptych::core::app
