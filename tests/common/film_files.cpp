// Films in files come back to the bit, and damaged ones are refused.
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>

#include "catch.h"
#include "error.h"
#include "image/layered_image.h"
#include "render/film_behind.h"
#include "render/film_blocks.h"
#include "render/film_file.h"
#include "render/save_film.h"
#include "temporary_folder.h"

namespace diptych::core {
namespace {

/// Samples of all magnitudes, more on the pixels at the end; runs of equal ones, as on walls.
Film noisy_film(int width, int height, bool layers, unsigned seed) {
    Film film;
    film.width = width;
    film.height = height;
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    film.pixels.resize(pixels);
    film.moments.resize(layers ? pixels : 0);
    film.first_hits.resize(layers ? pixels : 0);
    std::mt19937 random(seed);
    for (std::size_t i = 0; i < pixels; ++i) {
        const bool plain = (i / 1000) % 2 == 0;
        for (unsigned sample = 0; sample < 1 + random() % 3; ++sample) {
            const auto value = [&] {
                return plain ? 0.25F : std::ldexp(static_cast<float>(random() >> 8U), static_cast<int>(random() % 160) - 120);
            };
            const shared::vec3 radiance(value(), value(), random() % 31 == 0 ? -1.0F : value());
            const bool kept = shared::film_add(film.pixels[i], radiance, random() >> (random() % 32));
            if (layers && kept) {
                shared::film_add_moments(film.moments[i], radiance);
            }
            if (layers) {
                const float z = plain ? 1 : -static_cast<float>(random() >> 8U) * 0x1p-24F;
                shared::film_add_first_hit(film.first_hits[i], {shared::vec3(0.7F), {0, 1, z}, value()});
            }
        }
    }
    return film;
}

template <class T>
bool same_words(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same_film(const Film& a, const Film& b) {
    return a.width == b.width && a.height == b.height && same_words(a.pixels, b.pixels) &&
           same_words(a.moments, b.moments) && same_words(a.first_hits, b.first_hits);
}

FilmFile film_file(Film film, bool interrupted) {
    FilmFile file;
    file.film = std::move(film);
    file.metadata = {{"samples", "0:3"}, {"spp", "3"}, {"interrupted", interrupted ? "yes" : "no"}};
    file.samples = SampleRanges::parse("0:3");
    return file;
}

std::string bytes_in(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("A film in a file comes back to the bit, finished or interrupted, and equal films make equal files") {
    const tests::TemporaryFolder folder;
    struct Size {
        int width, height;
    };
    const Size size = GENERATE(Size{1, 1}, Size{257, 1}, Size{3, 200}, Size{311, 170});  // the last in several groups
    const bool layers = GENERATE(false, true);
    const bool interrupted = GENERATE(false, true);
    CAPTURE(size.width, size.height, layers, interrupted);
    const FilmFile written = film_file(noisy_film(size.width, size.height, layers, 5), interrupted);
    const std::string path = (folder / "film.exr").string();
    save_film_file(written, path, true);
    const std::optional<FilmFile> read = read_film(path);
    REQUIRE(read);
    CHECK(same_film(read->film, written.film));
    CHECK(read->metadata == written.metadata);
    CHECK(read->samples.text() == "0:3");
    // Readers of pictures see what was developed.
    const LayeredImage picture = read_image(path);
    const LayeredImage developed = develop(written.film);
    CHECK(picture.color.data == developed.color.data);
    CHECK(picture.standard_error.has_value() == (layers && !interrupted));
    if (picture.albedo) {
        CHECK(picture.albedo->data == developed.albedo->data);
    }
    save_film_file(written, (folder / "again.exr").string(), true);
    CHECK(bytes_in(folder / "again.exr") == bytes_in(path));
    CHECK(folder.file_count() == 2);
}

TEST_CASE("A file whose film is damaged or cut short is refused by name") {
    const tests::TemporaryFolder folder;
    const FilmFile written = film_file(noisy_film(40, 30, true, 9), true);
    const std::string path = (folder / "film.exr").string();
    save_film_file(written, path, true);
    const std::string bytes = bytes_in(path);
    const std::size_t picture_ends = bytes.size() - bytes.size() / 4;  // the film is more than a quarter of the file
    const auto refused = [&](const std::string& damaged) {
        const std::filesystem::path file = folder.write("damaged.exr", damaged);
        try {
            const std::optional<FilmFile> read = read_film(file);
            CHECK(same_film(read.value().film, written.film));  // what fills a page up may be anything
            return false;
        } catch (const Error& error) {
            return std::string(error.what()).find(file.string() + ": cannot read its film: ") == 0;
        }
    };
    std::mt19937 random(4);
    int count = 0;
    for (int trial = 0; trial < 200; ++trial) {
        std::string damaged = bytes;
        const std::size_t place = picture_ends + random() % (bytes.size() - picture_ends);
        damaged[place] = static_cast<char>(damaged[place] ^ (1 << (random() % 8)));
        INFO("place " << place);
        count += refused(damaged) ? 1 : 0;
    }
    CHECK(count > 180);
    for (const std::size_t left : {bytes.size() - 1, bytes.size() - 40, picture_ends}) {
        CHECK(refused(bytes.substr(0, left)));
    }
    CHECK_FALSE(refused(bytes));
}

TEST_CASE("A film asks for no more memory than it may, and a small file cannot claim a huge one") {
    const tests::TemporaryFolder folder;
    const FilmFile written = film_file(noisy_film(40, 30, true, 9), false);
    const std::string path = (folder / "film.exr").string();
    save_film_file(written, path, true);
    const std::uint64_t bytes = film_bytes(40 * 30, true, true);
    CHECK(bytes == 40 * 30 * 236);
    CHECK(same_film(read_film(path, bytes)->film, written.film));
    const auto refusal = [](const std::filesystem::path& file, std::uint64_t limit) {
        try {
            read_film(file, limit);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(refusal(path, bytes - 1) ==
          path + ": cannot read its film: asks for 276.6 KB, and a file may ask for 276.6 KB (`memory_limit`)");
    const std::filesystem::path old = DIPTYCH_SOURCE_DIR "/tests/common/data/sums-in-channels.exr";
    const std::string of_words = refusal(old, 1000);
    CHECK(of_words.find(old.string()) == 0);
    CHECK(of_words.find("a file may ask for 1000 bytes (`memory_limit`)") != std::string::npos);
    // The same picture with a footer that claims 16384 x 16384 pixels and all layers: 59 GB. A hole makes the file long
    // enough for the least that so many pixels can take; it takes no room on the disk.
    const std::filesystem::path claim = folder.write("claim.exr", bytes_in(path));
    const std::uint64_t length = std::uint64_t{32} << 20U;
    std::filesystem::resize_file(claim, length);
    std::string footer = bytes_in(path);
    footer = footer.substr(footer.size() - 32);
    const std::uint32_t side = 16384;
    std::memcpy(footer.data(), &side, sizeof side);
    std::memcpy(footer.data() + 4, &side, sizeof side);
    std::fstream file(claim, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(length - 32));
    file.write(footer.data(), 32);
    file.close();
    CHECK(refusal(claim, std::uint64_t{1} << 30U) ==
          claim.string() + ": cannot read its film: asks for 59.0 GB, and a file may ask for 1.0 GB (`memory_limit`)");
}

TEST_CASE("Bytes that are no pixels are refused, or are some pixels") {
    std::mt19937 random(1);
    Film film = noisy_film(300, 1, true, 1);
    std::vector<unsigned char> packed(most_packed_bytes(film, 300));
    packed.resize(pack_pixels(film, 0, 300, packed));
    int refused = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        std::vector<unsigned char> bytes = packed;
        for (int flips = 0; flips < 3; ++flips) {
            bytes[random() % bytes.size()] ^= static_cast<unsigned char>(1 + random() % 255);
        }
        bytes.resize(trial % 2 == 0 ? bytes.size() : random() % bytes.size());
        try {
            unpack_pixels(bytes, 0, 300, film);
        } catch (const std::runtime_error&) {
            ++refused;
        }
    }
    CHECK(refused > 1000);
}

TEST_CASE("Files of earlier versions, with sums in channels, still load") {
    const std::filesystem::path path = DIPTYCH_SOURCE_DIR "/tests/common/data/sums-in-channels.exr";
    const std::optional<FilmFile> old = read_film(path);
    REQUIRE(old);
    CHECK(old->samples.text() == "0:5");
    CHECK(samples_of_every_pixel(old->film) == 5);
    // The file has the picture that the version which wrote it developed from the sums.
    const LayeredImage picture = read_image(path);
    const LayeredImage developed = develop(old->film);
    CHECK(picture.color.data == developed.color.data);
    CHECK(picture.standard_error->data == developed.standard_error->data);
    CHECK(picture.normal->data == developed.normal->data);
    const tests::TemporaryFolder folder;
    save_film_file(*old, (folder / "new.exr").string(), true);
    CHECK(same_film(read_film(folder / "new.exr")->film, old->film));
}

}  // namespace diptych::core
