// Two films of one picture as one.
#pragma once

#include "render/film.h"

namespace diptych::core {

/// Adds the samples of `from` to `into`, exactly: the order of merging and the division of the samples among the films
/// make no difference. Throws Error where size or layers differ.
void merge_films(const Film& from, Film& into);

/// The same for some pixels, `first` and those after it; size and layers fit.
void merge_pixels(const Film& from, std::size_t first, Film& into);

}  // namespace diptych::core
