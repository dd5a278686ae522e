// The estimated error as it falls: both axes in decades, so that 1/N is a straight line.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "window/interface.h"
#include "window/widgets.h"

namespace diptych::core::app {

namespace {

struct Axis {
    double lo = 0;  // decades
    double hi = 1;

    float place(double value) const { return static_cast<float>((std::log10(value) - lo) / (hi - lo)); }
};

/// Whole decades around what there is to show.
struct Axes {
    Axis spp;
    Axis error;
    bool empty = true;
};

Axes axes_of(const InterfaceFacts& facts) {
    double spp = 10;
    double least = 1e300;
    double most = 0;
    for (const PanelFacts& panel : facts.panels) {
        if (!panel.shown || panel.history == nullptr) {
            continue;
        }
        for (const ErrorPoint& point : panel.history->points()) {
            if (point.relmse > 0 && point.spp > 0) {
                spp = std::max(spp, static_cast<double>(point.spp));
                least = std::min(least, point.relmse);
                most = std::max(most, point.relmse);
            }
        }
    }
    Axes axes;
    axes.empty = most == 0;
    if (!axes.empty) {
        axes.spp = {0, std::ceil(std::log10(spp) - 1e-9)};
        axes.error = {std::floor(std::log10(least)), std::ceil(std::log10(most))};
        axes.error.hi = std::max(axes.error.hi, axes.error.lo + 1);
    }
    return axes;
}

std::string decade_text(int decade) {
    return decade >= 0 && decade < 4 ? fmt::format("{:.0f}", std::pow(10.0, decade)) : fmt::format("1e{}", decade);
}

void draw_grid(const Theme& theme, const Axes& axes, ImVec2 at, ImVec2 size) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImU32 line = packed(colors::line);
    const ImU32 text = packed(colors::muted);
    const float small = theme.small->FontSize * ImGui::GetIO().FontGlobalScale;
    const int every = axes.error.hi - axes.error.lo > 4 ? 2 : 1;
    for (int decade = static_cast<int>(axes.error.lo); decade <= static_cast<int>(axes.error.hi); ++decade) {
        const float y = at.y + size.y * (1 - axes.error.place(std::pow(10.0, decade)));
        draw.AddLine({at.x, y}, {at.x + size.x, y}, line);
        const std::string label = decade_text(decade);
        if ((decade - static_cast<int>(axes.error.lo)) % every == 0) {
            const float width = theme.small->CalcTextSizeA(small, 1e9F, 0, label.c_str()).x;
            draw.AddText(theme.small, small, {at.x - width - theme.units(1.5F), y - small / 2}, text, label.c_str());
        }
    }
    for (int decade = static_cast<int>(axes.spp.lo); decade <= static_cast<int>(axes.spp.hi); ++decade) {
        const float x = at.x + size.x * axes.spp.place(std::pow(10.0, decade));
        draw.AddLine({x, at.y}, {x, at.y + size.y}, line);
        const std::string label = decade_text(decade);
        const float width = theme.small->CalcTextSizeA(small, 1e9F, 0, label.c_str()).x;
        draw.AddText(theme.small, small,
                     {std::min(x - width / 2, at.x + size.x - width), at.y + size.y + theme.units(1)}, text,
                     label.c_str());
    }
}

void draw_curve(const Theme& theme, const Axes& axes, const ErrorHistory& history, const ImVec4& color, ImVec2 at,
                ImVec2 size) {
    std::vector<ImVec2> line;
    for (const ErrorPoint& point : history.points()) {
        if (point.relmse > 0 && point.spp > 0) {
            line.push_back(
                {at.x + size.x * axes.spp.place(point.spp), at.y + size.y * (1 - axes.error.place(point.relmse))});
        }
    }
    if (line.empty()) {
        return;
    }
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddPolyline(line.data(), static_cast<int>(line.size()), packed(color), 0, 1.5F * theme.scale);
    draw.AddCircleFilled(line.back(), 2.5F * theme.scale, packed(color));
}

}  // namespace

void draw_error_plot(const Theme& theme, const InterfaceFacts& facts) {
    const float left = theme.units(9);
    const float below = theme.units(5);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const ImVec2 size{width - left - theme.units(1), theme.units(24)};
    const ImVec2 at{corner.x + left, corner.y + theme.units(2)};
    const Axes axes = axes_of(facts);
    ImGui::Dummy({width, size.y + below + theme.units(2)});
    explain("Estimated relMSE over samples per pixel, from the spread of each pixel's samples. There is none for "
            "correlated frames of restir.");
    if (axes.empty) {
        const bool chained = std::any_of(facts.panels.begin(), facts.panels.end(), [](const PanelFacts& panel) {
            return panel.shown && panel.shot != nullptr && panel.shot->correlated;
        });
        const char* text = chained ? "none for correlated frames of restir" : "not known yet";
        const ImVec2 room = ImGui::CalcTextSize(text);
        ImGui::GetWindowDrawList()->AddText({corner.x + (width - room.x) / 2, corner.y + size.y / 2},
                                            packed(colors::muted), text);
        return;
    }
    draw_grid(theme, axes, at, size);
    for (const PanelFacts& panel : facts.panels) {
        if (panel.shown && panel.history != nullptr) {
            draw_curve(theme, axes, *panel.history, panel.color, at, size);
        }
    }
}

}  // namespace diptych::core::app
