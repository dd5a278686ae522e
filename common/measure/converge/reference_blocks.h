// Renders the picture that errors are measured against.
#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "measure/converge/runner.h"

namespace diptych::core {

/// Renders what is missing of it, `spp` samples a block, and leaves reference.exr in the folder; a finished one is read
/// back. `maker` is what the picture says that made it. Nothing where `cancel` came in between: the blocks so far are
/// kept. Throws Error.
std::optional<ReferencePicture> render_reference(MethodRunner& runner, std::uint32_t spp, const PictureMaker& maker,
                                                 ConvergeState& state, const std::atomic<bool>& cancel,
                                                 const std::function<void(std::uint32_t)>& begin_block);

}  // namespace diptych::core
