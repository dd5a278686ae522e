#include "render/save_film.h"

#include "image/image_file.h"
#include "image/tonemap_image.h"
#include "render/film_words.h"

namespace diptych::core {

namespace {

struct Shown {
    std::string tonemap;
    double exposure = 0;
};

void write(const std::string& path, const Film& film, const LayeredImage& layers, bool sums, const Shown& shown) {
    switch (image_format(path)) {
    case ImageFormat::Exr:
        if (sums) {
            const WordChannels words = film_words(film);
            write_exr(path, layers, &words);
        } else {
            write_exr(path, layers);
        }
        break;
    case ImageFormat::Png:
        write_png(path, tonemapped(layers.color, tonemap_from_name(shown.tonemap), static_cast<float>(shown.exposure)));
        break;
    case ImageFormat::Hdr:
        write_hdr(path, layers.color);
        break;
    }
}

}  // namespace

LayeredImage save_film(const Film& film, const RenderRequest& request, const RenderOutcome& outcome) {
    LayeredImage layers = develop(film);
    layers.metadata = render_metadata(request, outcome);
    write(request.output, film, layers, request.sums, {request.tonemap, request.exposure});
    return layers;
}

void save_film_file(const FilmFile& file, const std::string& path, bool sums) {
    LayeredImage layers = develop(file.film);
    layers.metadata = file.metadata;
    Shown shown{tonemap_name(default_tonemap), 0};
    if (const auto found = file.metadata.find("tonemap"); found != file.metadata.end()) {
        shown.tonemap = found->second;
    }
    if (const auto found = file.metadata.find("exposure"); found != file.metadata.end()) {
        shown.exposure = std::strtod(found->second.c_str(), nullptr);
    }
    write(path, file.film, layers, sums, shown);
}

}  // namespace diptych::core
