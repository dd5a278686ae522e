// What a session has rendered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "diptych/settings.h"

DIPTYCH_BEGIN

/// How a film was made.
struct FilmInfo {
    std::string scene;
    Backend backend = Backend::cpu;
    std::string device;
    Settings settings;
    std::uint32_t spp = 0;        // that every pixel has
    std::uint64_t samples = 0;    // averaged, over all pixels
    std::uint64_t nonfinite = 0;  // samples dropped as not finite or negative
    std::uint64_t rays = 0;
    double seconds = 0;  // of rendering
};

// The implementation's.
struct Impl;
struct FilmData;

/// A value: sums, second moments and first hits of all pixels, and what they develop to. Copies share memory. Arrays
/// are row-major, row 0 on top. A span is valid until the film is merged into, assigned or destroyed, or as long as a
/// copy.
class DIPTYCH_EXPORT Film {
public:
    int width() const;
    int height() const;
    const FilmInfo& info() const;

    /// width * height * 3: the mean radiance, W/(sr m²), linear Rec.709.
    std::span<const float> radiance() const;

    /// width * height * 3: the standard error of that mean. Empty where the settings kept no moments. NaN where a pixel
    /// has fewer than two samples. Of restir's pixels, which depend on one another, it is no measure of the error.
    std::span<const float> standard_error() const;

    /// "albedo" and "normal" (width * height * 3) or "depth" (width * height, metres): means of the first hit; empty
    /// where the settings kept none. Also "radiance" and "standard_error". Throws Error for another name.
    std::span<const float> layer(const std::string& name) const;

    /// width * height * 3: the sums that radiance() is the mean of.
    std::vector<double> sums() const;
    /// width * height: the samples in each sum.
    std::vector<std::uint32_t> sample_counts() const;

    /// An estimate of relMSE, mean of variance / (radiance² + 0.01), from the standard errors; NaN without them.
    double relmse_estimate() const;

    /// Adds the other film's samples, as if this one had taken them too; the backends may differ. Throws Error, and
    /// changes nothing, where the two differ in scene, edits, moment, view, layers or settings other than the seed, or
    /// have samples in common.
    void merge(const Film& other);

    /// Writes .exr (all layers, float32), .hdr, or .png (tone-mapped). The file appears whole or not at all. Throws
    /// Error.
    void save(const std::string& path) const;

private:
    friend struct Impl;
    explicit Film(std::shared_ptr<const FilmData> data);
    std::shared_ptr<const FilmData> data_;
};

/// Width * height * 3 display values in [0, 1], as save writes them to a .png at exposure 0. `exposure` in stops.
DIPTYCH_EXPORT std::vector<float> tone_mapped(const Film& film, double exposure = 0);

DIPTYCH_END
