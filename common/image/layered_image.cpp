#include "image/layered_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "error.h"

namespace diptych {
namespace {

constexpr const char* metadata_prefix = "diptych:";

struct Layer {
    const char* name;
    std::optional<Image> LayeredImage::*image;
    std::vector<std::string> channels;
};

const std::array<Layer, 4>& optional_layers() {
    static const std::array<Layer, 4> layers = {{
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
    for (size_t pixel = 0; pixel < to.pixel_count(); ++pixel)
        to.data[pixel * to_stride + to_channel] = from.data[pixel * from_stride + from_channel];
}

/// The named channels as an image of their own; nothing if one of them is missing.
std::optional<Image> extract(const RawImage& raw, const std::vector<std::string>& names) {
    std::vector<size_t> sources;
    for (const std::string& name : names) {
        const auto found = std::find(raw.channel_names.begin(), raw.channel_names.end(), name);
        if (found == raw.channel_names.end())
            return std::nullopt;
        sources.push_back(static_cast<size_t>(found - raw.channel_names.begin()));
    }
    Image image = make_image(raw.image.width, raw.image.height, static_cast<int>(names.size()));
    for (size_t channel = 0; channel < sources.size(); ++channel)
        copy_channel(raw.image, sources[channel], image, channel);
    return image;
}

Image extract_color(const std::filesystem::path& path, const RawImage& raw) {
    if (std::optional<Image> color = extract(raw, color_channels))
        return std::move(*color);
    const bool has_luminance =
        std::find(raw.channel_names.begin(), raw.channel_names.end(), "Y") != raw.channel_names.end();
    if (has_luminance || raw.image.channels == 1) {
        const std::string grey = has_luminance ? "Y" : raw.channel_names.front();
        return *extract(raw, {grey, grey, grey});
    }
    std::string found;
    for (const std::string& name : raw.channel_names)
        found += (found.empty() ? "" : ", ") + name;
    throw Error(path.string() + ": cannot read: it has neither channels R, G, B nor Y (found " + found + ")");
}

}  // namespace

float srgb_decoded(float encoded) {
    const double value = encoded;
    return static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
}

void write_exr(const std::filesystem::path& path, const LayeredImage& layers) {
    struct Part {
        const Image* image;
        const std::vector<std::string>* names;
    };
    std::vector<Part> parts = {{&layers.color, &color_channels}};
    const auto require = [&](const char* name, const Image& image, size_t channels) {
        const Image expected{layers.color.width, layers.color.height, static_cast<int>(channels), {}};
        if (!image.same_shape(expected) || image.data.size() != image.pixel_count() * channels)
            throw Error(path.string() + ": cannot write: the layer '" + name + "' is " + shape_text(image) + ", not " +
                        shape_text(expected));
    };
    require("colour", layers.color, color_channels.size());
    for (const Layer& layer : optional_layers()) {
        const std::optional<Image>& image = layers.*layer.image;
        if (!image)
            continue;
        require(layer.name, *image, layer.channels.size());
        parts.push_back({&*image, &layer.channels});
    }

    std::vector<std::string> names;
    for (const Part& part : parts)
        names.insert(names.end(), part.names->begin(), part.names->end());
    Image all = make_image(layers.color.width, layers.color.height, static_cast<int>(names.size()));
    size_t channel = 0;
    for (const Part& part : parts)
        for (size_t source = 0; source < part.names->size(); ++source)
            copy_channel(*part.image, source, all, channel++);

    std::map<std::string, std::string> attributes;
    for (const auto& [name, value] : layers.metadata)
        if (!value.empty())
            attributes[metadata_prefix + name] = value;
    write_exr_channels(path, all, names, attributes);
}

LayeredImage read_image(const std::filesystem::path& path) {
    const RawImage raw = read_raw(path);
    LayeredImage layers;
    layers.color = extract_color(path, raw);
    if (raw.srgb_encoded)
        for (float& value : layers.color.data)
            value = srgb_decoded(value);
    for (const Layer& layer : optional_layers())
        layers.*layer.image = extract(raw, layer.channels);
    const std::string prefix = metadata_prefix;
    for (const auto& [name, value] : raw.attributes)
        if (name.compare(0, prefix.size(), prefix) == 0)
            layers.metadata[name.substr(prefix.size())] = value;
    return layers;
}

}  // namespace diptych
