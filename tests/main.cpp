#define CATCH_CONFIG_RUNNER
#include "catch.h"
#include "skipping.h"

namespace {

constexpr int skipped_exit_code = 77;

}  // namespace

int main(int argc, char** argv) {
    const int result = Catch::Session().run(argc, argv);
    return result == 0 && diptych::tests::any_skipped() ? skipped_exit_code : result;
}
