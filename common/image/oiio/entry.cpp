#include "image/oiio/entry.h"

#include <OpenImageIO/imageio.h>

#include "image/oiio/encode.h"
#include "image/oiio/picture_file.h"

namespace diptych::core {
namespace {

class OpenImageIO final : public ImageLibrary {
public:
    std::unique_ptr<PictureFile> open(const std::string& format, const std::filesystem::path& path) const override {
        return open_picture(format, path);
    }
    std::unique_ptr<PictureFile> open(const std::string& format, std::span<const std::uint8_t> bytes) const override {
        return open_picture(format, bytes);
    }
    bool reads(const std::string& format) const override {
        const std::string formats = "," + std::string(OIIO::get_string_attribute("input_format_list")) + ",";
        return formats.find("," + format + ",") != std::string::npos;
    }
    Bytes encode_hdr(const Image& image) const override { return hdr_bytes(image); }
    Bytes encode_png(const ByteImage& image, bool srgb) const override { return png_bytes(image, srgb); }
};

}  // namespace
}  // namespace diptych::core

extern "C" {
[[gnu::visibility("default")]] extern const char diptych_image_interface[];
const char diptych_image_interface[] = DIPTYCH_IMAGES_INTERFACE;

[[gnu::visibility("default")]] const diptych::core::ImageLibrary* diptych_image_library();
const diptych::core::ImageLibrary* diptych_image_library() {
    static const diptych::core::OpenImageIO library;
    return &library;
}
}
