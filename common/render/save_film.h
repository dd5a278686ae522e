// A film as the file that was asked for.
#pragma once

#include <string>

#include "image/layered_image.h"
#include "render/film.h"
#include "render/film_file.h"
#include "render/metadata.h"
#include "render/request.h"

namespace diptych::core {

/// The film's picture with the metadata of request and outcome.
LayeredImage developed_film(const Film& film, const RenderRequest& request, const RenderOutcome& outcome);

/// Writes the film's picture as `path`, by its extension; what is tone mapped is so as the request says. With
/// request.sums, an .exr gets the film itself too, which read_film reads. Throws Error.
void save_layers(const LayeredImage& layers, const Film& film, const RenderRequest& request, const std::string& path);

/// Both, as request.output; returns what it wrote. Throws Error.
LayeredImage save_film(const Film& film, const RenderRequest& request, const RenderOutcome& outcome);

/// How a picture's metadata say that it is shown, as a request for save_layers.
RenderRequest shown_by(const Metadata& metadata, bool sums);

/// Writes a film as its metadata say it is shown, with or without its sums. Throws Error.
void save_film_file(const FilmFile& file, const std::string& path, bool sums);

}  // namespace diptych::core
