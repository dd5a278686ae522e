#include "image/layered_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "error.h"
#include "threads.h"

namespace diptych::core {
namespace {

constexpr const char* metadata_prefix = "diptych:";

struct OptionalLayer {
    const char* name;
    std::optional<Image> LayeredImage::*image;
    std::vector<std::string> channels;
};

const std::array<OptionalLayer, 4>& optional_layers() {
    static const std::array<OptionalLayer, 4> layers = {{
        {"standard error", &LayeredImage::standard_error, {"stderr.R", "stderr.G", "stderr.B"}},
        {"albedo", &LayeredImage::albedo, {"albedo.R", "albedo.G", "albedo.B"}},
        {"normal", &LayeredImage::normal, {"normal.X", "normal.Y", "normal.Z"}},
        {"depth", &LayeredImage::depth, {"depth.Z"}},
    }};
    return layers;
}

const std::vector<std::string> color_channels = {"R", "G", "B"};

std::string shape_text(const Image& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height) + "x" + std::to_string(image.channels);
}

void copy_channel(const Image& from, size_t from_channel, Image& to, size_t to_channel) {
    const size_t from_stride = static_cast<size_t>(from.channels);
    const size_t to_stride = static_cast<size_t>(to.channels);
    for (size_t pixel = 0; pixel < to.pixel_count(); ++pixel) {
        to.data[pixel * to_stride + to_channel] = from.data[pixel * from_stride + from_channel];
    }
}

Image extract(const RawImage& raw, const std::vector<size_t>& sources) {
    Image image = make_image(raw.image.width, raw.image.height, static_cast<int>(sources.size()));
    for (size_t channel = 0; channel < sources.size(); ++channel) {
        copy_channel(raw.image, sources[channel], image, channel);
    }
    return image;
}

/// The named channels as an image of their own; nothing if one of them is missing.
std::optional<Image> extract(const RawImage& raw, const std::vector<std::string>& names) {
    std::vector<size_t> sources;
    for (const std::string& name : names) {
        const auto found = std::find(raw.channel_names.begin(), raw.channel_names.end(), name);
        if (found == raw.channel_names.end()) {
            return std::nullopt;
        }
        sources.push_back(static_cast<size_t>(found - raw.channel_names.begin()));
    }
    return extract(raw, sources);
}

}  // namespace

float srgb_decoded(float encoded) {
    const double value = encoded;
    return static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
}

namespace {

struct PresentLayer {
    const char* name;
    const Image* image;
    const std::vector<std::string>* channels;
};

/// In the order of the file's channels.
std::vector<PresentLayer> layers_in(const LayeredImage& picture) {
    std::vector<PresentLayer> layers = {{"colour", &picture.color, &color_channels}};
    for (const OptionalLayer& layer : optional_layers()) {
        if (const std::optional<Image>& image = picture.*layer.image) {
            layers.push_back({layer.name, &*image, &layer.channels});
        }
    }
    return layers;
}

std::vector<std::string> channels_in(const LayeredImage& picture) {
    std::vector<std::string> names;
    for (const PresentLayer& layer : layers_in(picture)) {
        names.insert(names.end(), layer.channels->begin(), layer.channels->end());
    }
    return names;
}

void require_layers(const std::filesystem::path& path, const LayeredImage& picture) {
    for (const PresentLayer& layer : layers_in(picture)) {
        const size_t channels = layer.channels->size();
        const Image expected{picture.color.width, picture.color.height, static_cast<int>(channels), {}};
        if (!layer.image->same_shape(expected) || layer.image->data.size() != layer.image->pixel_count() * channels) {
            throw Error(path.string() + ": cannot write: the layer '" + layer.name + "' is " +
                        shape_text(*layer.image) + ", not " + shape_text(expected));
        }
    }
}

/// All channels of `count` pixels, from pixel `first` on.
void interleave(const LayeredImage& picture, size_t first, size_t count, float* values) {
    const std::vector<PresentLayer> layers = layers_in(picture);
    const size_t stride = channels_in(picture).size();
    in_parts(count, [&](size_t begin, size_t end) {
        float* to = values + begin * stride;
        for (size_t pixel = first + begin; pixel < first + end; ++pixel) {
            for (const PresentLayer& layer : layers) {
                const size_t channels = layer.channels->size();
                to = std::copy_n(layer.image->data.data() + pixel * channels, channels, to);
            }
        }
    });
}

std::map<std::string, std::string> attributes_of(const std::map<std::string, std::string>& metadata) {
    std::map<std::string, std::string> attributes;
    for (const auto& [name, value] : metadata) {
        if (!value.empty()) {
            attributes[metadata_prefix + name] = value;
        }
    }
    return attributes;
}

}  // namespace

