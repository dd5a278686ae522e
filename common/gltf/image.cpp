#include "gltf/image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>
#include <mutex>
#include <string_view>
#include <thread>

#include "error.h"

namespace diptych::gltf {
namespace {

constexpr std::int64_t max_texels = std::int64_t{1} << 28;

// OpenImageIO picks its reader by a file name's ending.
const char* name_by_content(const Bytes& bytes) {
    const auto starts = [&](std::string_view magic, std::size_t at = 0) {
        return bytes.size() >= at + magic.size() && std::memcmp(bytes.data() + at, magic.data(), magic.size()) == 0;
    };
    if (starts("\x89PNG")) {
        return "image.png";
    }
    if (starts("\xff\xd8\xff")) {
        return "image.jpg";
    }
    if (starts("BM")) {
        return "image.bmp";
    }
    if (starts("GIF8")) {
        return "image.gif";
    }
    return starts("RIFF") && starts("WEBP", 8) ? "image.webp" : nullptr;
}

bool is_ktx2(const Bytes& bytes) {
    constexpr std::string_view magic = "\xabKTX 20\xbb";
    return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

/// One at a time: OpenImageIO reads colour profiles in `open`, and some of its versions (2.4) do so with data shared
/// between threads, which now and then corrupted the heap where many images with profiles were decoded at once.
std::unique_ptr<OIIO::ImageInput> open_image(const char* name, const OIIO::ImageSpec& config) {
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    return OIIO::ImageInput::open(name, &config);
}

std::string open_error(const std::string& fallback) {
    const std::string message = OIIO::geterror();
    return message.empty() ? fallback : message;
}

// One to four channels to RGBA: grey is repeated, a missing alpha is opaque.
void spread_channels(const std::vector<std::uint8_t>& from, std::size_t channels, std::vector<std::uint8_t>& rgba) {
    const std::size_t texels = rgba.size() / 4;
    for (std::size_t i = 0; i < texels; ++i) {
        const std::uint8_t* texel = from.data() + i * channels;
        const bool grey = channels < 3;
        rgba[4 * i] = texel[0];
        rgba[4 * i + 1] = grey ? texel[0] : texel[1];
        rgba[4 * i + 2] = grey ? texel[0] : texel[2];
        rgba[4 * i + 3] = channels == 2 ? texel[1] : channels >= 4 ? texel[3] : std::uint8_t{255};
    }
}

}  // namespace

TextureImage decode_image(const EncodedImage& encoded) {
    if (!encoded.problem.empty()) {
        throw Error(encoded.problem);
    }
    const char* name = name_by_content(encoded.bytes);
    if (is_ktx2(encoded.bytes)) {
        throw Error("is KTX2, which is not read");
    }
    if (name == nullptr) {
        throw Error("is neither PNG, JPEG nor WebP");
    }
    OIIO::Filesystem::IOMemReader memory(const_cast<std::uint8_t*>(encoded.bytes.data()), encoded.bytes.size());
    OIIO::Filesystem::IOProxy* proxy = &memory;
    OIIO::ImageSpec config;
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    // PNG would come premultiplied otherwise, and dark colours under low alpha would be lost.
    config.attribute("oiio:UnassociatedAlpha", 1);
    const std::unique_ptr<OIIO::ImageInput> input = open_image(name, config);
    if (!input) {
        throw Error("cannot be decoded: " + open_error("unknown format"));
    }
    const OIIO::ImageSpec& spec = input->spec();
    const std::int64_t texels = std::int64_t{spec.width} * spec.height;
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 || texels > max_texels) {
        throw Error("has a size of " + std::to_string(spec.width) + "x" + std::to_string(spec.height) + "x" +
                    std::to_string(spec.nchannels));
    }
    const auto channels = static_cast<std::size_t>(std::min(spec.nchannels, 4));
    std::vector<std::uint8_t> decoded(static_cast<std::size_t>(texels) * channels);
    if (!input->read_image(0, 0, 0, static_cast<int>(channels), OIIO::TypeDesc::UINT8, decoded.data())) {
        throw Error("cannot be decoded: " + input->geterror());
    }
    TextureImage image{encoded.name, spec.width, spec.height, {}};
    if (channels == 4) {
        image.rgba = std::move(decoded);
    } else {
        image.rgba.resize(static_cast<std::size_t>(texels) * 4);
        spread_channels(decoded, channels, image.rgba);
    }
    return image;
}

bool reads_webp() {
    const std::string formats = "," + std::string(OIIO::get_string_attribute("input_format_list")) + ",";
    return formats.find(",webp,") != std::string::npos;
}

TextureImage checker(const std::string& name) {
    constexpr int side = 64;
    constexpr int square = 8;
    TextureImage image{name, side, side, {}};
    image.rgba.reserve(4 * side * side);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const std::uint8_t light = (x / square + y / square) % 2 == 0 ? 255 : 0;
            image.rgba.insert(image.rgba.end(), {light, 0, light, 255});
        }
    }
    return image;
}

DecodedImages decode_images(const Document& document, const std::vector<int>& wanted) {
    DecodedImages decoded{std::vector<TextureImage>(wanted.size()), std::vector<std::string>(wanted.size())};
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t i = next++; i < wanted.size(); i = next++) {
            const EncodedImage& encoded = document.images[static_cast<std::size_t>(wanted[i])];
            try {
                decoded.images[i] = decode_image(encoded);
            } catch (const std::exception& error) {
                decoded.problems[i] = error.what();
                decoded.images[i] = checker(encoded.name);
            }
        }
    };
    const std::size_t workers = std::min<std::size_t>(wanted.size(), std::max(1U, std::thread::hardware_concurrency()));
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = 1; i < workers; ++i) {
            threads.emplace_back(work);
        }
        work();
    }
    return decoded;
}

}  // namespace diptych::gltf
