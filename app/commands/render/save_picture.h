// A picture saved where it was asked for, or at another place where that fails.
#pragma once

#include <string>

#include "render/metadata.h"
#include "render/save_film.h"

namespace diptych::core::app {

struct SavedPicture {
    std::string path;
    bool fell_back = false;  // it does not lie where it was asked for
};

/// Saves the film as request.output. Where that fails and `fallback_folder` is not empty, reports the reason and saves it
/// in that folder, under its own name or, where that is taken, a numbered one. Throws Error where nothing was saved.
SavedPicture save_picture(const Film& film, const RenderRequest& request, const RenderOutcome& outcome,
                          const std::string& fallback_folder);

/// Refuses a folder in which the picture could not be saved, or that is the output's own. Throws Error.
void check_fallback(const std::string& fallback_folder, const std::string& output);

}  // namespace diptych::core::app
