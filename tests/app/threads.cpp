// A user or container whose limit of processes is reached.
#include "catch.h"

#include <fcntl.h>
#include <grp.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "process.h"

using namespace diptych::core::tests;

namespace {

constexpr uid_t nobody_else = 54321;  // a user with no other process; the limit does not bind root
constexpr int cannot_run = 126;

/// Runs the program where its user may have `most` threads in all.
ProcessResult run_limited(const TemporaryFolder& folder, rlim_t most, std::vector<std::string> words) {
    chmod(folder.path().c_str(), 0777);
    words.insert(words.begin(), DIPTYCH_PROGRAM);
    const std::string err = folder.file("err.txt");
    const pid_t child = fork();
    if (child == 0) {
        umask(0);
        dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), STDERR_FILENO);
        dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
        const rlimit limit = {most, most};
        setrlimit(RLIMIT_NPROC, &limit);
        const bool root = geteuid() == 0;
        if (root && (setgroups(0, nullptr) != 0 || setgid(nobody_else) != 0 || setuid(nobody_else) != 0)) {
            _exit(cannot_run);
        }
        std::vector<char*> pointers;
        for (std::string& word : words) {
            pointers.push_back(word.data());
        }
        pointers.push_back(nullptr);
        execv(pointers[0], pointers.data());
        _exit(cannot_run);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), "", file_text(err)};
}

}  // namespace

TEST_CASE("threads that cannot be started are an error with a reason, not an abort", "[app]") {
    const TemporaryFolder folder;
    if (geteuid() != 0 || run_limited(folder, 1000, {"--version"}).exit_code != 0) {
        SKIP_TEST("needs root, and a program that every user may run");
    }
    const std::string scene = generate_scene(folder, "cornell");
    chmod(scene.c_str(), 0666);
    const std::vector<std::string> render = {"render", scene, "-o", folder.file("a.png"), "--spp", "1", "--size", "16"};
    const ProcessResult free = run_limited(folder, 1000, render);
    INFO(free.err);
    CHECK(free.exit_code == 0);
    for (const rlim_t most : {1, 4}) {
        INFO("at most " << most << " threads");
        const ProcessResult result = run_limited(folder, most, render);
        CHECK(result.exit_code == 2);
        CHECK(contains(result.err, "a.png: cannot write: "));
        CHECK(contains(result.err, " threads can be started: the limit of processes"));
    }
    const ProcessResult verify = run_limited(folder, 1, {"verify", scene, "--backends", "cpu", "--integrators", "brdf",
                                                         "--spp", "4", "--size", "16", "--runs", "2"});
    CHECK(verify.exit_code == 2);
    CHECK(contains(verify.err, " threads can be started: the limit of processes"));
}
