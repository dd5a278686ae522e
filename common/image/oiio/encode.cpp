#include "image/oiio/encode.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "image/oiio/fail.h"

namespace diptych::core {
namespace {

ImageLibrary::Bytes encode(const std::string& format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                           const void* pixels) {
    ImageLibrary::Bytes bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    if (!output) {
        fail_by_library(OIIO::geterror());
    }
    if (!output->set_ioproxy(&memory)) {
        fail_by_library("OpenImageIO cannot encode " + format + " in memory");
    }
    if (!output->open("memory." + format, spec) || !output->write_image(type, pixels) || !output->close()) {
        fail_by_library(output->geterror());
    }
    return bytes;
}

}  // namespace

ImageLibrary::Bytes hdr_bytes(const Image& image) {
    const OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeFloat);
    return encode("hdr", spec, OIIO::TypeFloat, image.data.data());
}

ImageLibrary::Bytes png_bytes(const ByteImage& image, bool srgb) {
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeUInt8);
    spec.attribute("oiio:UnassociatedAlpha", 1);  // else the colours are taken for premultiplied
    if (srgb) {
        spec.attribute("oiio:ColorSpace", "sRGB");
    }
    return encode("png", spec, OIIO::TypeUInt8, image.data.data());
}

}  // namespace diptych::core
