#include "image/oiio/encode.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>

#include "image/oiio/fail.h"
#include "image/oiio/sink_proxy.h"

namespace diptych::core {
namespace {

constexpr int band_rows = 64;  // enough for all threads of OpenEXR, which compresses 16 rows at a time

std::unique_ptr<OIIO::ImageOutput> open(const std::string& format, const OIIO::ImageSpec& spec,
                                        OIIO::Filesystem::IOProxy& proxy) {
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    if (!output) {
        fail_by_library(OIIO::geterror());
    }
    if (!output->set_ioproxy(&proxy)) {
        fail_by_library("OpenImageIO cannot encode " + format + " in memory");
    }
    if (!output->open("memory." + format, spec)) {
        fail_by_library(output->geterror());
    }
    return output;
}

ImageLibrary::Bytes encode(const std::string& format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                           const void* pixels) {
    ImageLibrary::Bytes bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = open(format, spec, memory);
    if (!output->write_image(type, pixels) || !output->close()) {
        fail_by_library(output->geterror());
    }
    return bytes;
}

}  // namespace

void encode_exr(const ExrPicture& picture, ByteSink& sink) {
    const auto channels = static_cast<int>(picture.channels.size());
    OIIO::ImageSpec spec(picture.width, picture.height, channels, OIIO::TypeFloat);
    spec.channelnames = picture.channels;
    spec.attribute("compression", picture.compression == ExrCompression::zip ? "zip" : "none");
    spec.attribute("DateTime", "");  // else the time of writing: equal pictures are to be equal files
    for (const auto& [name, value] : picture.attributes) {
        spec.attribute(name, value);
    }
    SinkProxy proxy(sink);
    const std::unique_ptr<OIIO::ImageOutput> output = open("exr", spec, proxy);
    std::vector<float> rows;
    const auto fail = [&] {
        proxy.rethrow();
        fail_by_library(output->geterror());
    };
    for (int first = 0; first < picture.height; first += band_rows) {
        const int count = std::min(band_rows, picture.height - first);
        rows.resize(static_cast<std::size_t>(count) * static_cast<std::size_t>(picture.width) * picture.channels.size());
        picture.rows(first, count, rows);
        if (!output->write_scanlines(first, first + count, 0, OIIO::TypeFloat, rows.data())) {
            fail();
        }
    }
    if (!output->close()) {
        fail();
    }
    proxy.flush();
    proxy.rethrow();
}

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
