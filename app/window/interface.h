// The interface over the picture: reads facts, changes the state, notes wishes. It knows neither window nor device.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "view/loader.h"
#include "view/panel_worker.h"
#include "view/verification_light.h"
#include "view/view_state.h"
#include "window/legend.h"
#include "window/pixel_replay.h"
#include "window/theme.h"

namespace diptych::core::app {

/// What one panel has to tell.
struct PanelFacts {
    const char* title = "";                 // "CPU", "Vulkan"
    ImVec4 color{};                         // that it has wherever both stand side by side
    std::shared_ptr<const PanelShot> shot;  // null where there is no such panel
    const ErrorHistory* history = nullptr;
    bool shown = false;
};

/// What a frame's interface is drawn from.
struct InterfaceFacts {
    const LoadedScene* scene = nullptr;
    std::array<PanelFacts, 2> panels;  // CPU, Vulkan
    VerificationLight light;
    Legend legend;
    double frames_per_second = 0;  // drawn
    std::string loading;           // file
    double now = 0;                // seconds
};

/// A line that is shown for a while; errors until they are closed.
struct Message {
    std::string text;
    bool error = false;
    double until = 0;
};

/// What the user has asked of the window.
struct Wishes {
    bool screenshot = false;  // PNG of the picture
    bool save_exr = false;
    bool copy_command = false;
    bool reset_camera = false;
    bool focus = false;  // on what is under the pointer
    bool quit = false;
    std::optional<int> camera;                   // of the scene
    std::optional<std::uint32_t> replay_sample;  // another of the pixel that is replayed
};

/// What the interface keeps to itself.
struct InterfaceState {
    bool visible = true;   // Tab
    bool settings = true;  // the panels at the sides
    bool figures = true;
    bool help = false;
    bool replay = false;
    std::vector<Message> messages;
    Wishes wishes;
    std::map<std::string, ImVec2> places;  // where the middles of named controls are, for the log
    bool dividing = false;                 // the split's line is being dragged
};

/// All of it, between ImGui::NewFrame and ImGui::Render.
void draw_interface(const Theme& theme, const InterfaceFacts& facts, ViewState& state, InterfaceState& interface,
                    const PixelReplay& replay);

/// A line for the user; the same line is not shown twice at once.
void show_message(InterfaceState& interface, const std::string& text, bool error, double now);

// Its parts, each of which may be left out.
void draw_top_bar(const Theme& theme, const InterfaceFacts& facts, ViewState& state, InterfaceState& interface);
void draw_settings(const Theme& theme, const InterfaceFacts& facts, ViewState& state, InterfaceState& interface);
void draw_resampling(const Theme& theme, ResamplingSettings& resampling, bool reuses);
void draw_figures(const Theme& theme, const InterfaceFacts& facts, const ViewState& state);
void draw_error_plot(const Theme& theme, const InterfaceFacts& facts);
void draw_animation_bar(const Theme& theme, ViewState& state, const InterfaceState& interface);
void draw_replay(const Theme& theme, const PixelReplay& replay, InterfaceState& interface);
void draw_messages(const Theme& theme, const InterfaceFacts& facts, InterfaceState& interface);
void draw_help(const Theme& theme, InterfaceState& interface);
void draw_legend(const Theme& theme, const Legend& legend, const ViewState& state, const InterfaceState& interface);
void draw_divider(const Theme& theme, ViewState& state, InterfaceState& interface);

/// Whether samples are taken of both panels at once: split or difference.
bool shows_both(const ShownState& shown);

}  // namespace diptych::core::app
