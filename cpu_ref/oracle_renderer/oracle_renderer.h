// The oracle as one more renderer of the program: its double sums become a film.
#pragma once

#include <memory>
#include <string>

#include "oracle/oracle.h"
#include "render/renderer.h"
#include "settings/settings.h"

namespace diptych::core {

/// "mis", "bsdf", "hemisphere" or "area". Throws Error, listing them, where `name` is none.
oracle::Mode oracle_mode_from_name(const std::string& name);

/// Integrator, sampler, weights and features of the settings mean nothing to it. The scene must outlive it. `threads` 0
/// is one a core. `move_to` reads the logical scene again, posed as it is by then, and begins a new picture. Its
/// `bench_traversal` throws Error: there is no bare traversal to compare with.
std::unique_ptr<Renderer> make_oracle_renderer(const Scene& scene, const RenderSettings& settings, oracle::Mode mode,
                                               int threads);

}  // namespace diptych::core
