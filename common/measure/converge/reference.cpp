#include "measure/converge/reference.h"

#include <cmath>
#include <charconv>

#include "error.h"

namespace diptych::core {

namespace {

/// 0 where the picture does not say.
std::uint32_t sample_count(const std::string& text, const std::string& picture) {
    std::uint32_t count = 0;
    const char* end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, count);
    if (!text.empty() && (failure != std::errc() || stop != end)) {
        throw Error(picture + ": its metadata spp is '" + text.substr(0, 40) + "', not a number of samples");
    }
    return count;
}

}  // namespace

ReferencePicture reference_of(LayeredImage image, std::string method) {
    ReferencePicture reference;
    reference.method = std::move(method);
    reference.variance.assign(image.color.data.size(), 0);
    reference.variance_known = image.standard_error.has_value();
    for (std::size_t i = 0; reference.variance_known && i < reference.variance.size(); ++i) {
        const float error = image.standard_error->data[i];
        reference.variance[i] = std::isfinite(error) ? error * error : 0;
    }
    for (const float value : image.color.data) {
        reference.weights.push_back(1 / (value * value + 1e-2F));
    }
    const auto entry = [&](const char* name) {
        const auto found = image.metadata.find(name);
        return found == image.metadata.end() ? std::string() : found->second;
    };
    reference.command = entry("command");
    reference.spp = sample_count(entry("spp"), reference.method);
    reference.image = std::move(image);
    return reference;
}

ReferenceNoise noise_of(const ReferencePicture& reference) {
    ReferenceNoise noise;
    const std::vector<float>& color = reference.image.color.data;
    const double values = static_cast<double>(color.size()), pixels = values / 3;
    for (std::size_t i = 0; i < color.size(); i += 3) {
        double pixel = 0, relative = 0;
        for (std::size_t channel = i; channel < i + 3; ++channel) {
            pixel += reference.variance[channel] / 3.0;
            relative += reference.variance[channel] * reference.weights[channel] / 3.0;
            noise.mean += color[channel] / values;
        }
        noise.mse += pixel / pixels;
        noise.relmse += relative / pixels;
        noise.mse_error += 2 * pixel * pixel;
        noise.relmse_error += 2 * relative * relative;
    }
    noise.mse_error = std::sqrt(noise.mse_error) / pixels;
    noise.relmse_error = std::sqrt(noise.relmse_error) / pixels;
    return noise;
}

}  // namespace diptych::core
