// What the files of cases share.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <random>

#include "stability_cases.h"

namespace diptych::core::stability {

void add_microfacet_cases(std::vector<Case>& cases);
void add_surface_cases(std::vector<Case>& cases);
void add_geometry_cases(std::vector<Case>& cases);
void add_flattened_cases(std::vector<Case>& cases);
void add_sum_cases(std::vector<Case>& cases);
void add_ray_cases(std::vector<Case>& cases);
void add_light_scene_cases(std::vector<Case>& cases);
void add_film_scene_cases(std::vector<Case>& cases);

using glm::dvec3;

inline void take_vec3(MeasuredInput& p, std::size_t first, const dvec3& v) {
    for (int c = 0; c < 3; ++c) {
        p.x[first + static_cast<std::size_t>(c)] = static_cast<float>(v[c]);
    }
}

/// As the backend reads it: after its rounding to fp32.
inline dvec3 given_vec3(const MeasuredInput& p, std::size_t first) {
    return {double{p.x[first]}, double{p.x[first + 1]}, double{p.x[first + 2]}};
}

inline dvec3 result_vec3(const MeasuredOutput& o, std::size_t first) {
    return {double{o.y[first]}, double{o.y[first + 1]}, double{o.y[first + 2]}};
}

/// The unit direction with that cosine to z and azimuth; its sine is exact for tiny cosines and tiny sines alike.
inline dvec3 direction(double cosine, double azimuth) {
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

/// |value - truth| over |truth|, or over `floor` where that is larger.
inline double relative_error(double value, double truth, double floor = 0) {
    const double scale = std::max(std::abs(truth), floor);
    return scale > 0 ? std::abs(value - truth) / scale : std::abs(value - truth);
}

/// Keeps the worst of many.
inline void worsen(Measured& m, double error, const std::string& where) {
    if (!std::isfinite(error)) {
        ++m.nonfinite;
        if (m.where.empty()) {
            m.where = where;
        }
    } else if (error > m.error) {
        m.error = error;
        m.where = where;
    }
}

/// Multiples of 2^-24 in [0, 1), as the renderer's.
class Uniforms {
public:
    explicit Uniforms(std::uint32_t seed) : engine_(seed) {}
    double next() { return static_cast<double>(engine_() >> 8U) * 0x1p-24; }

private:
    std::mt19937 engine_;
};

}  // namespace diptych::core::stability
