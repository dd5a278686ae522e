// The backends by name: the one place that knows them all.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pack/packed_scene.h"
#include "render/renderer.h"
#include "render/request.h"
#include "render/session.h"
#include "scene/scene.h"

namespace diptych::core::app {

/// "cpu", "vulkan" and "oracle".
std::vector<std::string> backend_names();

/// The renderer of the request's backend, device, threads and oracle mode. The panels read the packed scene, the oracle
/// the logical one it was made of; both must outlive the renderer. From any thread. `busy` is told of steps that may
/// take long. Throws NoDevice where there is no suitable one, Error where the program was built without that backend.
std::unique_ptr<Renderer> open_renderer(const Scene& scene, const PackedScene& packed, const RenderRequest& request,
                                        const BusyHook& busy = {});

/// Opens renderers of that request, under the settings that a session asks for.
MakeRenderer renderer_maker(const RenderRequest& request);

/// Names of the Vulkan devices that can render, in Vulkan's order.
std::vector<std::string> usable_devices();

/// RenderRequest::device for one of several processes on this machine: they take turns among its Vulkan devices of the
/// best kind. Empty where there is none.
std::string device_in_turn(int local_rank);

/// Closes the Vulkan device that is kept open between renderers, once none of them uses it, and returns how many
/// messages the validation layer had in all.
std::uint64_t close_devices();

}  // namespace diptych::core::app
