// The picture that errors are measured against, and how well it is known itself.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "image/layered_image.h"

namespace diptych::core {

struct ReferencePicture {
    LayeredImage image;           // with standard errors, where they are known
    std::vector<float> variance;  // of every value: standard error squared; zeros where unknown
    std::vector<float> weights;   // 1 / (r² + 1e-2)
    bool variance_known = false;
    std::string method;     // a file, or what rendered it
    std::uint32_t spp = 0;  // 0: unknown
    std::string command;    // empty: unknown
};

/// Of the reference's noise: what it adds to the MSE and the relMSE of everything on average, and how far the actual
/// noise may be from that average. The second is sqrt(sum of 2 V²)/N over the pixels, V the variance of a pixel's mean
/// over its channels, as for normal noise.
struct ReferenceNoise {
    double mse = 0;
    double relmse = 0;
    double mse_error = 0;
    double relmse_error = 0;
    double mean = 0;  // of the reference itself, over pixels and channels
};
ReferenceNoise noise_of(const ReferencePicture& reference);

/// Of a picture with three channels, all finite; its layer of standard errors is its variance, and its metadata say how
/// it was made. `method`: a file, or what rendered it.
ReferencePicture reference_of(LayeredImage image, std::string method);

/// The same of a picture that a user names. Throws Error where it has another size, or is not whole and finite.
ReferencePicture checked_reference(LayeredImage image, const std::string& name, int width, int height);

/// And of a file. Throws Error.
ReferencePicture load_reference(const std::string& path, int width, int height, std::uint64_t memory_limit);

}  // namespace diptych::core
