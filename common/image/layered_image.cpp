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

void write_exr(const std::filesystem::path& path, const LayeredImage& layers, const WordChannels* words) {
    struct Part {
        const Image* image;
        const std::vector<std::string>* names;
    };
    std::vector<Part> parts = {{&layers.color, &color_channels}};
    const auto require = [&](const char* name, const Image& image, size_t channels) {
        const Image expected{layers.color.width, layers.color.height, static_cast<int>(channels), {}};
        if (!image.same_shape(expected) || image.data.size() != image.pixel_count() * channels) {
            throw Error(path.string() + ": cannot write: the layer '" + name + "' is " + shape_text(image) + ", not " +
                        shape_text(expected));
        }
    };
    require("colour", layers.color, color_channels.size());
    for (const OptionalLayer& layer : optional_layers()) {
        const std::optional<Image>& image = layers.*layer.image;
        if (!image) {
            continue;
        }
        require(layer.name, *image, layer.channels.size());
        parts.push_back({&*image, &layer.channels});
    }

    std::vector<std::string> names;
    for (const Part& part : parts) {
        names.insert(names.end(), part.names->begin(), part.names->end());
    }
    Image all = make_image(layers.color.width, layers.color.height, static_cast<int>(names.size()));
    in_parts(all.pixel_count(), [&](size_t begin, size_t end) {
        float* to = all.data.data() + begin * names.size();
        for (size_t pixel = begin; pixel < end; ++pixel) {
            for (const Part& part : parts) {
                const size_t channels = part.names->size();
                to = std::copy_n(part.image->data.data() + pixel * channels, channels, to);
            }
        }
    });

    std::map<std::string, std::string> attributes;
    for (const auto& [name, value] : layers.metadata) {
        if (!value.empty()) {
            attributes[metadata_prefix + name] = value;
        }
    }
    if (words != nullptr) {
        attributes[word_digest_attribute] = words_digest(*words);
    }
    write_exr_channels(path, all, names, attributes, words);
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
