// Image files of every kind Diptych reads and writes, over OpenImageIO (image_library.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "image/chromaticities.h"
#include "image/exr_writer.h"
#include "image/image.h"
#include "image/pixel_window.h"
#include "image/temporary_file.h"
#include "image/word_channels.h"
#include "memory_budget.h"

namespace diptych::core {

enum class ImageFormat { Exr, Png, Hdr };

/// By extension, in any case; an Error lists the known ones.
ImageFormat image_format(const std::filesystem::path& path);

/// Refuses, before the work starts, an output whose extension is unknown or whose folder is missing or cannot be
/// written to, and a PNG or HDR where the image library cannot be loaded. Leaves nothing behind.
void check_writable(const std::filesystem::path& path);

/// Channels of a file by name, as they are stored there: integers scaled to [0, 1], not decoded.
struct RawImage {
    Image image;  // what the display window shows; 0 where the file has no data
    std::vector<std::string> channel_names;
    std::vector<int> color;                         // the channels that are the picture: three, or one that is grey
    bool integer = false;                           // the picture is stored as integers
    bool srgb_encoded = false;                      // integer files that are not marked as linear
    bool xyz = false;                               // the picture's channels are CIE XYZ
    std::optional<Chromaticities> chromaticities;   // of the picture, where the file says
    PixelWindow display;                            // of the file (EXR); else from 0, 0
    PixelWindow data;                               // where the file has data, cut to `display`
    std::string layer;                              // the layer taken, where the file holds others and none was asked for
    std::map<std::string, std::string> attributes;  // string attributes
};

/// The picture of any file that OpenImageIO reads, and of Radiance files. In an EXR it is the layer of that name, or
/// what choose_picture finds; of its part, the channels named in `beside` are read too where they are there. The pixels
/// as stored and the picture made of them may take `memory_limit` bytes (memory_budget.h). Throws an Error naming file,
/// layer and reason.
RawImage read_raw(const std::filesystem::path& path, const std::string& layer = "",
                  const std::vector<std::string>& beside = {}, std::uint64_t memory_limit = 0);

/// The string attributes of a file that OpenImageIO reads. Throws an Error naming file and reason.
std::map<std::string, std::string> read_attributes(const std::filesystem::path& path);

/// The words that earlier versions have put into channels behind a picture; none where the file has none. Asks the
/// budget for them before they are allocated. Throws an Error naming file and reason.
std::optional<WordChannels> read_words(const std::filesystem::path& path, MemoryBudget& budget);

/// Writes what goes behind the picture in its file, where readers of pictures do not look. Throws Error.
using WriteBehind = std::function<void(TemporaryFile& file)>;

/// Rows go to the file as the picture gives them. Throws an Error naming file and reason.
void write_exr_picture(const std::filesystem::path& path, const ExrPicture& picture, const WriteBehind& behind = {});

/// float32, zip-compressed, one part. Channel i of the image gets channel_names[i].
void write_exr_channels(const std::filesystem::path& path, const Image& image,
                        const std::vector<std::string>& channel_names,
                        const std::map<std::string, std::string>& attributes);

/// 8-bit PNG of 1 or 3 channels of display values (sRGB encoded already); clamped to [0, 1], NaN becomes 0.
void write_png(const std::filesystem::path& path, const Image& display_values);

/// What write_png writes, for a file that holds a picture among other things; an Error names that file.
std::vector<unsigned char> png_bytes(const std::filesystem::path& path, const Image& display_values);

/// Radiance RGBE of linear RGB. The format holds no negative values and no NaN: they become 0; infinity becomes the
/// largest value.
void write_hdr(const std::filesystem::path& path, const Image& linear_rgb);

}  // namespace diptych::core
