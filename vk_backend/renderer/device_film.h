// A film on the device, for display. Its contents stay unchanged while they are read, whatever the renderer does.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "memory/film_memory.h"
#include "passes/resampling_passes.h"
#include "memory/upload.h"

namespace diptych::core {

struct DeviceFilm {
    std::shared_ptr<const Gpu> gpu;                      // device that owns the memory; it outlives the film
    std::shared_ptr<const FilmMemory> film;              // null if there is no film yet
    std::shared_ptr<const ResamplingMemory> resampling;  // null if there are no reservoirs
    std::uint32_t reservoir_set = 0;                     // the set written by the last frame
};

/// Uploads pictures that were rendered on the host. For one thread at a time.
class FilmUploader {
public:
    explicit FilmUploader(std::shared_ptr<Gpu> gpu) : gpu_(std::move(gpu)) {}

    /// Copies the film and waits. A film with the size and layers of the previous call overwrites that one in place; a
    /// concurrent reader sees the old or the new value of each pixel.
    DeviceFilm upload(const Film& film);

private:
    std::shared_ptr<Gpu> gpu_;
    std::unique_ptr<Uploader> uploader_;  // created for the first film
    std::shared_ptr<FilmMemory> film_;
};

}  // namespace diptych::core
