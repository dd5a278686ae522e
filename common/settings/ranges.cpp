#include "settings/ranges.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "language/scene_types.h"

namespace diptych::core {
namespace {

static_assert(ranges::neighbors.accepted.most == shared::RESAMPLING_MAX_NEIGHBORS);

bool is_abbreviation(const std::string& word) {
    return word == "brdf" || word == "bsdf" || word == "fov" || word == "mis";
}

std::string upper(std::string word, std::size_t letters) {
    std::transform(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(std::min(letters, word.size())),
                   word.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return word;
}

}  // namespace

double nearest_accepted(const SettingRange& setting, double typed, double before) {
    return std::isnan(typed) ? before : std::clamp(typed, setting.accepted.least, setting.accepted.most);
}

std::string key_of(const std::string& setting) {
    std::string key = setting;
    std::replace(key.begin(), key.end(), '-', '_');
    return key;
}

std::string label_of(const std::string& setting) {
    std::string spaced = setting;
    std::replace(spaced.begin(), spaced.end(), '-', ' ');
    std::istringstream words(spaced);
    std::string label;
    for (std::string word; words >> word;) {
        label += label.empty() ? "" : " ";
        label += upper(word, is_abbreviation(word) ? word.size() : label.empty() ? 1 : 0);
    }
    return label;
}

}  // namespace diptych::core
