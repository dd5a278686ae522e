#include "image/image_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "error.h"
#include "image/atomic_file.h"
#include "image/image_library.h"
#include "threads.h"

namespace diptych::core {
namespace {

namespace fs = std::filesystem;

std::string lower_extension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

void require_shape(const fs::path& path, const Image& image, bool shape_is_known) {
    const bool positive = image.width > 0 && image.height > 0 && image.channels > 0;
    if (positive && shape_is_known && image.data.size() == image.pixel_count() * static_cast<size_t>(image.channels)) {
        return;
    }
    throw Error(path.string() + ": cannot write: the image of " + std::to_string(image.width) + "x" +
                std::to_string(image.height) + " pixels with " + std::to_string(image.channels) + " channels and " +
                std::to_string(image.data.size()) + " values has the wrong shape for this file");
}

/// Names the file where the library is missing, or fails at its work.
template <typename Work>
auto with_library(const fs::path& path, const Work& work) {
    try {
        return work(image_library());
    } catch (const std::runtime_error& error) {
        throw Error(path.string() + ": cannot write: " + error.what());
    }
}

/// `encode` gives the bytes of the file.
template <typename Encode>
void encode_and_write(const fs::path& path, const Encode& encode) {
    const ImageLibrary::Bytes bytes = with_library(path, encode);
    write_file_atomically(path, bytes);
}

}  // namespace

ImageFormat image_format(const fs::path& path) {
    const std::string extension = lower_extension(path);
    if (extension == ".exr") {
        return ImageFormat::Exr;
    }
    if (extension == ".png") {
        return ImageFormat::Png;
    }
    if (extension == ".hdr") {
        return ImageFormat::Hdr;
    }
    throw Error(path.string() + ": cannot write: unknown extension '" + extension + "' (known: .exr, .png, .hdr)");
}

void check_writable(const fs::path& path) {
    const ImageFormat format = image_format(path);
    check_file_can_be_created(path);
    if (format != ImageFormat::Exr) {  // which this project writes itself
        with_library(path, [](const ImageLibrary&) {});
    }
}

void write_exr_picture(const fs::path& path, const ExrPicture& picture, const WriteBehind& behind) {
    TemporaryFile file(path);
    write_exr_file(picture, file);
    if (behind) {
        behind(file);
    }
    file.sync();
    file.publish();
}

void write_exr_channels(const fs::path& path, const Image& image, const std::vector<std::string>& channel_names,
                        const std::map<std::string, std::string>& attributes) {
    require_shape(path, image, channel_names.size() == static_cast<size_t>(image.channels));
    const auto rows = [&](int first, int count, std::span<float> values) {
        const size_t row = static_cast<size_t>(image.width) * static_cast<size_t>(image.channels);
        std::copy_n(&image.data[static_cast<size_t>(first) * row], static_cast<size_t>(count) * row, values.data());
    };
    write_exr_picture(path, {image.width, image.height, channel_names, attributes, ExrCompression::zip, rows});
}

std::vector<unsigned char> png_bytes(const fs::path& path, const Image& display_values) {
    require_shape(path, display_values, display_values.channels == 1 || display_values.channels == 3);
    ByteImage codes{display_values.width, display_values.height, display_values.channels, {}};
    codes.data.resize(display_values.data.size());
    in_parts(codes.data.size(), [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const float value = display_values.data[i];
            const float clamped = value > 0.0f ? std::min(value, 1.0f) : 0.0f;
            codes.data[i] = static_cast<std::uint8_t>(std::lround(clamped * 255.0f));
        }
    });
    return with_library(path, [&](const ImageLibrary& library) { return library.encode_png(codes, true); });
}

void write_png(const fs::path& path, const Image& display_values) {
    write_file_atomically(path, png_bytes(path, display_values));
}

void write_hdr(const fs::path& path, const Image& linear_rgb) {
    require_shape(path, linear_rgb, linear_rgb.channels == 3);
    const float largest = std::ldexp(255.0f / 256.0f, 127);
    Image values = linear_rgb;
    for (float& value : values.data) {
        value = value > 0.0f ? std::min(value, largest) : 0.0f;
    }
    encode_and_write(path, [&](const ImageLibrary& library) { return library.encode_hdr(values); });
}

}  // namespace diptych::core
