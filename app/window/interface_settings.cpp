// The panel on the left: how the picture is made and shown.
#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "settings/names.h"
#include "scene/default_camera.h"
#include "view/camera_control.h"
#include "window/interface_layout.h"
#include "window/widgets.h"

namespace diptych::core::app {

namespace {

template <typename Enum>
bool choose(const Theme& theme, const char* setting, std::initializer_list<Enum> offered, Enum& chosen,
            const std::string& help) {
    return setting_choice(
        theme, setting, offered, [](Enum value) { return name_of(value); }, chosen, help);
}

void draw_sampling(const Theme& theme, RenderSettings& settings) {
    slider(theme, ranges::max_depth, settings.max_depth,
           "Maximum number of scattering events; 1 gives emission and direct light");
    choose(theme, "brdf", {BrdfModel::ggx, BrdfModel::blinn_phong}, settings.brdf,
           "Microfacet model of metallic-roughness materials");
    choose(theme, "normal-maps", {NormalMaps::shading, NormalMaps::microfacet}, settings.normal_maps,
           "Shading by the mapped normal, or microfacets that conserve energy");
    // Not Hammersley's points: they are laid out for a number of samples that is known beforehand.
    choose(theme, "sampler", {SamplerKind::independent, SamplerKind::sobol}, settings.sampler,
           "Sample sequence");
    if (settings.integrator == Integrator::path) {
        choose(theme, "mis", {MisHeuristic::power, MisHeuristic::balance}, settings.mis,
               "MIS weights of light and BSDF sampling");
    }
    if (settings.integrator != Integrator::brdf) {
        choose(theme, "light-sampler", {LightSampler::uniform, LightSampler::power, LightSampler::spatial},
               settings.light_sampler, "How a vertex picks a light: all alike, by power, or also by distance and direction");
    }
}

void draw_light(const Theme& theme, const InterfaceFacts& facts, RenderRequest& request) {
    const bool none = facts.scene == nullptr || facts.scene->scene->environment.kind == EnvironmentKind::none;
    ImGui::BeginDisabled(none);
    slider(theme, ranges::env_scale, request.environment_scale, "× %.3g",
           "Factor on the environment light. Drop a .hdr or .exr to replace it");
    slider(theme, ranges::env_rotate, request.environment_rotation, "%.0f°",
           "Rotation of the environment about the vertical");
    ImGui::EndDisabled();
    bool shines = request.sun.has_value();
    if (setting_toggle(theme, "sun", shines, "A directional light beside the scene's own")) {
        request.sun = shines ? std::optional<Sun>(Sun{}) : std::nullopt;
    }
    if (request.sun) {
        slider(theme, ranges::sun_azimuth, request.sun->azimuth, "%.0f°",
               "Azimuth, first number of --sun: clockwise from above, from the middle of the environment");
        slider(theme, ranges::sun_elevation, request.sun->elevation, "%.0f°",
               "Elevation, second number of --sun: above the horizon");
        slider(theme, ranges::sun_irradiance, request.sun->irradiance, "%.3g W/m²",
               "Irradiance, third number of --sun");
    }
}

void draw_display(const Theme& theme, ShownState& shown) {
    slider(theme, ranges::exposure, shown.exposure, "%+.2f EV", "Exposure in powers of two  ( [ and ] )");
    setting_choice(theme, "tonemap",
                   {ToneMap::None, ToneMap::Exponential, ToneMap::Uncharted2, ToneMap::Aces, ToneMap::PbrNeutral},
                   tonemap_name, shown.tonemap, "Tone mapping from radiance to display  (T)");
    const bool colored =
        shown.layer == ShownLayer::radiance || shown.layer == ShownLayer::albedo || shown.layer == ShownLayer::normal;
    if (!colored || shown.panel == ShownPanel::difference) {
        bool found = shown.layer_scale == 0;
        if (toggle(theme, "Auto scale", found, "Derive the value shown at full brightness from the picture")) {
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
        slider(theme, ranges::view_height, camera.orthographic_height, "%.3g m", "Height of the whole view",
               NumberRange{diagonal * 1e-3, diagonal * 10});
    } else {
        double degrees = camera.vertical_fov * 180 / glm::pi<double>();
        if (slider(theme, ranges::fov, degrees, "%.1f°", "Vertical field of view")) {
            set_field_of_view(camera, degrees * glm::pi<double>() / 180, distance);
        }
        slider(theme, ranges::aperture, camera.lens.radius, "%.4g m", "Lens radius; 0 is a pinhole",
               NumberRange{0, diagonal * 0.1});
        ImGui::BeginDisabled(camera.lens.radius <= 0);
        slider(theme, ranges::focus, camera.lens.focus_distance, "%.3g m",
               "Focus distance. F focuses on the point under the pointer",
               NumberRange{diagonal * 1e-3, diagonal * 10});
        ImGui::EndDisabled();
    }
    row(theme, "");
    if (ImGui::Button("Reset camera", {-1, 0})) {
        interface.wishes.reset_camera = true;
    }
    explain("Reset to the scene's camera  (R)");
}

}  // namespace

void draw_resampling(const Theme& theme, ResamplingSettings& resampling, bool reuses) {
    slider(theme, ranges::candidates, resampling.light_candidates, "Light candidates per pixel and frame");
    slider(theme, ranges::near_share, resampling.near_share, "%.2f",
           "Fraction of the candidates picked by power and distance");
    setting_toggle(theme, "bsdf-candidate", resampling.bsdf_candidate, "Add a candidate from BSDF sampling");
    choose(
        theme, "reuse-mis",
        {ResamplingMis::pairwise, ResamplingMis::balance, ResamplingMis::one_over_z, ResamplingMis::biased_one_over_m},
        resampling.mis, "MIS weights of reuse");
    choose(theme, "reuse-visibility",
           {ResamplingVisibility::shading, ResamplingVisibility::target, ResamplingVisibility::biased_initial,
            ResamplingVisibility::biased_final},
           resampling.visibility, "Where visibility is tested");
    if (!reuses) {
        return;
    }
    setting_toggle(theme, "temporal", resampling.temporal, "Reuse the reservoirs of the previous frame");
    ImGui::BeginDisabled(!resampling.temporal);
    slider(theme, ranges::confidence_cap, resampling.confidence_cap, "%.3g",
           "Cap on the confidence of the previous frame, in frames");
    ImGui::EndDisabled();
    slider(theme, ranges::spatial_passes, resampling.spatial_passes, "Number of spatial reuse passes");
    ImGui::BeginDisabled(resampling.spatial_passes == 0);
    slider(theme, ranges::neighbors, resampling.neighbors, "Neighbours per spatial pass");
    slider(theme, ranges::reuse_radius, resampling.radius, "%.3g px", "Radius of the disk of these neighbours");
    ImGui::EndDisabled();
}

void draw_settings(const Theme& theme, const InterfaceFacts& facts, ViewState& state, InterfaceState& interface) {
    begin_panel("settings", layout_of(theme, interface, ImGui::GetIO().DisplaySize).settings);
    RenderRequest& request = state.rendered.request;
    if (section(theme, "Sampling")) {
        draw_sampling(theme, request.settings);
    }
    if (resamples(request.settings.integrator) && section(theme, "Resampling")) {
        draw_resampling(theme, request.settings.resampling, reuses(request.settings.integrator));
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

}  // namespace diptych::core::app
