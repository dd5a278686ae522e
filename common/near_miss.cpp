#include "near_miss.h"

#include <algorithm>
#include <numeric>
#include <system_error>

namespace diptych::core {
namespace {

namespace fs = std::filesystem;

/// Levenshtein's distance.
std::size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
        }
    }
    return row.back();
}

std::vector<std::string> names_in(const fs::path& folder, bool only_folders) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        std::error_code ignored;
        if (!only_folders || at->is_directory(ignored)) {
            names.push_back(at->path().filename().string());
        }
    }
    std::sort(names.begin(), names.end());  // so that of two equally near names it is always the same one
    return names;
}

}  // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
    std::string best;
    std::size_t least = 1 + word.size() / 3;
    for (const std::string& candidate : known) {
        const std::size_t d = distance(word, candidate);
        if (d <= least && (best.empty() || d < least)) {
            best = candidate;
            least = d;
        }
    }
    return best;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
    const std::string nearest = nearest_word(word, known);
    return nearest.empty() ? "" : " (did you mean '" + nearest + "'?)";
}

std::string did_you_mean_file(const fs::path& path) {
    fs::path there;
    for (auto part = path.begin(); part != path.end(); ++part) {
        std::error_code ignored;
        if (part->empty() || fs::exists(there / *part, ignored)) {
            there /= *part;
            continue;
        }
        const bool last = std::next(part) == path.end();
        const std::string nearest = nearest_word(part->string(), names_in(there.empty() ? "." : there, !last));
        return nearest.empty() ? "" : " (did you mean '" + (there / nearest).string() + "'?)";
    }
    return "";
}

}  // namespace diptych::core
