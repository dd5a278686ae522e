#include "commands/render/save_picture.h"

#include <fmt/format.h>

#include <filesystem>

#include "console/report.h"
#include "error.h"
#include "image/image_file.h"

namespace diptych::core::app {

namespace {

namespace fs = std::filesystem;

fs::path free_path(const fs::path& folder, const fs::path& output) {
    fs::path path = folder / output.filename();
    for (int number = 2; fs::exists(path); ++number) {
        path = folder / fmt::format("{}-{}{}", output.stem().string(), number, output.extension().string());
    }
    return path;
}

}  // namespace

SavedPicture save_picture(const Film& film, const RenderRequest& request, const RenderOutcome& outcome,
                          const std::string& fallback_folder) {
    SavedPicture picture{request.output, false};
    const std::map<std::string, std::string> metadata = render_metadata(request, outcome);
    try {
        write_film(film, metadata, request, picture.path);
    } catch (const Error& error) {
        if (fallback_folder.empty()) {
            throw;
        }
        report_error(error.what());
        picture.path = free_path(fallback_folder, request.output).string();
        picture.fell_back = true;
        write_film(film, metadata, request, picture.path);
        report_error(fmt::format("{}: the picture lies in {} instead", request.output, picture.path));
    }
    return picture;
}

void check_fallback(const std::string& fallback_folder, const std::string& output) {
    const fs::path parent = fs::path(output).parent_path();
    std::error_code ignored;
    if (!fs::is_directory(fallback_folder, ignored)) {
        throw Error(fmt::format("--fallback-dir {}: is not a folder", fallback_folder));
    }
    if (fs::equivalent(fallback_folder, parent.empty() ? fs::path(".") : parent, ignored)) {
        throw Error(fmt::format("--fallback-dir {}: is the folder of -o; give one on another disk", fallback_folder));
    }
    check_writable(fs::path(fallback_folder) / fs::path(output).filename());
}

}  // namespace diptych::core::app
