// What resampling keeps between its passes, on the CPU.
#pragma once

#include <cassert>
#include <cstdint>
#include <vector>

#include "render/resampling_schedule.h"

namespace diptych::core {

/// Sets of whole films, one after another; empty for integrators that do not resample.
struct ResamplingFilms {
    std::size_t pixels = 0;
    std::vector<shared::FirstVertex> first_vertices;
    std::vector<shared::Reservoir> reservoirs;
    std::vector<shared::ReuseSurface> surfaces;

    ResamplingFilms() = default;
    explicit ResamplingFilms(const shared::RenderConstants& constants)
        : pixels(std::size_t{constants.size.x} * constants.size.y) {
        const ResamplingSets sets = resampling_sets(constants);
        first_vertices.resize(pixels * sets.first_vertices);
        reservoirs.resize(pixels * sets.reservoirs);
        surfaces.resize(pixels * sets.surfaces);
    }

    std::uint64_t bytes() const {
        return first_vertices.size() * sizeof(shared::FirstVertex) + reservoirs.size() * sizeof(shared::Reservoir) +
               surfaces.size() * sizeof(shared::ReuseSurface);
    }
};

}  // namespace diptych::core
