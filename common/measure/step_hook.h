// How engines tell how far they are.
#pragma once

#include <functional>
#include <string>

namespace diptych::core {

/// Called before each step, from the thread that measures, with what it is to do: "path, frame 2".
using StepHook = std::function<void(const std::string& what)>;

}  // namespace diptych::core
