#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <new>
#include <stdexcept>

#include "error.h"
#include "image/exr_header.h"
#include "image/image_file.h"
#include "image/image_library.h"
#include "input_file.h"
#include "one_line.h"
#include "image/picture_format.h"
#include "image/picture_layers.h"
#include "image/radiance_file.h"
#include "image/size_claim.h"

namespace diptych::core {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& reason) {
    throw std::runtime_error(reason);
}

[[noreturn]] void fail_without_layers(const std::string& layer) {
    fail("it has no layer '" + layer + "': only EXR files have layers");
}

void check_file(const fs::path& path) {
    if (const std::string problem = input_problem(path); !problem.empty()) {
        fail(problem);
    }
    if (fs::file_size(path) == 0) {
        fail("the file is empty");
    }
}

bool begins_like_radiance(const fs::path& path) {
    std::array<char, 2> first{};
    std::ifstream(path, std::ios::binary).read(first.data(), first.size());
    return is_radiance({first.data(), first.size()});
}

RawImage read_radiance_raw(const fs::path& path, const std::string& layer, MemoryBudget& budget) {
    if (!layer.empty()) {
        fail_without_layers(layer);
    }
    RawImage raw;
    raw.image = read_radiance(path, budget);
    raw.channel_names = {"R", "G", "B"};
    raw.color = {0, 1, 2};
    raw.display = raw.data = {0, 0, raw.image.width, raw.image.height};
    return raw;
}

std::vector<PicturePart> parts_of(const PictureFile& file) {
    std::vector<PicturePart> parts;
    for (const PictureHeader& header : file.headers()) {
        PicturePart part = header.part;
        if (file.headers().size() == 1) {
            part.name.clear();
        }
        if (!file.exr() && part.channels.size() == 1) {
            part.channels = {"Y"};
        }
        if (part.chromaticities && !is_color_space(*part.chromaticities)) {
            fail("its chromaticities span no colour space");
        }
        parts.push_back(part);
    }
    return parts;
}

/// The display window is the picture, and the data window is placed in it: OpenEXR's 'Technical Introduction', section
/// 'Display Window and Data Window'. Other formats give windows other meanings, and theirs are not looked at.
void find_windows(const PictureHeader& header, bool exr, RawImage& raw) {
    raw.display = exr ? header.display : PixelWindow{0, 0, header.stored.width, header.stored.height};
    raw.data = exr ? intersection(raw.display, header.stored) : raw.display;
}

/// Channels `begin` to `end` of a part.
void read_channels(PictureFile& file, size_t part, int begin, int end, RawImage& raw) {
    const PixelWindow window = file.headers()[part].stored;
    const int channels = end - begin;
    Image stored = make_image(window.width, window.height, channels);
    file.read(part, begin, end, stored.data);
    if (raw.data == raw.display && stored.width == raw.display.width && stored.height == raw.display.height) {
        raw.image = std::move(stored);
        return;
    }
    raw.image = make_image(raw.display.width, raw.display.height, channels);
    for (int row = 0; row < raw.data.height; ++row) {
        const int y = raw.data.y + row;
        const float* from = &stored.data[stored.index(raw.data.x - window.x, y - window.y, 0)];
        float* to = &raw.image.data[raw.image.index(raw.data.x - raw.display.x, y - raw.display.y, 0)];
        std::copy_n(from, static_cast<size_t>(raw.data.width) * static_cast<size_t>(channels), to);
    }
}

void check_sizes(const PictureHeader& header, const RawImage& raw, int channels, std::size_t file_bytes,
                 MemoryBudget& budget) {
    if (header.depth > 1) {
        fail("it is a volume, not a picture");
    }
    const std::string reasons[] = {
        size_claim_problem(header.stored.width, header.stored.height, channels, file_bytes),
        size_claim_problem(raw.display.width, raw.display.height, channels, file_bytes, display_grant)};
    for (const std::string& reason : reasons) {
        if (!reason.empty()) {
            fail(reason);
        }
    }
    budget.ask(float_bytes(header.stored.width, header.stored.height, channels));
    budget.ask(float_bytes(raw.display.width, raw.display.height, channels));
}

std::unique_ptr<PictureFile> open_by_library(const fs::path& path) {
    if (const std::string problem = exr_header_problem(path); !problem.empty()) {
        fail(problem);
    }
    const std::string format = picture_format(path);
    if (const std::string problem = opening_problem(format, beginning_of(path), fs::file_size(path)); !problem.empty()) {
        fail(problem);
    }
    return image_library().open(format, path);
}

