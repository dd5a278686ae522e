// What a render writes and `compare` reads: colour, the layers beside it, and the settings that made them.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "image/image.h"
#include "image/image_file.h"

namespace diptych::core {

struct LayeredImage {
    Image color;                          // 3 channels, linear Rec.709
    std::optional<Image> standard_error;  // 3 channels, of the mean that `color` holds
    std::optional<Image> albedo;          // 3 channels
    std::optional<Image> normal;          // 3 channels, world space
    std::optional<Image> depth;           // 1 channel, world units
    std::map<std::string, std::string> metadata;
    // What read_image found out about the file; write_exr does not look at it.
    PixelWindow display;  // place and size of the picture in the file's coordinates
    PixelWindow data;     // the part of `display` that the file has data for; the rest is 0
    std::string layer;    // the layer of the file that `color` is, where nobody named one and the file holds others
};

/// A picture that is made while it is written.
struct GrowingImage {
    int width = 0;
    int height = 0;
    std::function<LayeredImage(int first, int count)> band;  // rows first .. first+count-1, with the same layers always
    std::map<std::string, std::string> metadata;
    ExrCompression compression = ExrCompression::zip;
};

/// float32: R G B, then stderr.R/G/B, albedo.R/G/B, normal.X/Y/Z, depth.Z for the layers that are there; metadata as
/// string attributes `diptych:NAME`. Values survive bit for bit; metadata with an empty value is not written. Equal
/// input gives equal bytes. Throws an Error naming file and reason.
void write_exr(const std::filesystem::path& path, const LayeredImage& layers);
void write_exr(const std::filesystem::path& path, const GrowingImage& image, const WriteBehind& behind = {});

/// The metadata of an EXR file that write_exr has written. Throws an Error naming file and reason.
std::map<std::string, std::string> read_metadata(const std::filesystem::path& path);

/// EXR with the layers it has, or any other picture as colour alone. The picture is what the display window shows. A
/// layer or part of an EXR can be chosen by name; then it is the colour, alone. Integer files are decoded from sRGB to
/// linear unless marked linear; grey becomes three equal channels; alpha is ignored; other chromaticities than Rec.709's
/// are converted. `memory_limit` is read_raw's. Throws an Error naming file and reason.
LayeredImage read_image(const std::filesystem::path& path, const std::string& layer = "",
                        std::uint64_t memory_limit = 0);

/// The picture of a file as linear Rec.709: what read_image does to colours.
Image linear_color(const RawImage& raw);

/// IEC 61966-2-1, display value in [0, 1] to linear.
float srgb_decoded(float encoded);

}  // namespace diptych::core
