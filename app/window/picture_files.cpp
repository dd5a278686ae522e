#include "window/picture_files.h"

#include <fmt/format.h>

namespace diptych::app {

std::filesystem::path next_picture(const std::filesystem::path& folder, const std::string& scene, const std::string& extension) {
    const std::string stem = std::filesystem::path(scene).stem().string();
    for (int number = 1;; ++number) {
        const std::filesystem::path base = folder / fmt::format("{}-view-{:03}", stem, number);
        const auto taken = [&](const char* ending) { return std::filesystem::exists(base.string() + ending); };
        if (!taken(".png") && !taken(".exr")) {
            return base.string() + extension;
        }
    }
}

}  // namespace diptych::app
