#include "image/oiio/picture_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <vector>

#include "image/oiio/fail.h"

namespace diptych::core {
namespace {

PictureHeader header_of(const OIIO::ImageSpec& spec, bool exr) {
    PictureHeader header;
    header.part.name = spec.get_string_attribute("oiio:subimagename");
    header.part.channels = spec.channelnames;
    header.part.deep = spec.deep;
    std::array<float, 8> v{};
    if (exr && spec.getattribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), v.data())) {
        header.part.chromaticities = Chromaticities{{v[0], v[1]}, {v[2], v[3]}, {v[4], v[5]}, {v[6], v[7]}};
    }
    header.stored = {spec.x, spec.y, spec.width, spec.height};
    header.display = {spec.full_x, spec.full_y, spec.full_width, spec.full_height};
    header.depth = spec.depth;
    for (int channel = 0; channel < spec.nchannels; ++channel) {
        header.integer.push_back(!spec.channelformat(channel).is_floating_point());
    }
    header.marked_linear = OIIO::Strutil::istarts_with(spec.get_string_attribute("oiio:ColorSpace"), "lin");
    for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
        if (attribute.type() == OIIO::TypeString) {
            header.attributes[attribute.name().string()] = attribute.get_ustring().string();
        }
    }
    return header;
}

class OpenPicture final : public PictureFile {
public:
    /// `memory` is what `input` reads from, where that is no file.
    OpenPicture(std::unique_ptr<OIIO::Filesystem::IOMemReader> memory, std::unique_ptr<OIIO::ImageInput> input)
        : memory_(std::move(memory)),
          input_(std::move(input)),
          exr_(std::string_view(input_->format_name()) == "openexr") {
        const int parts = exr_ ? std::max(1, input_->spec().get_int_attribute("oiio:subimages", 1)) : 1;
        for (int part = 0; part < parts; ++part) {
            if (!input_->seek_subimage(part, 0)) {
                fail_by_library(input_->geterror());
            }
            headers_.push_back(header_of(input_->spec(), exr_));
        }
    }

    bool exr() const override { return exr_; }
    const std::vector<PictureHeader>& headers() const override { return headers_; }
    void read(size_t part, int begin, int end, std::span<float> values) override {
        read(part, begin, end, OIIO::TypeFloat, values.data());
    }
    void read(size_t part, int begin, int end, std::span<std::uint8_t> values) override {
        read(part, begin, end, OIIO::TypeUInt8, values.data());
    }
    void read(size_t part, int begin, int end, std::span<std::uint32_t> words) override {
        read(part, begin, end, OIIO::TypeUInt32, words.data());
    }

private:
    void read(size_t part, int begin, int end, OIIO::TypeDesc type, void* values) {
        const OIIO::ImageSpec spec = input_->spec(static_cast<int>(part));
        const bool done = spec.tile_width > 0
                              ? input_->read_image(static_cast<int>(part), 0, begin, end, type, values)
                              : read_rows(static_cast<int>(part), spec, begin, end, type, static_cast<char*>(values));
        if (!done) {
            fail_by_library(input_->geterror());
        }
    }

