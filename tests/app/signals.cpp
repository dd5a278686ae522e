// What schedulers and terminals send to a program that works.
#include "catch.h"

#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>

#include "image/layered_image.h"
#include "process.h"

using namespace diptych::core;
using namespace diptych::core::tests;

TEST_CASE("each signal of a scheduler saves the work so far and ends with 128 + its number", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    struct Run {
        int signal;
        std::string out;
        std::unique_ptr<Process> process;
    };
    std::vector<Run> runs;
    for (const int signal : {SIGTERM, SIGHUP, SIGXCPU}) {
        const std::string out = folder.file(std::to_string(signal) + ".exr");
        const std::vector<std::string> arguments = {"render", scene, "-o",       out,
                                                    "--spp",  "100000000", "--size", "16", "--json"};
        runs.push_back({signal, out, std::make_unique<Process>(folder, arguments)});
    }
    Process deaf(folder, {"-c", "trap '' HUP; exec \"$0\" \"$@\"", DIPTYCH_PROGRAM, "render", scene, "-o",
                          folder.file("nohup.exr"), "--time", "3", "--size", "16"},
                 {}, "/bin/sh");
    REQUIRE(deaf.wait_for_error_text("spp", 60));
    deaf.send(SIGHUP);
    for (Run& run : runs) {
        INFO("signal " << run.signal);
        REQUIRE(run.process->wait_for_error_text("spp", 60));
        run.process->send(run.signal);
        const ProcessResult result = run.process->finish();
        INFO(result.err);
        CHECK(result.exit_code == 128 + run.signal);
        CHECK(nlohmann::json::parse(result.out).at("interrupted") == true);
        CHECK(read_image(folder.file(std::to_string(run.signal) + ".part.exr")).metadata.at("interrupted") == "yes");
    }
    CHECK(deaf.finish().exit_code == 0);
    CHECK(read_image(folder.file("nohup.exr")).metadata.at("interrupted") == "no");
}

TEST_CASE("a signal ends a command that has nothing to save with 128 + its number", "[app]") {
    const TemporaryFolder folder;
    Process process(folder, {"generate", "many-lights", "--count", "20000000", "-o", folder.file("street.glb")});
    REQUIRE(process.wait_for_handler(SIGTERM, 60));
    process.send(SIGTERM);
    const ProcessResult result = process.finish();
    CHECK(result.exit_code == 128 + SIGTERM);
    CHECK(result.err == "diptych: interrupted\n");
    CHECK_FALSE(std::filesystem::exists(folder.file("street.glb")));
}
