#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <new>
#include <stdexcept>

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include "error.h"
#include "image/image_file.h"
#include "image/near_miss.h"
#include "image/picture_layers.h"
#include "image/radiance_file.h"
#include "image/size_claim.h"

namespace diptych {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& reason) {
    throw std::runtime_error(reason);
}

[[noreturn]] void fail_by_library(const std::string& text) {
    const std::string line = text.substr(0, text.find('\n'));
    fail(line.empty() ? "unknown reason" : line);
}

[[noreturn]] void fail_without_layers(const std::string& layer) {
    fail("it has no layer '" + layer + "': only EXR files have layers");
}

void check_file(const fs::path& path) {
    std::error_code error;
    if (!fs::exists(path, error))
        fail("no such file" + did_you_mean_file(path));
    if (fs::is_directory(path, error))
        fail("it is a folder, not a file");
    if (!fs::is_regular_file(path, error))
        fail("it is not a regular file");
    if (fs::file_size(path, error) == 0 && !error)
        fail("the file is empty");
}

bool begins_like_radiance(const fs::path& path) {
    std::array<char, 2> first{};
    std::ifstream(path, std::ios::binary).read(first.data(), first.size());
    return is_radiance({first.data(), first.size()});
}

RawImage read_radiance_raw(const fs::path& path, const std::string& layer) {
    if (!layer.empty())
        fail_without_layers(layer);
    RawImage raw;
    raw.image = read_radiance(path);
    raw.channel_names = {"R", "G", "B"};
    raw.color = {0, 1, 2};
    raw.display = raw.data = {0, 0, raw.image.width, raw.image.height};
    return raw;
}

PicturePart part_of(const OIIO::ImageSpec& spec, bool exr, bool one_of_several) {
    PicturePart part;
    part.channels = spec.channelnames;
    part.deep = spec.deep;
    if (one_of_several)
        part.name = spec.get_string_attribute("oiio:subimagename");
    if (!exr && spec.nchannels == 1)
        part.channels = {"Y"};
    std::array<float, 8> v{};
    if (exr && spec.getattribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), v.data())) {
        part.chromaticities = Chromaticities{{v[0], v[1]}, {v[2], v[3]}, {v[4], v[5]}, {v[6], v[7]}};
        if (!is_color_space(*part.chromaticities))
            fail("its chromaticities span no colour space");
    }
    return part;
}

/// All parts of an EXR; of other formats only the first, since further ones are pages or smaller copies of it.
std::vector<PicturePart> parts_of(OIIO::ImageInput& input, bool exr) {
    const int count = exr ? std::max(1, input.spec().get_int_attribute("oiio:subimages", 1)) : 1;
    std::vector<PicturePart> parts;
    for (int i = 0; i < count; ++i) {
        if (!input.seek_subimage(i, 0))
            fail_by_library(input.geterror());
        parts.push_back(part_of(input.spec(), exr, count > 1));
    }
    return parts;
}

/// The display window is the picture, and the data window is placed in it: OpenEXR's 'Technical Introduction', section
/// 'Display Window and Data Window'. Other formats give windows other meanings, and theirs are not looked at.
void find_windows(const OIIO::ImageSpec& spec, bool exr, RawImage& raw) {
    const PixelWindow stored{spec.x, spec.y, spec.width, spec.height};
    raw.display = exr ? PixelWindow{spec.full_x, spec.full_y, spec.full_width, spec.full_height}
                      : PixelWindow{0, 0, spec.width, spec.height};
    raw.data = exr ? intersection(raw.display, stored) : raw.display;
}

