#include "memory/film_memory.h"

#include "commands/commands.h"
#include "../../shaders/film_layout.h"
#include "memory/readback.h"
#include "language/scene_features.h"
#include "threads.h"

namespace diptych::core {
namespace {

using Usage = vk::BufferUsageFlagBits;

static_assert(sizeof(shared::FilmPixel) == 4 * shared::FILM_PIXEL_WORDS);
static_assert(sizeof(shared::FilmMoments) == 4 * shared::FILM_MOMENTS_WORDS);
static_assert(sizeof(shared::FilmFirstHit) == 4 * shared::FILM_FIRST_HIT_WORDS);

/// Of whole blocks.
template <class Struct>
std::uint64_t layer_bytes(std::uint64_t pixels) {
    return (pixels + shared::FILM_BLOCK - 1) / shared::FILM_BLOCK * shared::FILM_BLOCK * sizeof(Struct);
}

template <class Struct>
Buffer layer(const Gpu& gpu, std::uint64_t pixels) {
    return make_buffer(gpu, Purpose::film, layer_bytes<Struct>(pixels),
                       Usage::eStorageBuffer | Usage::eShaderDeviceAddress | Usage::eTransferSrc | Usage::eTransferDst,
                       MemoryKind::device);
}

/// Calls copy(word of a struct, word of the device) for all words of so many structs.
template <class Struct, class Copy>
void for_words(std::size_t pixels, const Copy& copy) {
    constexpr std::size_t words = sizeof(Struct) / sizeof(std::uint32_t);
    in_parts(pixels, [&](std::size_t begin, std::size_t end) {
        for (std::size_t pixel = begin; pixel < end; ++pixel) {
            for (std::size_t word = 0; word < words; ++word) {
                copy(pixel * words + word, (pixel / shared::FILM_BLOCK * words + word) * shared::FILM_BLOCK +
                                               pixel % shared::FILM_BLOCK);
            }
        }
    });
}

template <class Struct>
std::vector<Struct> read_layer(const Gpu& gpu, const Buffer& buffer, std::size_t pixels) {
    if (buffer.size == 0) {
        return {};
    }
    const std::vector<std::uint32_t> words = read_array<std::uint32_t>(gpu, buffer);
    std::vector<Struct> structs(pixels);
    auto* to = reinterpret_cast<std::uint32_t*>(structs.data());
    for_words<Struct>(pixels, [&](std::size_t own, std::size_t device) { to[own] = words[device]; });
    return structs;
}

}  // namespace

FilmMemory make_film(const Gpu& gpu, int width, int height, std::uint32_t features) {
    const std::uint64_t count = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    FilmMemory film;
    film.width = width;
    film.height = height;
    film.pixels = layer<shared::FilmPixel>(gpu, count);
    if ((features & shared::FEATURE_STANDARD_ERROR) != 0) {
        film.moments = layer<shared::FilmMoments>(gpu, count);
    }
    if ((features & shared::FEATURE_FIRST_HIT_LAYERS) != 0) {
        film.first_hits = layer<shared::FilmFirstHit>(gpu, count);
    }
    run_commands(gpu, [&](Recorder& recorder) { record_clear(recorder, film); });
    return film;
}

bool fits(const FilmMemory& film, int width, int height, std::uint32_t features) {
    return film.width == width && film.height == height &&
           (film.moments.size > 0) == ((features & shared::FEATURE_STANDARD_ERROR) != 0) &&
           (film.first_hits.size > 0) == ((features & shared::FEATURE_FIRST_HIT_LAYERS) != 0);
}

void record_clear(Recorder& recorder, const FilmMemory& film) {
    recorder.use({{Resource::film, Unit::transfer, Effect::write}});
    for (const Buffer* buffer : {&film.pixels, &film.moments, &film.first_hits}) {
        if (buffer->size > 0) {
            recorder->fillBuffer(*buffer->handle, 0, VK_WHOLE_SIZE, 0);
        }
    }
}

void enter_film(SceneAddresses& addresses, const FilmMemory& film) {
    addresses.film_pixels = film.pixels.address;
    addresses.film_moments = film.moments.address;
    addresses.film_first_hits = film.first_hits.address;
}

Film read_film(const Gpu& gpu, const FilmMemory& film) {
    Film host;
    host.width = film.width;
    host.height = film.height;
    const std::size_t pixels = static_cast<std::size_t>(film.width) * static_cast<std::size_t>(film.height);
    host.pixels = read_layer<shared::FilmPixel>(gpu, film.pixels, pixels);
    host.moments = read_layer<shared::FilmMoments>(gpu, film.moments, pixels);
    host.first_hits = read_layer<shared::FilmFirstHit>(gpu, film.first_hits, pixels);
    return host;
}

std::uint64_t film_bytes(const FilmMemory& film) {
    return film.pixels.size + film.moments.size + film.first_hits.size;
}

std::uint64_t film_bytes(std::uint64_t pixels, std::uint32_t features) {
    return layer_bytes<shared::FilmPixel>(pixels) +
           ((features & shared::FEATURE_STANDARD_ERROR) != 0 ? layer_bytes<shared::FilmMoments>(pixels) : 0) +
           ((features & shared::FEATURE_FIRST_HIT_LAYERS) != 0 ? layer_bytes<shared::FilmFirstHit>(pixels) : 0);
}

template <class Struct>
std::vector<std::uint32_t> device_words(const std::vector<Struct>& structs) {
    std::vector<std::uint32_t> words(layer_bytes<Struct>(structs.size()) / sizeof(std::uint32_t));
    const auto* from = reinterpret_cast<const std::uint32_t*>(structs.data());
    for_words<Struct>(structs.size(), [&](std::size_t own, std::size_t device) { words[device] = from[own]; });
    return words;
}

template std::vector<std::uint32_t> device_words(const std::vector<shared::FilmPixel>&);
template std::vector<std::uint32_t> device_words(const std::vector<shared::FilmMoments>&);
template std::vector<std::uint32_t> device_words(const std::vector<shared::FilmFirstHit>&);

}  // namespace diptych::core
