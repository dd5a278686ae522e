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

/// How a film was made. Of a picture that was loaded, what its file tells; the rest has its default.
struct FilmInfo {
    std::string file;  // that it was loaded from; empty for one that was rendered
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

struct SaveOptions {
    bool sums = false;  // keep the exact sums in an .exr, so that it can be loaded, merged and gone on from
};

// The implementation's.
struct Impl;
struct FilmData;

/// A value: sums, second moments and first hits of all pixels, and what they develop to. Copies share memory. Arrays
/// are row-major, row 0 on top. A span is valid until the film is merged into, assigned or destroyed, or as long as a
/// copy.
class DIPTYCH_EXPORT Film {
public:
    /// A film that was saved with its sums comes back to the bit, with all that it knows of itself: by save, or by the
    /// program's `render --samples`, `render --sums` and `merge`. Any other picture is its radiance alone, with the
    /// standard error and the first-hit layers that an .exr has; it has no sums, and merges with nothing. The file may
    /// ask for `memory_limit` bytes; 0 is a quarter of the machine's memory. Throws Error.
    static Film load(const std::string& path, std::uint64_t memory_limit = 0);

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

    /// Whether the film has the sums of its samples: not where it was loaded from a picture without them.
    bool has_sums() const;
    /// width * height * 3: the sums that radiance() is the mean of. Throws Error where there are none.
    std::vector<double> sums() const;
    /// width * height: the samples in each sum. Throws Error where there are none.
    std::vector<std::uint32_t> sample_counts() const;

    /// An estimate of relMSE, mean of variance / (radiance² + 0.01), from the second moments; NaN without them.
    double relmse_estimate() const;

    /// Adds the other film's samples, exactly, as if this one had taken them too; the panels may differ. Throws Error,
    /// and changes nothing, where the two differ in scene, edits, moment, view, layers or settings other than the seed,
    /// have samples in common, or have no sums. Films of this process are of one scene where they are of one Scene; a
    /// film from a file is compared by its settings and the content of its scene.
    void merge(const Film& other);

    /// Writes .exr (all layers, float32), .hdr, or .png (tone-mapped). The file appears whole or not at all. Throws
    /// Error, also where sums are asked for that the film has not, or that are of more than one seed.
    void save(const std::string& path, const SaveOptions& options = {}) const;

private:
    friend struct Impl;
    explicit Film(std::shared_ptr<const FilmData> data);
    std::shared_ptr<const FilmData> data_;
};

struct MergeOptions {
    bool partial = false;  // samples may be missing
};

/// The films as one, in any order: the same bits as one render of all samples. Throws Error as Film::merge does, and,
/// unless `partial`, where a seed's samples do not go from 0 to the last one without a gap.
DIPTYCH_EXPORT Film merge(const std::vector<Film>& parts, const MergeOptions& options = {});

/// Width * height * 3 display values in [0, 1], as save writes them to a .png at exposure 0. `exposure` in stops.
DIPTYCH_EXPORT std::vector<float> tone_mapped(const Film& film, double exposure = 0);

DIPTYCH_END
