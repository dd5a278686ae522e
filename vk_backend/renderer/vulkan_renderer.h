// The Vulkan panel: renders on a Vulkan device with ray-tracing pipelines.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/devices.h"
#include "pack/packed_scene.h"
#include "render/renderer.h"
#include "device/validation.h"

namespace diptych::core {

struct Gpu;

struct VulkanOptions {
    std::string device;           // "" the best, else an index or a part of the name
    bool validation = false;      // core and synchronisation validation; DIPTYCH_VALIDATION=1 asks for it too
    bool group_instances = true;  // see instance_groups.h; does not change the picture
    BusyHook busy = {};           // of the thread that makes a renderer or reconfigures it
};

/// Opens the device that the options name. Throws NoDevice or Error.
std::shared_ptr<Gpu> open_device(const VulkanOptions& options);

/// Whether the device was lost. It is of no use any more, but the same device can be opened anew.
bool is_lost(const Gpu& gpu);

/// Uploads the scene, builds its acceleration structures and compiles its pipeline. `packed` is not used afterwards.
/// Throws NoDevice, which says what is missing, if no device is usable; OutOfMemory, before anything is allocated where
/// that can be known, and which then leaves nothing behind; Error if a device fails.
std::unique_ptr<Renderer> make_vulkan_renderer(const PackedScene& packed, const VulkanOptions& options);

/// The same on an open device, which other threads may use at the same time. Of the options only group_instances and
/// busy are used.
std::unique_ptr<Renderer> make_vulkan_renderer(std::shared_ptr<Gpu> gpu, const PackedScene& packed,
                                               const VulkanOptions& options = {});

}  // namespace diptych::core
