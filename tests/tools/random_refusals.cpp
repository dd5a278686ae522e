// verify --random where a scene cannot be rendered: a finding that is written, not the end of the run.
#include "catch.h"

#include <filesystem>
#include <string>
#include <vector>

#include "../common/image_fixtures.h"
#include "session/make_renderer.h"
#include "backend/cpu_renderer.h"
#include "error.h"
#include "commands/program.h"

using namespace diptych::core;
using diptych::core::image_tests::TemporaryFolder;

namespace {

/// The exit code of judging two still scenes, the first of which `error` refuses.
template <typename Refusal>
int judge_two(const std::string& folder) {
    std::size_t made = 0;
    app::replace_renderers([&made](const Scene&, const PackedScene& packed,
                                   const RenderRequest&) -> std::unique_ptr<Renderer> {
        if (made++ == 0) {
            throw Refusal("scene.gltf: planted");
        }
        return make_cpu_renderer(packed, 1);
    });
    std::vector<std::string> words = {"diptych", "verify", "--random", "2", "--seed", "7", "--still", "--backends",
                                      "cpu", "--integrators", "path", "--runs", "8", "--max-half-width", "8", "-o",
                                      folder};
    std::vector<char*> pointers;
    for (std::string& word : words) {
        pointers.push_back(word.data());
    }
    const int exit_code = app::run_program(static_cast<int>(pointers.size()), pointers.data());
    app::replace_renderers({});
    CHECK(made > (exit_code == 1 ? 2 : 0));  // the second scene was judged too
    return exit_code;
}

}  // namespace

TEST_CASE("verify --random writes a scene that is refused, judges the others and fails") {
    const TemporaryFolder folder;
    CHECK(judge_two<Error>((folder / "out").string()) == 1);
    CHECK(std::filesystem::exists((folder / "out").string() + "/random-7-refused.gltf"));
    CHECK_FALSE(std::filesystem::exists((folder / "out").string() + "/random-8-refused.gltf"));
}

TEST_CASE("verify --random ends where there is no device") {
    const TemporaryFolder folder;
    CHECK(judge_two<NoDevice>((folder / "out").string()) == 3);
}