void write_exr(const std::filesystem::path& path, const LayeredImage& layers) {
    require_layers(path, layers);
    const auto rows = [&](int first, int count, std::span<float> values) {
        const auto width = static_cast<size_t>(layers.color.width);
        interleave(layers, static_cast<size_t>(first) * width, static_cast<size_t>(count) * width, values.data());
    };
    write_exr_picture(path, {layers.color.width, layers.color.height, channels_in(layers), attributes_of(layers.metadata),
                             ExrCompression::zip, rows});
}

void write_exr(const std::filesystem::path& path, const GrowingImage& image, const WriteBehind& behind) {
    const auto rows = [&](int first, int count, std::span<float> values) {
        const LayeredImage band = image.band(first, count);
        interleave(band, 0, band.color.pixel_count(), values.data());
    };
    write_exr_picture(path, {image.width, image.height, channels_in(image.band(0, 1)), attributes_of(image.metadata),
                             image.compression, rows},
                      behind);
}

namespace {

std::map<std::string, std::string> metadata_of(const std::map<std::string, std::string>& attributes) {
    const std::string prefix = metadata_prefix;
    std::map<std::string, std::string> metadata;
    for (const auto& [name, value] : attributes) {
        if (name.compare(0, prefix.size(), prefix) == 0) {
            metadata[name.substr(prefix.size())] = value;
        }
    }
    return metadata;
}

}  // namespace

std::map<std::string, std::string> read_metadata(const std::filesystem::path& path) {
    return metadata_of(read_attributes(path));
}

Image linear_color(const RawImage& raw) {
    const bool grey = raw.color.size() == 1;
    std::vector<size_t> sources;
    for (size_t channel = 0; channel < 3; ++channel) {
        sources.push_back(static_cast<size_t>(raw.color[grey ? 0 : channel]));
    }
    Image color = extract(raw, sources);
    if (raw.srgb_encoded) {
        for (float& value : color.data) {
            value = srgb_decoded(value);
        }
    }
    if (raw.xyz) {
        convert_color(color, xyz_to_rec709(raw.chromaticities->white));
    } else if (!grey && raw.chromaticities && !same_chromaticities(*raw.chromaticities, rec709)) {
        convert_color(color, to_rec709(*raw.chromaticities));
    }
    return color;
}

LayeredImage read_image(const std::filesystem::path& path, const std::string& layer, std::uint64_t memory_limit) {
    std::vector<std::string> beside;
    if (layer.empty()) {
        for (const OptionalLayer& optional_layer : optional_layers()) {
            beside.insert(beside.end(), optional_layer.channels.begin(), optional_layer.channels.end());
        }
    }
    const RawImage raw = read_raw(path, layer, beside, memory_limit);
    LayeredImage layers;
    layers.color = linear_color(raw);
    if (layer.empty()) {
        for (const OptionalLayer& optional_layer : optional_layers()) {
            layers.*optional_layer.image = extract(raw, optional_layer.channels);
        }
    }
    layers.metadata = metadata_of(raw.attributes);
    layers.display = raw.display;
    layers.data = raw.data;
    layers.layer = raw.layer;
    return layers;
}

}  // namespace diptych::core
