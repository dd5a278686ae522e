// A film as the file that was asked for.
#pragma once

#include "image/layered_image.h"
#include "render/film.h"
#include "render/metadata.h"
#include "render/request.h"

namespace diptych::core {

/// Develops the film and writes request.output with the metadata of both, by its extension; returns what it wrote.
/// Throws Error.
LayeredImage save_film(const Film& film, const RenderRequest& request, const RenderOutcome& outcome);

}  // namespace diptych::core
