// The film on the device.
#pragma once

#include "memory/buffer.h"
#include "commands/recorder.h"
#include "render/film.h"
#include "memory/scene_addresses.h"

namespace diptych::core {

/// Pixels in rows, top row first, as film_layout.h has them. Buffers of layers that are not rendered are not allocated.
struct FilmMemory {
    int width = 0;
    int height = 0;
    Buffer pixels;
    Buffer moments;
    Buffer first_hits;
};

/// Creates a film of zeros with the layers that `features` names.
FilmMemory make_film(const Gpu& gpu, int width, int height, std::uint32_t features);

/// Whether the film has that size and exactly the layers that `features` names.
bool fits(const FilmMemory& film, int width, int height, std::uint32_t features);

/// Records commands that set the film to zero.
void record_clear(Recorder& recorder, const FilmMemory& film);

/// Writes the film's addresses into the block.
void enter_film(SceneAddresses& addresses, const FilmMemory& film);

/// Copies the film to the host. Nothing may be in flight.
Film read_film(const Gpu& gpu, const FilmMemory& film);

/// The words of an array of film structs as they lie on the device.
template <class Struct>
std::vector<std::uint32_t> device_words(const std::vector<Struct>& structs);

std::uint64_t film_bytes(const FilmMemory& film);

/// Bytes of a film of so many pixels.
std::uint64_t film_bytes(std::uint64_t pixels, std::uint32_t features);

}  // namespace diptych::core
