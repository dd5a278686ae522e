// One picture on both backends.
#pragma once

#include <filesystem>
#include <memory>

#include "../cpu/agreement_scenes.h"
#include "image/metrics.h"
#include "scene/default_camera.h"
#include "scene/environment_load.h"
#include "vulkan_device.h"
#include "renderer/vulkan_renderer.h"

namespace diptych::core::tests {

/// The device, without validation and opened once: its renderers share the pipelines that they compile, and a driver
/// that is unloaded and loaded again some thirty times in a process may refuse.
std::shared_ptr<Gpu> panels_gpu();

/// Renders on the device, under validation where its layer is installed, and fails on any message of it.
Film render_vulkan(const PackedScene& packed, std::uint32_t spp);
Film render_vulkan(const Scene& scene, const RenderSettings& settings, std::uint32_t spp);

/// Lights and cameras for a file that brings none, as the program does.
void complete_scene(Scene& scene);

/// Files of the real assets by their path under gltf/; empty where the assets are not there.
std::filesystem::path asset_folder();

/// For pictures of one seed on both panels.
RenderSettings paired_settings(int width, int height, Integrator integrator, BrdfModel brdf);

/// Share of pixels that differ by at most 1e-3 max(|a|, |b|) + 1e-6 in every channel.
double fraction_equal(const Film& a, const Film& b);

}  // namespace diptych::core::tests
