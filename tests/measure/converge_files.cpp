// Files that converge reads and that another program, or a damaged disk, may have written.
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/stat.h>

#include "../common/generate_fixture.h"
#include "catch.h"
#include "measure/converge/reference.h"
#include "measure/converge/state.h"

using namespace diptych::core;
using diptych::core::generate_tests::TemporaryFolder;

namespace {

template <typename Work>
std::string message_of(const Work& work) {
    try {
        work();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

}  // namespace

TEST_CASE("A damaged state of converge is refused by the name of the file") {
    const TemporaryFolder folder;
    const std::string name = folder.path().string();
    const std::filesystem::path results = folder.path() / "results.jsonl", sums = folder.path() / "cpu-path.sums";
    for (const std::string line : {R"({"kind":"run"})", R"({"kind":"scene","load_seconds":"1"})", "7", "not json"}) {
        INFO(line);
        write_text(results, line + "\n");
        CHECK_THAT(message_of([&] { ConvergeState{name}; }),
                   Catch::Contains(results.string() + ": line 1 is damaged") && Catch::Contains("`output`"));
    }
    std::filesystem::remove(results);
    REQUIRE(mkfifo(results.c_str(), 0600) == 0);
    CHECK_THAT(message_of([&] { ConvergeState{name}; }),
               Catch::Contains(results.string() + ": it is a"));
    std::filesystem::remove(results);

    // Whole in its form, but with a count of values that would take terabytes.
    ConvergeState state(name);
    state.save_sums("cpu:path", {{16, DeviationSums{}}});
    REQUIRE(std::filesystem::exists(sums));
    CHECK(state.load_sums("cpu:path").size() == 1);
    std::fstream file(sums, std::ios::binary | std::ios::in | std::ios::out);
    const std::uint64_t values = std::uint64_t{1} << 31;
    file.seekp(static_cast<std::streamoff>(std::filesystem::file_size(sums) - sizeof values));
    file.write(reinterpret_cast<const char*>(&values), sizeof values);
    file.close();
    CHECK_THAT(message_of([&] { state.load_sums("cpu:path"); }), Catch::Contains(sums.string() + ": ") && Catch::Contains("damaged"));
}

TEST_CASE("A reference says how many samples it has, or nothing") {
    LayeredImage picture;
    picture.color = make_image(1, 1, 3);
    CHECK(reference_of(picture, "a.exr").spp == 0);
    picture.metadata["spp"] = "4294967295";
    CHECK(reference_of(picture, "a.exr").spp == 4294967295U);
    for (const char* text : {"many", "-5", "4294967296", "64 ", "0x40"}) {
        INFO(text);
        picture.metadata["spp"] = text;
        CHECK_THAT(message_of([&] { reference_of(picture, "a.exr"); }),
                   Catch::Contains("a.exr: its metadata spp is '" + std::string(text) + "'"));
    }
}
