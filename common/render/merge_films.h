// Two films of one picture as one.
#pragma once

#include "render/film.h"

namespace diptych::core {

/// Adds the samples of `from` to `into`. Sums and first hits are those of all samples, up to the rounding of double;
/// second moments are moved to the first sample of `into`. Throws Error where size or layers differ.
void merge_films(const Film& from, Film& into);

}  // namespace diptych::core
