#include "image/oiio/encode.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>

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

/// The floats' bits and the words, pixel by pixel.
std::vector<std::uint32_t> interleaved(const Image& image, const WordChannels& words) {
    const std::size_t floats = static_cast<std::size_t>(image.channels);
    const std::size_t stride = floats + words.names.size();
    std::vector<std::uint32_t> pixels(image.pixel_count() * stride);
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        std::memcpy(&pixels[i * stride], &image.data[i * floats], floats * sizeof(float));
        std::copy_n(&words.data[i * words.names.size()], words.names.size(), &pixels[i * stride + floats]);
    }
    return pixels;
}

}  // namespace

ImageLibrary::Bytes exr_bytes(const Image& image, const std::vector<std::string>& channel_names,
                              const std::map<std::string, std::string>& attributes, const WordChannels* words) {
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeFloat);
    spec.channelnames = channel_names;
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", "");  // else the time of writing: equal pictures are to be equal files
    for (const auto& [name, value] : attributes) {
        spec.attribute(name, value);
    }
    if (words == nullptr) {
        return encode("exr", spec, OIIO::TypeFloat, image.data.data());
    }
    spec.channelformats.assign(channel_names.size(), OIIO::TypeFloat);
    for (const std::string& name : words->names) {
        spec.channelnames.push_back(word_prefix + name);
        spec.channelformats.push_back(OIIO::TypeUInt32);
    }
    spec.nchannels = static_cast<int>(spec.channelnames.size());
    spec.attribute("compression", "rle");  // most bytes of the words are 0; zip takes ten times as long
    return encode("exr", spec, OIIO::TypeUnknown, interleaved(image, *words).data());
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
