#include "catch.h"

#include "process.h"

using namespace diptych::core::tests;

TEST_CASE("every command has help with examples", "[app]") {
    const TemporaryFolder folder;
    for (const std::string command : {"render", "compare", "info", "generate", "bench", "verify", "converge"}) {
        const ProcessResult result = run_diptych(folder, {command, "--help"});
        INFO(command);
        CHECK(result.exit_code == 0);
        CHECK(result.err.empty());
        CHECK(contains(result.out, "Examples:\n  diptych " + command));
    }
    const ProcessResult all = run_diptych(folder, {"--help"});
    CHECK(all.exit_code == 0);
    CHECK(contains(all.out, "Examples:"));
    CHECK(contains(all.out, "Exit codes:"));
}

TEST_CASE("the version names the commit", "[app]") {
    const TemporaryFolder folder;
    const ProcessResult result = run_diptych(folder, {"--version"});
    CHECK(result.exit_code == 0);
    CHECK(result.out.rfind("diptych ", 0) == 0);
    CHECK(contains(result.out, "(commit "));
}

TEST_CASE("bad usage is refused in one line with a hint", "[app]") {
    const TemporaryFolder folder;
    check_refusal(run_diptych(folder, {}), 2, {"no command given", "diptych --help"});
    check_refusal(run_diptych(folder, {"rendr", "a.gltf"}), 2, {"no command 'rendr'", "did you mean render?"});
    check_refusal(run_diptych(folder, {"frobnicate"}), 2, {"no command 'frobnicate'", "see diptych --help"});
    check_refusal(run_diptych(folder, {"render", "a.gltf", "-o", "a.exr", "--integratr", "path"}), 2,
                  {"--integratr", "did you mean --integrator?"});
    check_refusal(run_diptych(folder, {"render", "a.gltf"}), 2, {"--output", "see diptych render --help"});
    check_refusal(run_diptych(folder, {"render"}), 2, {"scene", "required"});
    check_refusal(run_diptych(folder, {"compare", "a.exr"}), 2, {"required"});
    check_refusal(run_diptych(folder, {"info"}), 2, {"needs a scene, or --devices"});
    check_refusal(run_diptych(folder, {"bench", "a.gltf", "--frames", "2"}), 2, {"--frames"});
}

TEST_CASE("generate refuses what it cannot do", "[app]") {
    const TemporaryFolder folder;
    check_refusal(run_diptych(folder, {"generate"}), 2, {"needs the NAME", "--list"});
    check_refusal(run_diptych(folder, {"generate", "cornell"}), 2, {"-o FILE"});
    check_refusal(run_diptych(folder, {"generate", "cornell", "-o", folder.file("a.obj")}), 2,
                  {"a.obj", ".gltf or .glb"});
    check_refusal(run_diptych(folder, {"generate", "cornell", "-o", folder.file("no/a.gltf")}), 2, {"no"});
    check_refusal(run_diptych(folder, {"generate", "cornel", "-o", folder.file("a.gltf")}), 2, {"cornel", "veach-mis"});
    check_refusal(run_diptych(folder, {"generate", "many-lights", "-o", folder.file("a.gltf"), "--count", "0"}), 2,
                  {"--count"});
    check_refusal(run_diptych(folder, {"generate", "cornell", "-o", folder.file("a.gltf"), "--count", "5"}), 2,
                  {"cornell", "--count", "many-lights"});
}

TEST_CASE("generate writes every scene that it lists", "[app]") {
    const TemporaryFolder folder;
    const ProcessResult list = run_diptych(folder, {"generate", "--list"});
    REQUIRE(list.exit_code == 0);
    for (const char* name :
         {"cornell", "veach-mis", "brdf-grid", "furnace", "normal-map", "courtyard", "many-lights", "mirror-maze"}) {
        INFO(name);
        CHECK(contains(list.out, name));
        CHECK(std::filesystem::file_size(generate_scene(folder, name)) > 0);
    }
}
