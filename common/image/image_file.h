// Image files of every kind Diptych reads and writes, over OpenImageIO.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "image/image.h"

namespace diptych {

enum class ImageFormat { Exr, Png, Hdr };

/// By extension, in any case; an Error lists the known ones.
ImageFormat image_format(const std::filesystem::path& path);

/// Refuses, before the work starts, an output whose extension is unknown or whose folder is missing or cannot be
/// written to. Leaves nothing behind.
void check_writable(const std::filesystem::path& path);

/// The channels of a file by name, as they are stored there: integers scaled to [0, 1], not decoded.
struct RawImage {
    Image image;
    std::vector<std::string> channel_names;
    bool srgb_encoded = false;                      // integer files that are not marked as linear
    std::map<std::string, std::string> attributes;  // string attributes
};

/// First part of any file that OpenImageIO reads. Throws an Error naming file and reason.
RawImage read_raw(const std::filesystem::path& path);

/// float32, zip-compressed, one part. Channel i of the image gets channel_names[i].
void write_exr_channels(const std::filesystem::path& path, const Image& image,
                        const std::vector<std::string>& channel_names,
                        const std::map<std::string, std::string>& attributes);

/// 8-bit PNG of 1 or 3 channels of display values (sRGB encoded already); clamped to [0, 1], NaN becomes 0.
void write_png(const std::filesystem::path& path, const Image& display_values);

/// Radiance RGBE of linear RGB. The format holds no negative values and no NaN: they become 0; infinity becomes the
/// largest value.
void write_hdr(const std::filesystem::path& path, const Image& linear_rgb);

}  // namespace diptych
