// A film as the file that was asked for.
#pragma once

#include <map>
#include <string>

#include "image/layered_image.h"
#include "render/film.h"
#include "render/film_file.h"
#include "render/metadata.h"
#include "render/request.h"

namespace diptych::core {

/// Writes the film's picture with these metadata as `path`, by its extension; what is tone mapped is so as the request
/// says. With request.sums, an .exr gets the film itself too, which read_film reads. Of an interrupted render such a file
/// has the colour alone, and nothing is compressed by zip: it is written within seconds, and what it lacks can be made
/// from the film. Throws Error.
void write_film(const Film& film, const std::map<std::string, std::string>& metadata, const RenderRequest& request,
                const std::string& path);

/// The same for a picture that was read from a file without its film.
void write_picture(const LayeredImage& picture, const RenderRequest& request, const std::string& path);

/// Writes a film with the metadata of request and outcome, as request.output. Throws Error.
void save_film(const Film& film, const RenderRequest& request, const RenderOutcome& outcome);

/// How a picture's metadata say that it is shown, as a request for write_film.
RenderRequest shown_by(const Metadata& metadata, bool sums);

/// Writes a film as its metadata say it is shown, with or without its sums. Throws Error.
void save_film_file(const FilmFile& file, const std::string& path, bool sums);

}  // namespace diptych::core
