#include "session/input_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <sys/stat.h>

#include "error.h"
#include "gltf/files.h"
#include "image/picture_name.h"

namespace diptych::core::app {

namespace {

namespace fs = std::filesystem;

/// Device and inode: what two names of one file have in common.
using Identity = std::pair<dev_t, ino_t>;

std::optional<Identity> identity_of(const fs::path& file) {
    struct stat status = {};
    return ::stat(file.c_str(), &status) == 0 ? std::optional(Identity(status.st_dev, status.st_ino)) : std::nullopt;
}

}  // namespace

std::vector<fs::path> input_files(const RenderRequest& request) {
    std::vector<fs::path> files = gltf_files(request.scene);
    std::error_code ignored;
    if (const PictureName map = picture_name(request.environment); fs::is_regular_file(map.file, ignored)) {
        files.push_back(map.file);
    }
    return files;
}

void refuse_inputs(const std::vector<fs::path>& written, const std::vector<fs::path>& inputs) {
    std::map<Identity, fs::path> read;
    for (const fs::path& input : inputs) {
        if (const std::optional<Identity> identity = identity_of(input)) {
            read.emplace(*identity, input);
        }
    }
    for (const fs::path& file : written) {
        const std::optional<Identity> identity = identity_of(file);
        const auto same = identity ? read.find(*identity) : read.end();
        if (same != read.end()) {
            throw Error(fmt::format("{}: cannot write: it is the file '{}', which is read; give another name",
                                    file.string(), same->second.string()));
        }
    }
}

void refuse_inputs(const std::vector<fs::path>& written, const RenderRequest& request) {
    std::error_code ignored;
    if (std::any_of(written.begin(), written.end(), [&](const fs::path& file) { return fs::exists(file, ignored); })) {
        refuse_inputs(written, input_files(request));
    }
}

}  // namespace diptych::core::app
