#include "image/atomic_file.h"

#include <string>

#include "near_miss.h"

namespace diptych::core {

namespace fs = std::filesystem;

void write_file_atomically(const fs::path& path, std::string_view text) {
    TemporaryFile file(path);
    file.write(text);
    file.sync();
    file.publish();
}

void write_file_atomically(const fs::path& path, std::span<const unsigned char> bytes) {
    write_file_atomically(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void FilesTogether::add(const fs::path& path, std::initializer_list<std::string_view> pieces) {
    TemporaryFile& file = files_.emplace_back(path);
    for (const std::string_view piece : pieces) {
        file.write(piece);
    }
    file.sync();
}

void FilesTogether::publish() {
    for (TemporaryFile& file : files_) {
        file.publish();
    }
    files_.clear();
}

void check_file_can_be_created(const fs::path& path) {
    std::error_code ignored;
    if (path.filename().empty()) {
        fail_to_write(path, "the name of a file is missing");
    }
    if (fs::is_directory(path, ignored)) {
        fail_to_write(path, "it is a folder");
    }
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::exists(folder, ignored)) {
        fail_to_write(path, "the folder '" + folder.string() + "' does not exist" + did_you_mean_file(folder));
    }
    if (!fs::is_directory(folder, ignored)) {
        fail_to_write(path, "'" + folder.string() + "' is not a folder");
    }
    const TemporaryFile probe(path);
}

}  // namespace diptych::core
