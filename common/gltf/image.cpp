#include "gltf/image.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>

#include "error.h"
#include "image/image_library.h"
#include "image/picture_format.h"

namespace diptych::core::gltf {
namespace {

constexpr std::int64_t max_texels = std::int64_t{1} << 28;

/// The formats of textures, and two more that files hold now and then.
bool is_read(const std::string& format) {
    return format == "png" || format == "jpeg" || format == "webp" || format == "bmp" || format == "gif";
}

bool is_ktx2(const Bytes& bytes) {
    constexpr std::string_view magic = "\xabKTX 20\xbb";
    return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
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

/// The first one to four channels.
ByteImage decode(const std::string& format, const Bytes& bytes, MemoryBudget& budget) {
    if (const std::string problem = opening_problem(format, bytes, bytes.size()); !problem.empty()) {
        throw Error(problem);
    }
    const std::unique_ptr<PictureFile> file = image_library().open(format, bytes);
    const PictureHeader& header = file->headers().front();
    const auto [x, y, width, height] = header.stored;
    const std::size_t channels = header.part.channels.size();
    const std::int64_t texels = std::int64_t{width} * height;
    if (width < 1 || height < 1 || header.depth > 1 || channels < 1 || texels > max_texels) {
        throw Error("has a size of " + std::to_string(width) + "x" + std::to_string(height) + "x" +
                    std::to_string(channels));
    }
    ByteImage image{width, height, static_cast<int>(std::min<std::size_t>(channels, 4)), {}};
    // As decoded, and as RGBA beside it where that is another picture.
    const int copied = image.channels == 4 ? 0 : 4;
    budget.ask(bytes_of(static_cast<std::uint64_t>(texels), static_cast<std::uint64_t>(image.channels + copied)));
    image.data.resize(static_cast<std::size_t>(texels) * static_cast<std::size_t>(image.channels));
    file->read(0, 0, image.channels, image.data);
    return image;
}

const ImageLibrary& library_for(const Document& document, const std::string& object) {
    try {
        return image_library();
    } catch (const std::runtime_error& error) {
        fail(document, object, error.what());
    }
}

}  // namespace

TextureImage decode_image(const EncodedImage& encoded, MemoryBudget& budget) {
    if (!encoded.problem.empty()) {
        throw Error(encoded.problem);
    }
    const std::string format = picture_format(encoded.bytes);
    if (is_ktx2(encoded.bytes)) {
        throw Error("is KTX2, which is not read");
    }
    if (!is_read(format)) {
        throw Error("is neither PNG, JPEG nor WebP");
    }
    ByteImage decoded;
    try {
        decoded = decode(format, encoded.bytes, budget);
    } catch (const Error&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw Error(std::string("cannot be decoded: ") + error.what());
    }
    TextureImage image{encoded.name, decoded.width, decoded.height, {}};
    if (decoded.channels == 4) {
        image.rgba = std::move(decoded.data);
    } else {
        image.rgba.resize(4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
        spread_channels(decoded.data, static_cast<std::size_t>(decoded.channels), image.rgba);
    }
    return image;
}

bool reads_webp(const Document& document, const std::string& object) {
    return library_for(document, object).reads("webp");
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
    if (!wanted.empty()) {
        library_for(document, "images");  // where it is missing, that is an error, not a warning for each image
    }
    std::vector<std::string> too_large(wanted.size());
    DecodedImages decoded{std::vector<TextureImage>(wanted.size()), std::vector<std::string>(wanted.size())};
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t i = next++; i < wanted.size(); i = next++) {
            const EncodedImage& encoded = document.images[static_cast<std::size_t>(wanted[i])];
            try {
                decoded.images[i] = decode_image(encoded, *document.budget);
            } catch (const OverBudget& error) {
                too_large[i] = error.what();
            } catch (const std::exception& error) {
                decoded.problems[i] = error.what();
                decoded.images[i] = checker(encoded.name);
            }
        }
    };
    const std::size_t workers = std::min<std::size_t>(wanted.size(), std::max(1U, std::thread::hardware_concurrency()));
    {
        std::vector<std::jthread> threads;
        try {
            for (std::size_t i = 1; i < workers; ++i) {
                threads.emplace_back(work);
            }
        } catch (const std::system_error&) {  // no more threads here: those that run, and this one, do all the work
        }
        work();
    }
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (!too_large[i].empty()) {
            const auto index = static_cast<std::size_t>(wanted[i]);
            fail(document, label("images", index, document.images[index].name), too_large[i]);
        }
    }
    return decoded;
}

}  // namespace diptych::core::gltf
