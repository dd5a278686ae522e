// How much memory the groups of a made-up system leave to this process.
#include "memory_groups.h"

#include <filesystem>
#include <fstream>

#include "catch.h"
#include "temporary_folder.h"

namespace diptych::core {
namespace {

constexpr std::uint64_t mega = std::uint64_t{1} << 20U;

/// Writes a file of a system that lies in a folder.
void put(const std::filesystem::path& path, const std::string& text) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text << "\n";
}

void put_group(const std::filesystem::path& root, const std::string& group, const std::string& limit) {
    put(root / "sys/fs/cgroup" / group / "memory.max", limit);
    put(root / "sys/fs/cgroup" / group / "memory.current", std::to_string(mega));
}

}  // namespace

TEST_CASE("Without groups, or where they have no limit, a process may have the machine's memory") {
    const tests::TemporaryFolder folder;
    const std::filesystem::path& root = folder.path();
    const std::uint64_t machine = memory_of_process(root);
    CHECK(machine > 64 * mega);
    put(root / "proc/self/cgroup", "0::/user/job");
    put_group(root, "user/job", "max");
    CHECK(memory_groups(root).empty());
    CHECK(memory_of_process(root) == machine);
    put_group(root, "user", std::to_string(std::uint64_t{1} << 60U));  // more than any machine has
    CHECK(memory_of_process(root) == machine);
}

TEST_CASE("The least limit of a process's groups bounds its memory, of the own group or of one around it") {
    const tests::TemporaryFolder folder;
    const std::filesystem::path& root = folder.path();
    put(root / "proc/self/cgroup", "0::/user/job");
    put_group(root, "user/job", std::to_string(20 * mega));
    put_group(root, "user", std::to_string(30 * mega));
    put_group(root, "other", std::to_string(2 * mega));  // not this process's
    CHECK(memory_of_process(root) == 20 * mega);
    REQUIRE(memory_groups(root).size() == 2);
    CHECK(memory_groups(root)[0].used == mega);
    put_group(root, "user", std::to_string(10 * mega));
    CHECK(memory_of_process(root) == 10 * mega);
}

TEST_CASE("In a container the outermost group that is there counts") {
    const tests::TemporaryFolder folder;
    const std::filesystem::path& root = folder.path();
    put(root / "proc/self/cgroup", "0::/docker/0123");
    put_group(root, "", std::to_string(40 * mega));
    CHECK(memory_of_process(root) == 40 * mega);
}

TEST_CASE("Groups of version 1 bound the memory too") {
    const tests::TemporaryFolder folder;
    const std::filesystem::path& root = folder.path();
    put(root / "proc/self/cgroup", "5:cpu,cpuacct:/job\n4:memory:/job\nnonsense");
    put(root / "sys/fs/cgroup/memory/job/memory.limit_in_bytes", std::to_string(50 * mega));
    put(root / "sys/fs/cgroup/memory/job/memory.usage_in_bytes", "0");
    CHECK(memory_of_process(root) == 50 * mega);
}

}  // namespace diptych::core
