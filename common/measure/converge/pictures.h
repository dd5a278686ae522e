// The pictures of the page of `converge`.
#pragma once

#include <vector>

#include "measure/converge/method.h"
#include "measure/converge/state.h"

namespace diptych::core {

/// Beside each method's picture that is there: NAME.png and NAME-error.png; and reference.png. Of at most so many pixels
/// a side.
void write_page_pictures(const std::vector<Method>& methods, const ReferencePicture& reference, int largest_side,
                         const ConvergeState& state);

}  // namespace diptych::core
