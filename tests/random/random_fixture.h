// What the tests of random scenes share.
#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <string>

#include "catch.h"
#include "random_scene/judge.h"
#include "generate/random.h"

namespace diptych::core::tests {

/// A folder for one test's files, gone with it.
class TestFolder {
public:
    TestFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "diptych-test-XXXXXX").string();
        path_ = mkdtemp(pattern.data());
    }
    ~TestFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;

    std::filesystem::path file(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

}  // namespace diptych::core::tests
