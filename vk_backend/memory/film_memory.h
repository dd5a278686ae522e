// The film on the device.
#pragma once

#include "memory/buffer.h"
#include "commands/recorder.h"
#include "render/film.h"
#include "memory/scene_addresses.h"

namespace diptych::core {

/// Row-major from the top. Buffers of layers that are left out are not allocated.
struct FilmMemory {
    int width = 0;
    int height = 0;
    Buffer pixels;
    Buffer moments;
    Buffer first_hits;
};

/// A film of zeros with the layers that `features` names.
FilmMemory make_film(const Gpu& gpu, int width, int height, std::uint32_t features);

/// Whether it is of that size and has the layers that `features` names, and no others.
bool fits(const FilmMemory& film, int width, int height, std::uint32_t features);

/// Records that the film becomes zeros again.
void record_clear(Recorder& recorder, const FilmMemory& film);

/// Enters the film's addresses.
void enter_film(SceneAddresses& addresses, const FilmMemory& film);

/// A copy on the host. Nothing may be in flight.
Film read_film(const Gpu& gpu, const FilmMemory& film);

std::uint64_t film_bytes(const FilmMemory& film);

}  // namespace diptych::core