    /// As read_image, which would allocate at least 256 rows of all channels, whatever the picture's height.
    bool read_rows(int part, const OIIO::ImageSpec& spec, int begin, int end, OIIO::TypeDesc type, char* values) {
        const auto width = static_cast<std::size_t>(spec.width);
        const std::size_t stored_pixel = spec.pixel_bytes(begin, end, true);
        const std::size_t pixel = type.size() * static_cast<std::size_t>(end - begin);
        constexpr std::size_t block_bytes = 16U << 20U;
        const std::size_t fitting = block_bytes / (stored_pixel * width);
        // The rows that EXR's longest compression packs together: each block is decompressed once.
        const int rows = std::min(spec.height, std::max(256, static_cast<int>(std::min<std::size_t>(fitting, 1U << 20U))));
        std::vector<char> stored(stored_pixel * width * static_cast<std::size_t>(rows));
        for (int row = 0; row < spec.height; row += rows) {
            const int count = std::min(rows, spec.height - row);
            if (!input_->read_native_scanlines(part, 0, spec.y + row, spec.y + row + count, 0, begin, end,
                                               stored.data())) {
                return false;
            }
            char* to = values + static_cast<std::size_t>(row) * width * pixel;
            std::size_t at = 0;  // of a channel within a stored pixel
            for (int channel = begin; channel < end; ++channel) {
                const OIIO::TypeDesc format = spec.channelformat(channel);
                if (!OIIO::convert_image(1, spec.width, count, 1, stored.data() + at, format,
                                         static_cast<OIIO::stride_t>(stored_pixel), OIIO::AutoStride, OIIO::AutoStride,
                                         to, type, static_cast<OIIO::stride_t>(pixel), OIIO::AutoStride,
                                         OIIO::AutoStride)) {
                    return false;
                }
                at += format.size();
                to += type.size();
            }
        }
        return true;
    }

    std::unique_ptr<OIIO::Filesystem::IOMemReader> memory_;  // before input_, which is to go first
    std::unique_ptr<OIIO::ImageInput> input_;
    bool exr_;
    std::vector<PictureHeader> headers_;
};

/// Without this, PNG files come with premultiplied colours, and dark colours under low alpha are lost.
OIIO::ImageSpec unassociated_alpha() {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    return config;
}

/// Whether there is a reader for a format, or for files with that extension. ImageInput::create would ask all readers
/// whether they know a file of that name.
bool is_known(const std::string& format) {
    // As in "tiff:tif,tiff,tx,env;jpeg:jpg,jpe".
    const std::string list = OIIO::get_string_attribute("extension_list");
    const auto ends_name = [](char c) { return c == ':' || c == ',' || c == ';'; };
    for (std::size_t at = list.find(format); at != std::string::npos && !format.empty(); at = list.find(format, at + 1)) {
        const std::size_t end = at + format.size();
        if ((at == 0 || ends_name(list[at - 1])) && (end == list.size() || ends_name(list[end]))) {
            return true;
        }
    }
    return false;
}

/// Opens by one reader. ImageInput::open would hand a file that its reader refuses to all others, and so a damaged
/// picture to decoders of video and of medical images.
std::unique_ptr<OIIO::ImageInput> open_by(const std::string& format, const std::string& name,
                                          const OIIO::ImageSpec& config) {
    if (!is_known(format)) {
        fail_by_library("neither its contents nor its extension are those of a known picture format");
    }
    std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
    if (!input) {
        fail_by_library(OIIO::geterror());
    }
    OIIO::ImageSpec spec;
    if (!input->open(name, spec, config)) {
        fail_by_library(input->geterror());
    }
    return input;
}

}  // namespace

std::unique_ptr<PictureFile> open_picture(const std::string& format, const std::filesystem::path& path) {
    return std::make_unique<OpenPicture>(nullptr, open_by(format, path.string(), unassociated_alpha()));
}

std::unique_ptr<PictureFile> open_picture(const std::string& format, std::span<const std::uint8_t> bytes) {
    auto* data = const_cast<std::uint8_t*>(bytes.data());  // which the reader only reads
    auto memory = std::make_unique<OIIO::Filesystem::IOMemReader>(data, bytes.size());
    OIIO::Filesystem::IOProxy* proxy = memory.get();
    OIIO::ImageSpec config = unassociated_alpha();
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    // One at a time: OpenImageIO reads colour profiles in `open`, and some of its versions (2.4) do so with data shared
    // between threads, which now and then corrupted the heap where many images with profiles were decoded at once.
    static std::mutex one_at_a_time;
    std::unique_ptr<OIIO::ImageInput> input;
    {
        const std::lock_guard lock(one_at_a_time);
        input = open_by(format, "image", config);
    }
    return std::make_unique<OpenPicture>(std::move(memory), std::move(input));
}

}  // namespace diptych::core
