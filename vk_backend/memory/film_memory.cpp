#include "memory/film_memory.h"

#include "commands/commands.h"
#include "memory/readback.h"
#include "language/scene_features.h"

namespace diptych::core {
namespace {

using Usage = vk::BufferUsageFlagBits;

template <typename T>
Buffer layer(const Gpu& gpu, std::uint64_t count) {
    return make_buffer(gpu, Purpose::film, count * sizeof(T),
                       Usage::eStorageBuffer | Usage::eShaderDeviceAddress | Usage::eTransferSrc | Usage::eTransferDst,
                       MemoryKind::device);
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
    host.pixels = read_array<shared::FilmPixel>(gpu, film.pixels);
    host.moments = read_array<shared::FilmMoments>(gpu, film.moments);
    host.first_hits = read_array<shared::FilmFirstHit>(gpu, film.first_hits);
    return host;
}

std::uint64_t film_bytes(const FilmMemory& film) {
    return film.pixels.size + film.moments.size + film.first_hits.size;
}

std::uint64_t film_bytes(std::uint64_t pixels, std::uint32_t features) {
    return pixels * (sizeof(shared::FilmPixel) +
                     ((features & shared::FEATURE_STANDARD_ERROR) != 0 ? sizeof(shared::FilmMoments) : 0) +
                     ((features & shared::FEATURE_FIRST_HIT_LAYERS) != 0 ? sizeof(shared::FilmFirstHit) : 0));
}

}  // namespace diptych::core
