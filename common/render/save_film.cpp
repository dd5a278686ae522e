#include "render/save_film.h"

#include <cstdlib>

#include "image/tonemap_image.h"
#include "render/film_behind.h"

namespace diptych::core {

namespace {

void write_film_exr(const Film& film, const std::map<std::string, std::string>& metadata, bool sums,
                    const std::string& path) {
    const auto interrupted = metadata.find("interrupted");
    const bool quickly = interrupted != metadata.end() && interrupted->second == "yes";
    const FilmLayers layers = quickly && sums ? FilmLayers::color : FilmLayers::all;
    GrowingImage image{film.width, film.height, {}, metadata, quickly ? ExrCompression::off : ExrCompression::zip};
    image.band = [&](int first, int count) { return develop_rows(film, first, count, layers); };
    WriteBehind behind;
    if (sums) {
        image.metadata[film_behind_entry] = "end of file";
        behind = [&](TemporaryFile& file) { write_film_behind(film, file); };
    }
    write_exr(path, image, behind);
}

}  // namespace

void write_film(const Film& film, const std::map<std::string, std::string>& metadata, const RenderRequest& request,
                const std::string& path) {
    const auto color = [&] { return develop(film, FilmLayers::color).color; };
    switch (image_format(path)) {
    case ImageFormat::Exr:
        write_film_exr(film, metadata, request.sums, path);
        break;
    case ImageFormat::Png:
        write_png(path, tonemapped(color(), tonemap_from_name(request.tonemap), static_cast<float>(request.exposure)));
        break;
    case ImageFormat::Hdr:
        write_hdr(path, color());
        break;
    }
}

void write_picture(const LayeredImage& picture, const RenderRequest& request, const std::string& path) {
    switch (image_format(path)) {
    case ImageFormat::Exr:
        write_exr(path, picture);
        break;
    case ImageFormat::Png:
        write_png(path, tonemapped(picture.color, tonemap_from_name(request.tonemap),
                                   static_cast<float>(request.exposure)));
        break;
    case ImageFormat::Hdr:
        write_hdr(path, picture.color);
        break;
    }
}

void save_film(const Film& film, const RenderRequest& request, const RenderOutcome& outcome) {
    write_film(film, render_metadata(request, outcome), request, request.output);
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
    write_film(file.film, file.metadata, shown_by(file.metadata, sums), path);
}

}  // namespace diptych::core