/// Channels `begin` to `end` of the part that `input` stands at.
void read_channels(OIIO::ImageInput& input, int subimage, int begin, int end, RawImage& raw) {
    const OIIO::ImageSpec& spec = input.spec();
    const int channels = end - begin;
    Image stored = make_image(spec.width, spec.height, channels);
    if (!input.read_image(subimage, 0, begin, end, OIIO::TypeFloat, stored.data.data()))
        fail_by_library(input.geterror());
    if (raw.data == raw.display && stored.width == raw.display.width && stored.height == raw.display.height) {
        raw.image = std::move(stored);
        return;
    }
    raw.image = make_image(raw.display.width, raw.display.height, channels);
    for (int row = 0; row < raw.data.height; ++row) {
        const int y = raw.data.y + row;
        const float* from = &stored.data[stored.index(raw.data.x - spec.x, y - spec.y, 0)];
        float* to = &raw.image.data[raw.image.index(raw.data.x - raw.display.x, y - raw.display.y, 0)];
        std::copy_n(from, static_cast<size_t>(raw.data.width) * static_cast<size_t>(channels), to);
    }
}

void check_sizes(const OIIO::ImageSpec& spec, const RawImage& raw, int channels, std::size_t file_bytes) {
    if (spec.depth > 1)
        fail("it is a volume, not a picture");
    const std::string reasons[] = {
        size_claim_problem(spec.width, spec.height, channels, file_bytes),
        size_claim_problem(raw.display.width, raw.display.height, channels, file_bytes, display_grant)};
    for (const std::string& reason : reasons)
        if (!reason.empty())
            fail(reason);
}

RawImage read_by_library(const fs::path& path, const std::string& layer, const std::vector<std::string>& beside) {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string(), &config);
    if (!input)
        fail_by_library(OIIO::geterror());
    const bool exr = std::string_view(input->format_name()) == "openexr";
    if (!exr && !layer.empty())
        fail_without_layers(layer);
    const std::vector<PicturePart> parts = parts_of(*input, exr);
    const ChosenPicture picture = choose_picture(parts, layer);
    const int subimage = static_cast<int>(picture.part);
    if (!input->seek_subimage(subimage, 0))
        fail_by_library(input->geterror());
    const OIIO::ImageSpec& spec = input->spec();

    // One read of a range of channels: each read of an EXR decompresses all of them.
    int begin = *std::min_element(picture.channels.begin(), picture.channels.end());
    int end = *std::max_element(picture.channels.begin(), picture.channels.end()) + 1;
    for (const std::string& name : beside) {
        const auto found = std::find(spec.channelnames.begin(), spec.channelnames.end(), name);
        if (found == spec.channelnames.end())
            continue;
        begin = std::min(begin, static_cast<int>(found - spec.channelnames.begin()));
        end = std::max(end, static_cast<int>(found - spec.channelnames.begin()) + 1);
    }

    RawImage raw;
    find_windows(spec, exr, raw);
    check_sizes(spec, raw, end - begin, fs::file_size(path));
    raw.channel_names.assign(spec.channelnames.begin() + begin, spec.channelnames.begin() + end);
    for (const int channel : picture.channels)
        raw.color.push_back(channel - begin);
    raw.integer = !spec.channelformat(picture.channels[0]).is_floating_point();
    const bool marked_linear = OIIO::Strutil::istarts_with(spec.get_string_attribute("oiio:ColorSpace"), "lin");
    raw.srgb_encoded = raw.integer && !marked_linear;
    raw.xyz = picture.xyz;
    raw.chromaticities = parts[picture.part].chromaticities;
    raw.layer = picture.by_elimination ? picture.layer : "";
    for (const OIIO::ParamValue& attribute : spec.extra_attribs)
        if (attribute.type() == OIIO::TypeString)
            raw.attributes[attribute.name().string()] = attribute.get_ustring().string();
    read_channels(*input, subimage, begin, end, raw);
    return raw;
}

}  // namespace

RawImage read_raw(const fs::path& path, const std::string& layer, const std::vector<std::string>& beside) {
    try {
        check_file(path);
        return begins_like_radiance(path) ? read_radiance_raw(path, layer) : read_by_library(path, layer, beside);
    } catch (const std::bad_alloc&) {
        throw Error(path.string() + ": cannot read: the picture does not fit in memory");
    } catch (const std::runtime_error& error) {
        throw Error(path.string() + ": cannot read: " + error.what());
    }
}

}  // namespace diptych
