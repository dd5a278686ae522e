#include "image/picture_name.h"

#include <system_error>

namespace diptych::core {

PictureName picture_name(const std::string& text) {
    std::error_code ignored;
    if (std::filesystem::exists(text, ignored)) {
        return {text, ""};
    }
    for (size_t colon = text.rfind(':'); colon != std::string::npos && colon > 0; colon = text.rfind(':', colon - 1)) {
        const std::string file = text.substr(0, colon);
        if (std::filesystem::is_regular_file(file, ignored)) {
            return {file, text.substr(colon + 1)};
        }
    }
    return {text, ""};
}

}  // namespace diptych::core
