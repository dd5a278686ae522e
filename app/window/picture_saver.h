// Pictures of a view as files.
#pragma once

#include <filesystem>
#include <future>
#include <optional>
#include <string>

#include "image/image.h"
#include "view/panel_worker.h"

namespace diptych::core::app {

/// FOLDER/SCENE-view-001.EXTENSION: the first number that no picture of either kind has.
std::filesystem::path next_picture(const std::filesystem::path& folder, const std::string& scene,
                                   const std::string& extension);

/// A film that a panel is asked for, saved once it comes.
class FilmSaver {
public:
    bool waiting() const { return film_.valid(); }
    void await(std::future<KeptFilm> film, std::filesystem::path path);

    /// Once a frame: saves the film where it has come, with the metadata that a render of the same samples has, and
    /// returns where. Throws Error.
    std::optional<std::filesystem::path> save();

private:
    std::future<KeptFilm> film_;
    std::filesystem::path path_;
};

}  // namespace diptych::core::app
