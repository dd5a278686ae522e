// What a method's picture looks like after a given time.
#pragma once

#include <atomic>

#include "measure/converge/runner.h"

namespace diptych::core {

/// Renders the picture of a method after about so many seconds, to the nearest whole sample, by the speed of its runs:
/// pictures/NAME.exr in the folder. Nothing to do where there is one for that time. `maker` is what it says that made
/// it. False where `cancel` came in between.
bool render_picture(MethodRunner& runner, double seconds, const ReferencePicture& reference, const PictureMaker& maker,
                    ConvergeState& state, const std::atomic<bool>& cancel);

}  // namespace diptych::core
