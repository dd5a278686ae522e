// Signals as a wish to stop. Each case runs in a process of its own, which may end by the signal.
#include "catch.h"

#include <csignal>
#include <functional>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "console/interrupt.h"

using namespace diptych::core::app;

namespace {

/// What the process that runs `body` ends with; 200 where `body` comes to its end.
int exit_code_of(const std::function<void()>& body) {
    const pid_t child = fork();
    if (child == 0) {
        dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
        body();
        _exit(200);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

void expect(bool holds) {
    if (!holds) {
        _exit(1);
    }
}

void wait_for_another_wish() {
    usleep(300'000);
}

}  // namespace

TEST_CASE("The first signal is a wish, and its number is in the exit code") {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
        INFO("signal " << signal);
        CHECK(exit_code_of([&] {
                  InterruptGuard guard;
                  expect(!guard.requested());
                  raise(signal);
                  expect(guard.requested());
                  expect(interrupt_exit_code() == 128 + signal);
              }) == 200);
    }
}

TEST_CASE("A second signal ends the process at once, unless it belongs to the first") {
    const auto signals = [](int first, int second, bool apart) {
        return exit_code_of([=] {
            const InterruptGuard guard;
            raise(first);
            if (apart) {
                wait_for_another_wish();
            }
            raise(second);
        });
    };
    CHECK(signals(SIGINT, SIGINT, true) == 128 + SIGINT);
    CHECK(signals(SIGHUP, SIGTERM, true) == 128 + SIGTERM);
    CHECK(signals(SIGTERM, SIGTERM, false) == 200);   // as `timeout` sends it
    CHECK(signals(SIGXCPU, SIGXCPU, true) == 200);    // as the kernel repeats it
    CHECK(signals(SIGXCPU, SIGINT, true) == 128 + SIGINT);
}

TEST_CASE("Where nothing is to be saved a signal ends the program with 128 + its number") {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
        INFO("signal " << signal);
        CHECK(exit_code_of([&] {
                  end_on_signals();
                  { const InterruptGuard guard; }
                  raise(signal);
              }) == 128 + signal);
    }
}

TEST_CASE("A hang-up that is ignored stays ignored") {
    CHECK(exit_code_of([] {
              std::signal(SIGHUP, SIG_IGN);
              end_on_signals();
              raise(SIGHUP);
              InterruptGuard guard;
              raise(SIGHUP);
              expect(!guard.requested());
          }) == 200);
}
