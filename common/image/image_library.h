// What Diptych asks of OpenImageIO. OpenImageIO loads some 250 shared libraries, which takes a quarter of a second and
// 130 MB. So it is linked into a shared object of its own, libdiptych_images.so (image/oiio), which is loaded when
// the first picture is read or written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "image/image.h"
#include "image/picture_layers.h"
#include "image/pixel_window.h"

namespace diptych::core {

/// `height` rows of `width` pixels from the top left, `channels` interleaved bytes a pixel.
struct ByteImage {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<std::uint8_t> data;
};

/// What the header of one part of a picture file says. Only EXR files have more than one part.
struct PictureHeader {
    PicturePart part;
    PixelWindow stored;                             // where the file has data
    PixelWindow display;                            // what is to be shown
    int depth = 1;                                  // more than 1 in a volume
    std::vector<bool> integer;                      // for each channel, whether it is stored as integers
    bool marked_linear = false;                     // the file says that its values are linear
    std::map<std::string, std::string> attributes;  // string attributes
};

/// A picture file that was opened. Its functions throw std::runtime_error with the reason.
class PictureFile {
public:
    virtual ~PictureFile() = default;
    virtual bool exr() const = 0;
    /// One for each part of an EXR. Of other formats only the first: their further parts are pages or smaller copies.
    virtual const std::vector<PictureHeader>& headers() const = 0;
    /// Channels `begin` to `end` of a part, row by row. Integers are scaled to [0, 1].
    virtual void read(size_t part, int begin, int end, std::span<float> values) = 0;
    virtual void read(size_t part, int begin, int end, std::span<std::uint8_t> values) = 0;
    /// As they are stored, for channels of 32-bit integers.
    virtual void read(size_t part, int begin, int end, std::span<std::uint32_t> words) = 0;
};

/// Every function throws std::runtime_error with the reason, never Error. The type information of standard
/// exceptions exists once in a process, so the program catches them by type whatever it exports.
class ImageLibrary {
public:
    using Bytes = std::vector<unsigned char>;

    virtual ~ImageLibrary() = default;
    /// Opens by the reader of one format: OpenImageIO's name for it, or an extension of file names.
    virtual std::unique_ptr<PictureFile> open(const std::string& format, const std::filesystem::path& path) const = 0;
    /// The same for a file in memory. The bytes must outlive the PictureFile.
    virtual std::unique_ptr<PictureFile> open(const std::string& format, std::span<const std::uint8_t> bytes) const = 0;
    /// Whether a format can be read, by OpenImageIO's name for it.
    virtual bool reads(const std::string& format) const = 0;

    virtual Bytes encode_hdr(const Image& image) const = 0;
    /// 1 to 4 channels; alpha is stored as it is. `srgb`: whether the file says that it holds sRGB.
    virtual Bytes encode_png(const ByteImage& image, bool srgb) const = 0;
};

/// Loads libdiptych_images.so on the first call, from where open_own_library finds it. Throws an Error that names the
/// library where it is missing or belongs to another build.
const ImageLibrary& image_library();

}  // namespace diptych::core
