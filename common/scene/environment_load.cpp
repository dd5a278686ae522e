#include "scene/environment_load.h"

#include <fmt/format.h>

#include <cmath>

#include "error.h"
#include "image/layered_image.h"
#include "image/picture_name.h"

namespace diptych::core {
namespace {

RawImage read_map(const PictureName& name, std::uint64_t memory_limit) {
    try {
        return read_raw(name.file, name.layer, {}, memory_limit);
    } catch (const Error& error) {
        throw Error(std::string("environment map ") + error.what());
    }
}

/// The texels of a map of three channels, negative ones as 0; their number in `negative`.
std::vector<glm::vec3> radiance_of(const Image& color, std::size_t& negative, const std::string& what,
                                   const RawImage& raw) {
    std::vector<glm::vec3> texels(color.pixel_count());
    for (std::size_t i = 0; i < texels.size(); ++i) {
        bool is_negative = false;
        for (int c = 0; c < 3; ++c) {
            const float value = color.data[3 * i + static_cast<std::size_t>(c)];
            if (!std::isfinite(value)) {
                const std::size_t channel = static_cast<std::size_t>(raw.color[raw.color.size() == 1 ? 0 : c]);
                const std::size_t width = static_cast<std::size_t>(color.width);
                throw Error(fmt::format("{}: texel {},{} (from the top left), channel {}: {} is no radiance", what,
                                        i % width, i / width, raw.channel_names[channel], value));
            }
            texels[i][c] = std::fmax(value, 0.0F);
            is_negative = is_negative || value < 0;
        }
        negative += is_negative ? 1 : 0;
    }
    return texels;
}

}  // namespace

Environment load_environment(const std::string& name, std::string* warnings, std::uint64_t memory_limit) {
    const PictureName picture = picture_name(name);
    const std::string what = "environment map " + name;
    const auto warn = [&](const std::string& line) {
        if (warnings != nullptr) {
            *warnings += (warnings->empty() ? "" : "\n") + what + ": " + line;
        }
    };
    const RawImage raw = read_map(picture, memory_limit);
    if (raw.integer) {
        throw Error(what + ": holds display values, not radiance: wants an .hdr or .exr file");
    }
    const Image color = linear_color(raw);
    std::size_t negative = 0;
    Environment environment;
    environment.kind = Environment::Kind::map;
    environment.width = color.width;
    environment.height = color.height;
    environment.texels = radiance_of(color, negative, what, raw);
    if (!raw.layer.empty()) {
        warn("the picture is its layer '" + raw.layer + "'");
    }
    if (negative > 0) {
        warn(std::to_string(negative) + " texels are negative in Rec.709; set to 0");
    }
    if (color.width != 2 * color.height) {
        warn(fmt::format("{}x{} is not twice as wide as high; it is stretched", color.width, color.height));
    }
    return environment;
}

Environment neutral_sky() {
    Environment environment;
    environment.kind = Environment::Kind::constant;
    const glm::vec3 tint(0.85F, 1.0F, 1.25F);
    environment.scale = tint / glm::dot(tint, glm::vec3(0.2126F, 0.7152F, 0.0722F));
    return environment;
}

}  // namespace diptych::core
