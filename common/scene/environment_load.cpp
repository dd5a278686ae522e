#include "scene/environment_load.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <system_error>
#include <vector>

#include "error.h"

namespace diptych {
namespace {

constexpr std::int64_t max_texels = std::int64_t{1} << 28;

void check_file(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) {
        throw Error(path.string() + ": environment map: no such file");
    }
    if (std::filesystem::is_directory(status)) {
        throw Error(path.string() + ": environment map: is a folder, not a file");
    }
    if (std::filesystem::file_size(path, error) == 0 && !error) {
        throw Error(path.string() + ": environment map: the file is empty");
    }
}

[[noreturn]] void fail_reading(const std::filesystem::path& path, std::string message) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    throw Error(path.string() + ": environment map: cannot be read: " + (message.empty() ? "unknown format" : message));
}

void add_line(std::string* lines, const std::string& line) {
    if (lines != nullptr) {
        *lines += (lines->empty() ? "" : "\n") + line;
    }
}

}  // namespace

Environment load_environment(const std::filesystem::path& path, std::string* warnings) {
    check_file(path);
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string());
    if (!input) {
        fail_reading(path, OIIO::geterror());
    }
    const OIIO::ImageSpec& spec = input->spec();
    const std::int64_t texels = std::int64_t{spec.width} * spec.height;
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.depth > 1 || texels > max_texels) {
        throw Error(path.string() + ": environment map: has a size of " + std::to_string(spec.width) + "x" +
                    std::to_string(spec.height) + "x" + std::to_string(spec.nchannels));
    }
    if (!spec.format.is_floating_point()) {
        throw Error(path.string() +
                    ": environment map: holds display values, not radiance: wants an .hdr or .exr file");
    }
    const int channels = spec.nchannels < 3 ? 1 : 3;
    std::vector<float> values(static_cast<std::size_t>(texels) * static_cast<std::size_t>(channels));
    if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data())) {
        fail_reading(path, input->geterror());
    }
    Environment environment;
    environment.kind = Environment::Kind::map;
    environment.width = spec.width;
    environment.height = spec.height;
    environment.texels.resize(static_cast<std::size_t>(texels));
    std::size_t bad = 0;
    for (std::size_t i = 0; i < environment.texels.size(); ++i) {
        const float* texel = values.data() + i * static_cast<std::size_t>(channels);
        bool clean = true;
        for (int c = 0; c < 3; ++c) {
            const float value = texel[channels == 1 ? 0 : c];
            const bool usable = std::isfinite(value) && value >= 0;
            environment.texels[i][c] = usable ? value : 0.0F;
            clean = clean && usable;
        }
        bad += clean ? 0 : 1;
    }
    if (bad > 0) {
        add_line(warnings, path.string() + ": environment map: " + std::to_string(bad) +
                               " texels are negative or not finite; set to 0");
    }
    if (spec.width != 2 * spec.height) {
        add_line(warnings, path.string() + ": environment map: " + std::to_string(spec.width) + "x" +
                               std::to_string(spec.height) + " is not twice as wide as high; it is stretched");
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

}  // namespace diptych
