#include "catch.h"

#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

#include "error.h"
#include "generate/generate.h"
#include "gltf/write.h"
#include "image/atomic_file.h"
#include "image/dead_parts.h"
#include "temporary_folder.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// As `ulimit -f`: no file may grow beyond so many bytes.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit = {bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

private:
    rlimit before_ = {};
    void (*handler_)(int);
};

/// root may write everywhere, so the test becomes nobody for a while.
class Nobody {
public:
    Nobody() : root_(geteuid() == 0) {
        if (root_) {
            REQUIRE(seteuid(65534) == 0);
        }
    }
    Nobody(const Nobody&) = delete;
    Nobody& operator=(const Nobody&) = delete;
    ~Nobody() {
        if (root_) {
            (void)!seteuid(0);
        }
    }

private:
    bool root_;
};

std::string refusal(const std::function<void()>& write) {
    try {
        write();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a write that fails half-way leaves the old file whole and nothing beside it") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "file.txt";
    write_file_atomically(path, "old");
    std::string said;
    {
        const FileSizeLimit limit(1000);
        said = refusal([&] { write_file_atomically(path, std::string(5000, 'x')); });
    }
    CHECK(said == path.string() + ": cannot write: File too large (a limit of the file system or of the process)");
    CHECK(text_of(path) == "old");
    CHECK(folder.file_count() == 1);
    write_file_atomically(path, std::string(5000, 'x'));
    CHECK(text_of(path) == std::string(5000, 'x'));
}

TEST_CASE("files that belong together are replaced together or not at all") {
    const TemporaryFolder folder;
    const fs::path first = folder.path() / "a.bin", second = folder.path() / "a.gltf";
    folder.write("a.bin", "old bin");
    folder.write("a.gltf", "old gltf");
    {
        const FileSizeLimit limit(1000);
        FilesTogether files;
        files.add(first, {"new ", "bin"});
        CHECK_THAT(refusal([&] { files.add(second, {std::string(5000, 'x')}); }), Catch::Contains("a.gltf: cannot write: "));
    }
    CHECK(text_of(first) == "old bin");
    CHECK(text_of(second) == "old gltf");
    CHECK(folder.file_count() == 2);
    FilesTogether files;
    files.add(first, {"new ", "bin"});
    files.add(second, {"new gltf"});
    CHECK(text_of(first) == "old bin");
    files.publish();
    CHECK(text_of(first) == "new bin");
    CHECK(text_of(second) == "new gltf");
    CHECK(folder.file_count() == 2);
}

TEST_CASE("a scene that does not fit the disk leaves the old .gltf with its old .bin") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "scene.gltf";
    write_gltf(generate_scene("cornell", {}).scene, path);
    const std::string gltf = text_of(path), bin = text_of(folder.path() / "scene.bin");
    GenerateOptions many;
    many.count = 1000;
    const Scene street = generate_scene("many-lights", many).scene;
    const auto limit = static_cast<rlim_t>(100'000);  // above the new .bin, below the new .gltf
    {
        const FileSizeLimit below(limit);
        CHECK_THAT(refusal([&] { write_gltf(street, path); }), Catch::Contains("scene.gltf: cannot write: File too large"));
    }
    CHECK(text_of(path) == gltf);
    CHECK(text_of(folder.path() / "scene.bin") == bin);
    CHECK(folder.file_count() == 2);
    write_gltf(street, path);
    CHECK(fs::file_size(path) > limit);
    CHECK(fs::file_size(folder.path() / "scene.bin") < limit);
    CHECK(text_of(folder.path() / "scene.bin") != bin);
}

TEST_CASE("a folder that vanishes or loses its rights is named") {
    const TemporaryFolder folder;
    const fs::path inner = folder.path() / "inner";
    fs::create_directory(inner);
    TemporaryFile file(inner / "file.txt");
    file.write("text");
    fs::remove_all(inner);
    CHECK(refusal([&] { file.publish(); }) == (inner / "file.txt").string() + ": cannot write: the folder '" +
                                                  inner.string() + "' does not exist");
    CHECK_THAT(refusal([&] { write_file_atomically(inner / "file.txt", "text"); }), Catch::Contains("does not exist"));
    fs::create_directory(inner);
    folder.write("inner/old.txt", "old");
    fs::permissions(folder.path(), fs::perms(0755));
    fs::permissions(inner, fs::perms(0555));
    {
        const Nobody nobody;
        CHECK(refusal([&] { write_file_atomically(inner / "old.txt", "new"); }) ==
              (inner / "old.txt").string() + ": cannot write: Permission denied");
    }
    CHECK(text_of(inner / "old.txt") == "old");
}

TEST_CASE("temporary files of dead writers are swept, those of living ones are not") {
    const TemporaryFolder folder;
    const auto part = [&](const std::string& name) { return folder.path() / (name + part_ending); };
    folder.write(std::string(".picture.exr.12-0") + part_ending, "dead");
    folder.write(std::string(".picture.exr.13-0") + part_ending, "alive");
    folder.write(".other.part", "of another program");
    folder.write(std::string("picture") + part_ending, "no temporary file");
    const int alive = open(part(".picture.exr.13-0").c_str(), O_WRONLY | O_CLOEXEC);
    REQUIRE(flock(alive, LOCK_EX) == 0);
    write_file_atomically(folder.path() / "another.txt", "text");
    CHECK_FALSE(fs::exists(part(".picture.exr.12-0")));
    CHECK(fs::exists(part(".picture.exr.13-0")));
    CHECK(fs::exists(folder.path() / ".other.part"));
    CHECK(fs::exists(part("picture")));
    close(alive);
}

TEST_CASE("the longest name that a disk takes can be written") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / (std::string(251, 'n') + ".txt");
    write_file_atomically(path, "text");
    CHECK(text_of(path) == "text");
    CHECK(folder.file_count() == 1);
}
