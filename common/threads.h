// Whether this process may start threads.
#pragma once

#include <cstddef>
#include <functional>

namespace diptych::core {

/// As many as the machine runs at once; 1 at least.
unsigned machine_threads();

/// Calls `work` with parts of 0 .. count-1 that cover it, on all cores where threads can be started. `work` may not
/// throw.
void in_parts(std::size_t count, const std::function<void(std::size_t begin, std::size_t end)>& work);

/// Throws an Error where so many threads cannot be started at once. Libraries that find out by themselves end the
/// process without a word, or with one that says nothing.
void require_threads(unsigned count);

}  // namespace diptych::core
