// What could not run here. A test case either asserts something or is skipped (SKIP_TEST of catch.h): one that does
// both, or neither, fails.
#pragma once

#include <cstdint>
#include <string>

namespace diptych::core::tests {

/// Prints "LEFT OUT: what", each once: a part of a test that this machine cannot run, beside parts that ran.
void report_left_out(const std::string& what);

/// The test cases of a program, as its runner meets them.
class TestRun {
public:
    void begin(const std::string& name);
    void skip() { skips_ = true; }
    /// What is wrong about the test case; empty where nothing is.
    std::string end(std::uint64_t assertions);

    /// The program's, by the runner's own: 1 where a test case did both or neither, 77 where all were skipped.
    int exit_code(int result) const;

private:
    std::string name_;
    bool skips_ = false;
    bool faulty_ = false;
    std::uint64_t cases_ = 0;
    std::uint64_t skipped_ = 0;
};

/// This program's.
TestRun& test_run();

}  // namespace diptych::core::tests