RawImage read_by_library(const fs::path& path, const std::string& layer, const std::vector<std::string>& beside,
                         MemoryBudget& budget) {
    const std::unique_ptr<PictureFile> file = open_by_library(path);
    if (!file->exr() && !layer.empty()) {
        fail_without_layers(layer);
    }
    const std::vector<PicturePart> parts = parts_of(*file);
    const ChosenPicture picture = choose_picture(parts, layer);
    const PictureHeader& header = file->headers()[picture.part];

    // One read of a range of channels: each read of an EXR decompresses all of them.
    const std::vector<std::string>& names = header.part.channels;
    int begin = *std::min_element(picture.channels.begin(), picture.channels.end());
    int end = *std::max_element(picture.channels.begin(), picture.channels.end()) + 1;
    for (const std::string& name : beside) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end()) {
            continue;
        }
        begin = std::min(begin, static_cast<int>(found - names.begin()));
        end = std::max(end, static_cast<int>(found - names.begin()) + 1);
    }

    RawImage raw;
    find_windows(header, file->exr(), raw);
    check_sizes(header, raw, end - begin, fs::file_size(path), budget);
    raw.channel_names.assign(names.begin() + begin, names.begin() + end);
    for (const int channel : picture.channels) {
        raw.color.push_back(channel - begin);
    }
    raw.integer = header.integer[static_cast<size_t>(picture.channels[0])];
    raw.srgb_encoded = raw.integer && !header.marked_linear;
    raw.xyz = picture.xyz;
    raw.chromaticities = header.part.chromaticities;
    raw.layer = picture.by_elimination ? picture.layer : "";
    raw.attributes = header.attributes;
    read_channels(*file, picture.part, begin, end, raw);
    return raw;
}

}  // namespace

namespace {

/// Names the file where it cannot be read. `read` is given the budget.
template <class Read>
auto read_checked(const fs::path& path, std::uint64_t memory_limit, const Read& read) {
    try {
        MemoryBudget budget(memory_limit);
        check_file(path);
        return read(budget);
    } catch (const std::bad_alloc&) {
        throw Error(path.string() + ": cannot read: the picture does not fit in memory");
    } catch (const std::runtime_error& error) {
        throw Error(path.string() + ": cannot read: " + one_line(error.what()));
    }
}

}  // namespace

RawImage read_raw(const fs::path& path, const std::string& layer, const std::vector<std::string>& beside,
                  std::uint64_t memory_limit) {
    return read_checked(path, memory_limit, [&](MemoryBudget& budget) {
        return begins_like_radiance(path) ? read_radiance_raw(path, layer, budget)
                                          : read_by_library(path, layer, beside, budget);
    });
}

std::map<std::string, std::string> read_attributes(const fs::path& path) {
    return read_checked(path, 0, [&](MemoryBudget&) { return open_by_library(path)->headers()[0].attributes; });
}

std::optional<WordChannels> read_words(const fs::path& path, MemoryBudget& budget) {
    return read_checked(path, 0, [&](MemoryBudget&) -> std::optional<WordChannels> {
        const std::unique_ptr<PictureFile> file = open_by_library(path);
        const PictureHeader& header = file->headers()[0];
        const std::vector<std::string>& names = header.part.channels;
        const auto is_word = [](const std::string& name) { return name.starts_with(word_prefix); };
        const auto begin = std::find_if(names.begin(), names.end(), is_word);
        const auto end = std::find_if_not(begin, names.end(), is_word);
        if (!file->exr() || begin == end) {
            return std::nullopt;
        }
        WordChannels words;
        words.width = header.stored.width;
        words.height = header.stored.height;
        for (auto name = begin; name != end; ++name) {
            words.names.push_back(name->substr(std::string_view(word_prefix).size()));
        }
        const std::string reason = size_claim_problem(words.width, words.height,
                                                      static_cast<std::int64_t>(words.names.size()), fs::file_size(path));
        if (!reason.empty()) {
            fail(reason);
        }
        budget.ask(float_bytes(words.width, words.height, static_cast<std::int64_t>(words.names.size())));
        words.data.resize(static_cast<std::size_t>(words.width) * static_cast<std::size_t>(words.height) *
                          words.names.size());
        file->read(0, static_cast<int>(begin - names.begin()), static_cast<int>(end - names.begin()), words.data);
        const auto digest = header.attributes.find(word_digest_attribute);
        if (digest == header.attributes.end() || digest->second != words_digest(words)) {
            fail("the sums of its samples are damaged");
        }
        return words;
    });
}

}  // namespace diptych::core
