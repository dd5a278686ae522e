// How a user names a picture: a file, or one layer of a file.
#pragma once

#include <filesystem>
#include <string>

namespace diptych::core {

struct PictureName {
    std::filesystem::path file;
    std::string layer;  // empty: the picture of the file
};

/// Splits `FILE:LAYER`. A text that is the name of a file is that file, so names with colons still open. Otherwise FILE
/// is the longest file name that a colon follows; where there is none, the whole text is the file.
PictureName picture_name(const std::string& text);

}  // namespace diptych::core
