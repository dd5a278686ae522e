// Films in files: what render --samples and --checkpoint write, and merge and --resume read.
#include "render/film_file.h"
#include "render/merge_films.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace diptych::core;
    static const fuzz::InputFile file("film.exr");
    file.write({data, size});
    fuzz::must_load_or_refuse(file.path(), [&] {
        if (const std::optional<FilmFile> film = read_film(file.path())) {
            Film sum = film->film;
            merge_films(film->film, sum);
            develop(sum);
            picture_difference(film->metadata, {});
        }
    });
    return 0;
}
