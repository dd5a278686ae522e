// A picture in memory: float values, nothing else.
#pragma once

#include <cstddef>
#include <vector>

namespace diptych::core {

/// `height` rows of `width` pixels from the top left, `channels` interleaved floats a pixel.
/// What the values mean (linear radiance, display values, a scalar) is said by whoever hands the image over.
struct Image {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<float> data;

    size_t pixel_count() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
    size_t index(int x, int y, int channel) const {
        return (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)) *
                   static_cast<size_t>(channels) +
               static_cast<size_t>(channel);
    }
    float& at(int x, int y, int channel) { return data[index(x, y, channel)]; }
    float at(int x, int y, int channel) const { return data[index(x, y, channel)]; }

    bool same_shape(const Image& other) const {
        return width == other.width && height == other.height && channels == other.channels;
    }
};

inline Image make_image(int width, int height, int channels, float fill = 0.0f) {
    Image image{width, height, channels, {}};
    image.data.assign(image.pixel_count() * static_cast<size_t>(channels), fill);
    return image;
}

}  // namespace diptych::core
