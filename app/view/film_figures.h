// A film in a few numbers.
#pragma once

#include "view/panel_worker.h"

namespace diptych::core::app {

/// Of a film of so many samples a pixel.
FilmFigures film_figures(const Film& film, std::uint64_t version, std::uint32_t spp);

}  // namespace diptych::core::app
