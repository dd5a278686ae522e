#include "input_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "error.h"
#include "near_miss.h"

namespace diptych::core {
namespace {

/// A descriptor that closes itself.
class OpenFile {
public:
    /// Does not wait for the other end of a pipe.
    explicit OpenFile(const std::filesystem::path& path)
        : descriptor_(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {}
    ~OpenFile() {
        if (descriptor_ >= 0) {
            close(descriptor_);
        }
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    int get() const { return descriptor_; }

private:
    int descriptor_;
};

std::string problem_of(const struct stat& status) {
    return S_ISREG(status.st_mode)   ? ""
           : S_ISDIR(status.st_mode) ? "it is a folder, not a file"
                                     : "it is a device or a pipe, not a file";
}

std::string problem_of_errno(const std::filesystem::path& path) {
    return errno == ENOENT || errno == ENOTDIR ? "no such file" + did_you_mean_file(path)
                                               : std::string("cannot be opened: ") + std::strerror(errno);
}

}  // namespace

std::string input_problem(const std::filesystem::path& path) {
    struct stat status {};
    return stat(path.c_str(), &status) == 0 ? problem_of(status) : problem_of_errno(path);
}

void require_input(const std::filesystem::path& path) {
    if (const std::string problem = input_problem(path); !problem.empty()) {
        throw Error(path.string() + ": " + problem);
    }
}

std::vector<std::uint8_t> read_file(const std::filesystem::path& path, MemoryBudget& budget) {
    // Before it is opened: the mere opening of some devices does something. After it: that very file.
    if (const std::string problem = input_problem(path); !problem.empty()) {
        throw Error(problem);
    }
    const OpenFile file(path);
    struct stat status {};
    if (file.get() < 0 || fstat(file.get(), &status) != 0) {
        throw Error(problem_of_errno(path));
    }
    if (const std::string problem = problem_of(status); !problem.empty()) {
        throw Error(problem);
    }
    const auto size = static_cast<std::size_t>(status.st_size);
    budget.ask(size);
    std::vector<std::uint8_t> bytes(size);
    for (std::size_t at = 0; at < size;) {
        const ssize_t count = read(file.get(), bytes.data() + at, size - at);
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0) {
            throw Error("cannot be read to its end");
        }
        at += static_cast<std::size_t>(count);
    }
    return bytes;
}

}  // namespace diptych::core
