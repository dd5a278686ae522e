// How far one render is from the reference.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "measure/converge/reference.h"
#include "render/film.h"

namespace diptych::core {

/// One render's errors against the reference once it had so many samples a pixel: a line of results.csv.
struct ErrorRow {
    std::string method;
    std::uint32_t run = 0;
    std::uint32_t seed = 0;
    std::uint32_t spp = 0;
    double device_seconds = 0;  // since the run's first sample: timestamps on a GPU, wall clock on the CPU
    double wall_seconds = 0;    // by a steady clock, around the same calls
    double mse = 0;
    double relmse = 0;
    double relmse_trimmed = 0;
    double trimmed_energy = 0;
    std::uint64_t nonfinite = 0;  // samples dropped so far
    std::uint64_t rays = 0;
};

/// Without the render's name and times.
ErrorRow errors_of(const Film& film, const ReferencePicture& reference);

/// Every value less the reference's.
std::vector<float> deviations_of(const Film& film, const ReferencePicture& reference);

}  // namespace diptych::core
