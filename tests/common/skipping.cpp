// Skipped means not run, and passed means that something was asserted.
#include "skipping.h"

#include "catch.h"

using diptych::core::tests::TestRun;

namespace {

struct Case {
    bool skips;
    std::uint64_t assertions;
};

int exit_code(const std::vector<Case>& cases, int result = 0) {
    TestRun run;
    for (const Case& c : cases) {
        run.begin("a test");
        if (c.skips) {
            run.skip();
        }
        const bool faulty = !run.end(c.assertions).empty();
        CHECK(faulty == (c.skips == (c.assertions > 0)));
    }
    return run.exit_code(result);
}

}  // namespace

TEST_CASE("A test case asserts something or is skipped, and one that does both or neither fails", "[skipping]") {
    CHECK(exit_code({{false, 3}}) == 0);
    CHECK(exit_code({{true, 0}}) == 77);
    CHECK(exit_code({{true, 3}}) == 1);
    CHECK(exit_code({{false, 0}}) == 1);
    CHECK(exit_code({{true, 0}, {true, 0}}) == 77);
    CHECK(exit_code({{true, 0}, {false, 3}}) == 0);
    CHECK(exit_code({{true, 3}, {false, 3}}) == 1);
    CHECK(exit_code({{true, 0}}, 5) == 5);
    CHECK(exit_code({}) == 0);
}
