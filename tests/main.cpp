#define CATCH_CONFIG_RUNNER
#include "catch.h"

#include <cstdio>

namespace {

constexpr int skipped_exit_code = 77;
bool any_skipped = false;

}  // namespace

void diptych::tests::report_skipped(const std::string& reason) {
    any_skipped = true;
    std::printf("SKIPPED: %s\n", reason.c_str());
    std::fflush(stdout);
}

int main(int argc, char** argv) {
    const int result = Catch::Session().run(argc, argv);
    return result == 0 && any_skipped ? skipped_exit_code : result;
}
