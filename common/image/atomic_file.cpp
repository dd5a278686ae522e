#include "image/atomic_file.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include "error.h"
#include "near_miss.h"

namespace diptych::core {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
    throw Error(path.string() + ": cannot write: " + reason);
}

/// A file of a fresh name in the folder of the target; removed unless it was renamed.
class TemporaryFile {
public:
    explicit TemporaryFile(const fs::path& target) : target_(target) {
        static std::atomic<unsigned> counter{0};
        do {
            name_ = target.parent_path() / ("." + target.filename().string() + "." + std::to_string(getpid()) + "-" +
                                            std::to_string(counter++) + ".part");
            descriptor_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        } while (descriptor_ < 0 && errno == EEXIST);
        if (descriptor_ < 0) {
            fail(target_, std::strerror(errno));
        }
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (descriptor_ >= 0) {
            ::close(descriptor_);
        }
        if (!renamed_) {
            ::unlink(name_.c_str());
        }
    }

    void write(std::span<const unsigned char> bytes) {
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) {
                continue;
            }
            if (written <= 0) {
                fail(target_, written < 0 ? std::strerror(errno) : "nothing could be written");
            }
            bytes = bytes.subspan(static_cast<size_t>(written));
        }
    }

    void rename_to_target() {
        const int closed = ::close(descriptor_);
        descriptor_ = -1;
        if (closed != 0 || ::rename(name_.c_str(), target_.c_str()) != 0) {
            fail(target_, std::strerror(errno));
        }
        renamed_ = true;
    }

private:
    fs::path target_;
    fs::path name_;
    int descriptor_ = -1;
    bool renamed_ = false;
};

}  // namespace

void write_file_atomically(const fs::path& path, std::span<const unsigned char> bytes) {
    TemporaryFile file(path);
    file.write(bytes);
    file.rename_to_target();
}

void write_file_atomically(const fs::path& path, std::string_view text) {
    write_file_atomically(path, std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

void check_file_can_be_created(const fs::path& path) {
    std::error_code ignored;
    if (path.filename().empty()) {
        fail(path, "the name of a file is missing");
    }
    if (fs::is_directory(path, ignored)) {
        fail(path, "it is a folder");
    }
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::exists(folder, ignored)) {
        fail(path, "the folder '" + folder.string() + "' does not exist" + did_you_mean_file(folder));
    }
    if (!fs::is_directory(folder, ignored)) {
        fail(path, "'" + folder.string() + "' is not a folder");
    }
    const TemporaryFile probe(path);
}

}  // namespace diptych::core
