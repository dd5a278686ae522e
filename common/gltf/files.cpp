#include "gltf/files.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "error.h"
#include "gltf/bytes.h"
#include "input_file.h"

namespace diptych::core {
namespace {

nlohmann::json parse(const std::filesystem::path& path) {
    MemoryBudget budget(0);
    const std::vector<std::uint8_t> bytes = read_file(path, budget);
    if (gltf::is_glb(bytes)) {
        return nlohmann::json::parse(gltf::split_glb(bytes).json, nullptr, false);
    }
    return nlohmann::json::parse(bytes.begin(), bytes.end(), nullptr, false);
}

}  // namespace

std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& path) {
    std::vector<std::filesystem::path> files{path};
    nlohmann::json json;
    try {
        json = parse(path);
    } catch (const Error&) {
        return files;
    }
    for (const char* const table : {"buffers", "images"}) {
        if (!json.is_object() || !json.contains(table) || !json[table].is_array()) {
            continue;
        }
        for (const nlohmann::json& entry : json[table]) {
            const auto uri = entry.is_object() ? entry.find("uri") : entry.end();
            if (!entry.is_object() || uri == entry.end() || !uri->is_string()) {
                continue;
            }
            const std::optional<std::filesystem::path> file =
                gltf::file_of_uri(uri->get<std::string>(), path.parent_path());
            if (file && std::find(files.begin(), files.end(), *file) == files.end()) {
                files.push_back(*file);
            }
        }
    }
    return files;
}

}  // namespace diptych::core
