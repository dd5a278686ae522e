// What a user may have meant by a word or a file name that is not there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace diptych::core {

/// The nearest of the known words by Levenshtein's distance; empty where none is near.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

/// " (did you mean 'nearest'?)", to follow a reason; empty where none is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

/// The same for a path that does not exist: the first of its parts that is missing is sought among its neighbours.
std::string did_you_mean_file(const std::filesystem::path& path);

}  // namespace diptych::core
