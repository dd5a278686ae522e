#include "render/save_film.h"

#include <cstdlib>

#include "image/image_file.h"
#include "image/tonemap_image.h"
#include "render/film_words.h"

namespace diptych::core {

LayeredImage developed_film(const Film& film, const RenderRequest& request, const RenderOutcome& outcome) {
    LayeredImage layers = develop(film);
    layers.metadata = render_metadata(request, outcome);
    return layers;
}

void save_layers(const LayeredImage& layers, const Film& film, const RenderRequest& request, const std::string& path) {
    switch (image_format(path)) {
    case ImageFormat::Exr:
        if (request.sums) {
            const WordChannels words = film_words(film);
            write_exr(path, layers, &words);
        } else {
            write_exr(path, layers);
        }
        break;
    case ImageFormat::Png:
        write_png(path,
                  tonemapped(layers.color, tonemap_from_name(request.tonemap), static_cast<float>(request.exposure)));
        break;
    case ImageFormat::Hdr:
        write_hdr(path, layers.color);
        break;
    }
}

LayeredImage save_film(const Film& film, const RenderRequest& request, const RenderOutcome& outcome) {
    LayeredImage layers = developed_film(film, request, outcome);
    save_layers(layers, film, request, request.output);
    return layers;
}

RenderRequest shown_by(const Metadata& metadata, bool sums) {
    RenderRequest shown;
    shown.sums = sums;
    if (const auto found = metadata.find("tonemap"); found != metadata.end()) {
        shown.tonemap = found->second;
    }
    if (const auto found = metadata.find("exposure"); found != metadata.end()) {
        shown.exposure = std::strtod(found->second.c_str(), nullptr);
    }
    return shown;
}

void save_film_file(const FilmFile& file, const std::string& path, bool sums) {
    LayeredImage layers = develop(file.film);
    layers.metadata = file.metadata;
    save_layers(layers, file.film, shown_by(file.metadata, sums), path);
}

}  // namespace diptych::core
