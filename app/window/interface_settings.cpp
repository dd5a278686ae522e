// The panel on the left: how the picture is made and shown.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/gtc/constants.hpp>

#include "scene/default_camera.h"
#include "view/camera_control.h"
#include "window/interface_layout.h"
#include "window/widgets.h"

namespace diptych::app {

namespace {

void draw_sampling(const Theme& theme, RenderSettings& settings) {
    slider(theme, "Depth", settings.max_depth, 0, 32, "Scattering events at most; 1 is emission and direct light");
    choice(theme, "BRDF", {"GGX", "Blinn-Phong"}, settings.brdf, "Microfacets of metallic-roughness materials");
    choice(theme, "Normal maps", {"shading", "microfacet"}, settings.normal_maps,
           "Shading by the mapped normal, or facets that keep all energy");
    int sampler = settings.sampler == SamplerKind::sobol ? 1 : 0;
    // Not Hammersley's points: they are laid out for a number of samples that is known beforehand.
    const std::array<const char*, 2> samplers = {"independent", "Sobol'"};
    if (choice(theme, "Sampler", samplers, sampler, "Where random numbers come from")) {
        settings.sampler = sampler == 1 ? SamplerKind::sobol : SamplerKind::independent;
    }
    if (settings.integrator == Integrator::path) {
        choice(theme, "MIS", {"power", "balance"}, settings.mis, "Weights between light and material sampling");
    }
}

void draw_light(const Theme& theme, const InterfaceFacts& facts, RenderRequest& request) {
    const bool none = facts.scene == nullptr || facts.scene->scene->environment.kind == EnvironmentKind::none;
    ImGui::BeginDisabled(none);
    logarithmic_slider(theme, "Sky", request.environment_scale, 0, 100, "× %.3g",
                       "Factor on the light from infinity. Drop a .hdr or .exr to replace it");
    slider(theme, "Rotation", request.environment_rotation, -180, 180, "%.0f°", "Turns the sky about the vertical");
    ImGui::EndDisabled();
    bool shines = request.sun.has_value();
    if (toggle(theme, "Sun", shines, "A directional light beside the scene's own")) {
        request.sun = shines ? std::optional<Sun>(Sun{}) : std::nullopt;
    }
    if (request.sun) {
        slider(theme, "Azimuth", request.sun->azimuth, 0, 360, "%.0f°",
               "Clockwise from above, from the middle of the sky");
        slider(theme, "Elevation", request.sun->elevation, -10, 90, "%.0f°", "Above the horizon");
        logarithmic_slider(theme, "Irradiance", request.sun->irradiance, 0.01, 1000, "%.3g W/m²");
    }
}

void draw_display(const Theme& theme, ShownState& shown) {
    slider(theme, "Exposure", shown.exposure, -10, 10, "%+.2f EV", "Powers of two  ( [ and ] )");
    choice(theme, "Tone map", {"none", "exponential", "Uncharted 2", "ACES", "PBR neutral"}, shown.tonemap,
           "From radiance to display  (T)");
    const bool colored =
        shown.layer == ShownLayer::radiance || shown.layer == ShownLayer::albedo || shown.layer == ShownLayer::normal;
    if (!colored || shown.panel == ShownPanel::difference) {
        bool found = shown.layer_scale == 0;
        if (toggle(theme, "Auto scale", found, "What is shown as full is found from the picture")) {
            shown.layer_scale = found ? 0 : 1;
        }
        if (!found) {
            logarithmic_slider(theme, "Full at", shown.layer_scale, 1e-4, 1e4, "%.3g");
        }
    }
}

void draw_camera(const Theme& theme, const InterfaceFacts& facts, ViewState& state, InterfaceState& interface) {
    const Scene& scene = *facts.scene->scene;
    Camera& camera = state.rendered.camera;
    row(theme, "Camera", "The scene's cameras  (1 to 9)");
    const int index = state.rendered.request.settings.camera;
    const auto title = [&](std::size_t i) {
        return scene.cameras[i].name.empty() ? fmt::format("camera {}", i + 1) : scene.cameras[i].name;
    };
    if (ImGui::BeginCombo("##camera", title(static_cast<std::size_t>(index)).c_str())) {
        for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
            ImGui::PushID(static_cast<int>(i));
            if (ImGui::Selectable(title(i).c_str(), static_cast<int>(i) == index)) {
                interface.wishes.camera = static_cast<int>(i);
            }
            ImGui::PopID();
        }
        ImGui::EndCombo();
    }
    const double diagonal = is_empty(facts.scene->bounds)
                                ? 1
                                : std::max(glm::length(facts.scene->bounds.hi - facts.scene->bounds.lo), 1e-6);
    const double distance = glm::length(state.pivot - glm::dvec3(camera.camera_to_world[3]));
    if (camera.orthographic) {
        logarithmic_slider(theme, "Height", camera.orthographic_height, diagonal * 1e-3, diagonal * 10, "%.3g m",
                           "Of the whole view");
    } else {
        double degrees = camera.vertical_fov * 180 / glm::pi<double>();
        if (slider(theme, "Field of view", degrees, 1, 150, "%.1f°", "Vertical")) {
            set_field_of_view(camera, degrees * glm::pi<double>() / 180, distance);
        }
        logarithmic_slider(theme, "Aperture", camera.lens_radius, 0, diagonal * 0.1, "%.4g m",
                           "Radius of the lens; 0 is a pinhole");
        ImGui::BeginDisabled(camera.lens_radius <= 0);
        logarithmic_slider(theme, "Focus", camera.focus_distance, diagonal * 1e-3, diagonal * 10, "%.3g m",
                           "Distance in focus. F focuses on what is under the pointer");
        ImGui::EndDisabled();
    }
    row(theme, "");
    if (ImGui::Button("Reset camera", {-1, 0})) {
        interface.wishes.reset_camera = true;
    }
    explain("Back to the scene's own  (R)");
}

}  // namespace

