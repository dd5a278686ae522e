#define CATCH_CONFIG_RUNNER
#include "catch.h"
#include "skipping.h"

#include <cstdio>

#if DIPTYCH_CATCH_VERSION >= 3
using Listener = Catch::EventListenerBase;
#else
using Listener = Catch::TestEventListenerBase;
#endif

namespace {

/// Tells TestRun of what the runner does.
class Watch : public Listener {
public:
    using Listener::Listener;

    void testCaseStarting(const Catch::TestCaseInfo& info) override {
        Listener::testCaseStarting(info);
        diptych::core::tests::test_run().begin(info.name);
    }

    void testCaseEnded(const Catch::TestCaseStats& stats) override {
        Listener::testCaseEnded(stats);
        const std::string fault = diptych::core::tests::test_run().end(stats.totals.assertions.total());
        if (!fault.empty()) {
            std::printf("FAILED: %s\n", fault.c_str());
        }
    }
};

}  // namespace

CATCH_REGISTER_LISTENER(Watch)

int main(int argc, char** argv) {
    return diptych::core::tests::test_run().exit_code(Catch::Session().run(argc, argv));
}
