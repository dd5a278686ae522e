#include "image/image_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "error.h"
#include "image/atomic_file.h"

namespace diptych {
namespace {

namespace fs = std::filesystem;

std::string first_line(const std::string& text) {
    const std::string line = text.substr(0, text.find('\n'));
    return line.empty() ? "unknown reason" : line;
}

std::string lower_extension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

void require_shape(const fs::path& path, const Image& image, bool shape_is_known) {
    const bool positive = image.width > 0 && image.height > 0 && image.channels > 0;
    if (positive && shape_is_known && image.data.size() == image.pixel_count() * static_cast<size_t>(image.channels))
        return;
    throw Error(path.string() + ": cannot write: the image of " + std::to_string(image.width) + "x" +
                std::to_string(image.height) + " pixels with " + std::to_string(image.channels) + " channels and " +
                std::to_string(image.data.size()) + " values has the wrong shape for this file");
}

/// Encodes in memory, because then every failed write to the disk is seen, whatever the format's library checks.
void encode_and_write(const fs::path& path, const char* format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                      const void* pixels) {
    const auto fail = [&](const std::string& reason) {
        throw Error(path.string() + ": cannot write: " + first_line(reason));
    };
    OIIO::Filesystem::IOVecOutput memory;
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    if (!output)
        fail(OIIO::geterror());
    if (!output->set_ioproxy(&memory))
        fail("OpenImageIO cannot encode " + std::string(format) + " in memory");
    if (!output->open(std::string("memory.") + format, spec))
        fail(output->geterror());
    if (!output->write_image(type, pixels))
        fail(output->geterror());
    if (!output->close())
        fail(output->geterror());
    write_file_atomically(path, memory.buffer());
}

}  // namespace

ImageFormat image_format(const fs::path& path) {
    const std::string extension = lower_extension(path);
    if (extension == ".exr")
        return ImageFormat::Exr;
    if (extension == ".png")
        return ImageFormat::Png;
    if (extension == ".hdr")
        return ImageFormat::Hdr;
    throw Error(path.string() + ": cannot write: unknown extension '" + extension + "' (known: .exr, .png, .hdr)");
}

void check_writable(const fs::path& path) {
    image_format(path);
    check_file_can_be_created(path);
}

void write_exr_channels(const fs::path& path, const Image& image, const std::vector<std::string>& channel_names,
                        const std::map<std::string, std::string>& attributes) {
    require_shape(path, image, channel_names.size() == static_cast<size_t>(image.channels));
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeFloat);
    spec.channelnames = channel_names;
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", "");  // else the time of writing: equal pictures are to be equal files
    for (const auto& [name, value] : attributes)
        spec.attribute(name, value);
    encode_and_write(path, "exr", spec, OIIO::TypeFloat, image.data.data());
}

void write_png(const fs::path& path, const Image& display_values) {
    require_shape(path, display_values, display_values.channels == 1 || display_values.channels == 3);
    std::vector<unsigned char> codes(display_values.data.size());
    std::transform(display_values.data.begin(), display_values.data.end(), codes.begin(), [](float value) {
        const float clamped = value > 0.0f ? std::min(value, 1.0f) : 0.0f;
        return static_cast<unsigned char>(std::lround(clamped * 255.0f));
    });
    OIIO::ImageSpec spec(display_values.width, display_values.height, display_values.channels, OIIO::TypeUInt8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    encode_and_write(path, "png", spec, OIIO::TypeUInt8, codes.data());
}

void write_hdr(const fs::path& path, const Image& linear_rgb) {
    require_shape(path, linear_rgb, linear_rgb.channels == 3);
    const float largest = std::ldexp(255.0f / 256.0f, 127);
    std::vector<float> values(linear_rgb.data.size());
    std::transform(linear_rgb.data.begin(), linear_rgb.data.end(), values.begin(),
                   [&](float value) { return value > 0.0f ? std::min(value, largest) : 0.0f; });
    const OIIO::ImageSpec spec(linear_rgb.width, linear_rgb.height, 3, OIIO::TypeFloat);
    encode_and_write(path, "hdr", spec, OIIO::TypeFloat, values.data());
}

}  // namespace diptych