void draw_resampling(const Theme& theme, ResamplingSettings& resampling, bool reuses) {
    slider(theme, "Light draws", resampling.light_candidates, 0, 64, "Candidates from the lights, a pixel and frame");
    double near = static_cast<double>(resampling.near_share);
    slider(theme, "Near share", near, 0, 1, "%.2f", "Of them, picked by distance too");
    resampling.near_share = static_cast<float>(near);
    toggle(theme, "BSDF draw", resampling.bsdf_candidate, "One more candidate, from the material");
    choice(theme, "MIS", {"pairwise", "balance", "1/Z", "1/M, biased"}, resampling.mis,
           "Weights between what is resampled");
    choice(theme, "Visibility", {"when shading", "in the target", "initial, biased", "final, biased"},
           resampling.visibility, "Where shadow rays count");
    if (!reuses) {
        return;
    }
    toggle(theme, "Temporal", resampling.temporal, "Reuse what the frame before has found");
    double cap = static_cast<double>(resampling.confidence_cap);
    ImGui::BeginDisabled(!resampling.temporal);
    slider(theme, "M cap", cap, 1, 100, "%.0f", "How much the past may count, in frames");
    ImGui::EndDisabled();
    resampling.confidence_cap = static_cast<float>(cap);
    slider(theme, "Spatial", resampling.spatial_passes, 0, 4, "Passes that reuse what neighbours have found");
    ImGui::BeginDisabled(resampling.spatial_passes == 0);
    slider(theme, "Neighbours", resampling.neighbors, 1, 16);
    double radius = static_cast<double>(resampling.radius);
    slider(theme, "Radius", radius, 1, 64, "%.0f px");
    resampling.radius = static_cast<float>(radius);
    ImGui::EndDisabled();
}

void draw_settings(const Theme& theme, const InterfaceFacts& facts, ViewState& state, InterfaceState& interface) {
    begin_panel("settings", layout_of(theme, interface, ImGui::GetIO().DisplaySize).settings);
    RenderRequest& request = state.rendered.request;
    if (section(theme, "Sampling")) {
        draw_sampling(theme, request.settings);
    }
    if (resamples(request.settings.integrator) && section(theme, "Resampling")) {
        draw_resampling(theme, request.settings.resampling, request.settings.integrator == Integrator::restir);
    }
    if (section(theme, "Display")) {
        draw_display(theme, state.shown);
    }
    if (section(theme, "Camera") && facts.scene != nullptr) {
        draw_camera(theme, facts, state, interface);
    }
    if (section(theme, "Light", request.sun || request.environment_scale != 1)) {
        draw_light(theme, facts, request);
    }
    ImGui::End();
}

}  // namespace diptych::app
