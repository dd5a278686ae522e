// The renderer that a command asked for.
#pragma once

#include <functional>
#include <memory>

#include "backends/backends.h"

namespace diptych::core::app {

/// open_renderer, or what tests have put in its place.
std::unique_ptr<Renderer> make_renderer(const Scene& scene, const PackedScene& packed, const RenderRequest& request,
                                        const BusyHook& busy = {});

using RendererMaker = std::function<std::unique_ptr<Renderer>(const Scene& scene, const PackedScene& packed,
                                                              const RenderRequest& request)>;

/// make_renderer asks `maker` from now on; an empty one undoes that. For tests of what commands ask of renderers.
void replace_renderers(RendererMaker maker);

/// Makes renderers of that request, under the settings that a session asks for.
MakeRenderer renderer_maker_of(const RenderRequest& request, BusyHook busy = {});

/// What the validation layer had to say during the run, as a line on stderr where that is anything. Returns
/// `exit_code`, or exit_check_failed where it was exit_done and there were messages. Call it when all renderers are
/// gone.
int exit_code_after_validation(int exit_code);

}  // namespace diptych::core::app
