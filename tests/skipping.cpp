#include "skipping.h"

#include <cstdio>
#include <set>

#include "catch.h"

namespace diptych::core::tests {
namespace {

constexpr int skipped_exit_code = 77;

void say(const std::string& line) {
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
}

}  // namespace

void report_skipped(const std::string& reason) {
    test_run().skip();
    say("SKIPPED: " + reason);
}

void report_left_out(const std::string& what) {
    static std::set<std::string> said;
    if (said.insert(what).second) {
        say("LEFT OUT: " + what);
    }
}

void TestRun::begin(const std::string& name) {
    name_ = name;
    skips_ = false;
}

std::string TestRun::end(std::uint64_t assertions) {
    ++cases_;
    skipped_ += skips_ ? 1 : 0;
    if (skips_ == (assertions == 0)) {
        return {};
    }
    faulty_ = true;
    return "\"" + name_ + "\" " +
           (skips_ ? "says that it was skipped, and made " + std::to_string(assertions) + " assertions"
                   : "asserted nothing, and does not say that it was skipped");
}

int TestRun::exit_code(int result) const {
    if (result != 0) {
        return result;
    }
    if (faulty_) {
        return 1;
    }
    return cases_ > 0 && skipped_ == cases_ ? skipped_exit_code : 0;
}

TestRun& test_run() {
    static TestRun run;
    return run;
}

}  // namespace diptych::core::tests
