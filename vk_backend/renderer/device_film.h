// A film on the device, for whoever shows it: what it holds stays while it is being read, whatever its renderer does
// meanwhile.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "memory/film_memory.h"
#include "passes/resampling_passes.h"
#include "memory/upload.h"

namespace diptych::core {

struct DeviceFilm {
    std::shared_ptr<const Gpu> gpu;                      // that it lies on, and that outlives it
    std::shared_ptr<const FilmMemory> film;              // null: nothing yet
    std::shared_ptr<const ResamplingMemory> resampling;  // null: no reservoirs yet, or none at all
    std::uint32_t reservoir_set = 0;                     // that the last frame left
};

/// Puts pictures that a host has made on the device. One thread at a time.
class FilmUploader {
public:
    explicit FilmUploader(std::shared_ptr<Gpu> gpu) : gpu_(std::move(gpu)) {}

    /// Copies and waits. A film of the size and layers of the call before takes its place, in the same memory: who is
    /// reading that reads one or the other in each pixel.
    DeviceFilm upload(const Film& film);

private:
    std::shared_ptr<Gpu> gpu_;
    std::unique_ptr<Uploader> uploader_;  // made at the first film
    std::shared_ptr<FilmMemory> film_;
};

}  // namespace diptych::core
