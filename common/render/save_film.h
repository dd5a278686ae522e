// A film as the file that was asked for.
#pragma once

#include "image/layered_image.h"
#include "render/film.h"
#include "render/film_file.h"
#include "render/metadata.h"
#include "render/request.h"

namespace diptych::core {

/// Develops the film and writes request.output with the metadata of both, by its extension; returns what it wrote. With
/// request.sums, an .exr gets the film itself as a second part, which read_film reads.
/// Throws Error.
LayeredImage save_film(const Film& film, const RenderRequest& request, const RenderOutcome& outcome);

/// Writes a film as its metadata say it is shown. Throws Error.
void save_film_file(const FilmFile& file, const std::string& path, bool sums);

}  // namespace diptych::core
