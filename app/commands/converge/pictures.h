// What a method's picture looks like after a given time.
#pragma once

#include <atomic>

#include "commands/converge/reference.h"
#include "commands/converge/runner.h"
#include "commands/converge/state.h"

namespace diptych::app {

/// The picture of a method after about so many seconds, to the nearest whole sample, by the speed of its runs:
/// pictures/NAME.exr in the folder, and an event that says so. Nothing to do where there is one for that time. False
/// where `cancel` came in between.
bool make_picture(MethodRunner& runner, double seconds, const Reference& reference, ConvergeState& state,
                  const std::atomic<bool>& cancel);

/// For the page, beside each of them that is there: NAME.png and NAME-error.png, and reference.png, of at most so many
/// pixels a side.
void write_page_pictures(const std::vector<Method>& methods, const Reference& reference, int largest_side,
                         const ConvergeState& state);

}  // namespace diptych::app
