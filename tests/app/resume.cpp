// Renders that stop before their end, and go on.
#include "catch.h"

#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "image/layered_image.h"
#include "process.h"
#include "render/film_file.h"
#include "skipping.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

using Arguments = std::vector<std::string>;

/// All that a picture holds, apart from how long it took and what it is called.
void check_same_picture(const std::string& a, const std::string& b) {
    const LayeredImage first = read_image(a);
    const LayeredImage second = read_image(b);
    CHECK(first.metadata.at("spp") == second.metadata.at("spp"));
    CHECK(first.metadata.at("rays") == second.metadata.at("rays"));
    CHECK(first.color.data == second.color.data);
    REQUIRE(first.standard_error);
    CHECK(first.standard_error->data == second.standard_error->data);
    CHECK(first.albedo->data == second.albedo->data);
}

nlohmann::json finished(const TemporaryFolder& folder, const Arguments& arguments) {
    const ProcessResult result = run_diptych(folder, with(arguments, {"--json"}));
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return nlohmann::json::parse(result.out);
}

}  // namespace

TEST_CASE("an interrupted render goes on to the bits of one that was not, by the same command", "[app]") {
    const std::string backend = GENERATE("cpu", "vulkan");
    if (backend == "vulkan" && !program_has_vulkan()) {
        report_left_out("Vulkan: no device with ray tracing, or built without");
        return;
    }
    CAPTURE(backend);
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string out = folder.file("out.exr");
    const std::string part = folder.file("out.part.exr");
    const Arguments render = {"render", scene, "--backend", backend, "--size", "24", "--spp", backend == "cpu" ? "3000" : "400"};
    int interrupts = 0;
    for (; !std::filesystem::exists(out) && interrupts < 20; ++interrupts) {
        Process process(folder, with(render, {"-o", out}));
        std::this_thread::sleep_for(std::chrono::milliseconds(backend == "cpu" ? 250 : 900));
        process.send(SIGINT);
        const ProcessResult result = process.finish();
        INFO(result.err);
        if (std::filesystem::exists(out)) {  // the signal may have come when the picture was done
            break;
        }
        REQUIRE(result.exit_code == 130);
        if (std::filesystem::exists(part)) {
            CHECK(read_metadata(part).at("interrupted") == "yes");
        }
        if (interrupts == 2) {  // that is enough of it
            finished(folder, with(render, {"-o", out}));
        }
    }
    CHECK_FALSE(std::filesystem::exists(part));
    const std::string whole = folder.file("whole.exr");
    finished(folder, with(render, {"-o", whole}));
    check_same_picture(out, whole);
}

TEST_CASE("a killed render goes on from its checkpoint", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string checkpoint = folder.file("c.exr");
    const Arguments render = {"render", scene, "-o", folder.file("out.exr"), "--size", "24", "--spp", "100000"};
    Process process(folder, with(render, {"--checkpoint", checkpoint, "--every", "0.5"}));
    for (int tries = 0; tries < 600 && !std::filesystem::exists(checkpoint); ++tries) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    process.send(SIGKILL);
    CHECK(process.finish().exit_code == 128 + SIGKILL);
    CHECK_FALSE(std::filesystem::exists(folder.file("out.exr")));
    const std::optional<FilmFile> kept = read_film(checkpoint);
    REQUIRE(kept);
    const std::uint64_t samples = kept->samples.count();
    CHECK(samples > 0);
    const std::string more = std::to_string(samples + 40);
    const Arguments rest = {"render", scene, "--size", "24", "--spp", more};
    const auto json = finished(folder, with(rest, {"-o", folder.file("out.exr"), "--checkpoint", checkpoint}));
    CHECK(json.at("kept_spp") == samples);
    CHECK(json.at("spp") == samples + 40);
    CHECK(read_film(checkpoint)->samples.count() == samples + 40);  // which more can be added to
    const auto resumed = finished(folder, with(rest, {"-o", folder.file("again.exr"), "--resume", checkpoint}));
    CHECK(resumed.at("kept_spp") == samples + 40);
    finished(folder, with(rest, {"-o", folder.file("whole.exr")}));
    check_same_picture(folder.file("out.exr"), folder.file("whole.exr"));
    check_same_picture(folder.file("again.exr"), folder.file("whole.exr"));
}

TEST_CASE("a render to an error stops where it would have without the interrupt", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const Arguments render = {"render", scene, "--size", "16", "--target-error", "2e-3"};
    const auto whole = finished(folder, with(render, {"-o", folder.file("whole.exr")}));
    const int spp = whole.at("spp").get<int>();
    REQUIRE(spp > 64);
    // Stopped by a limit instead of a signal, so that the test knows where.
    for (const int stop : {17, spp / 2}) {
        CAPTURE(stop);
        const std::string part = folder.file("part.exr");
        finished(folder, with(render, {"-o", part, "--spp", std::to_string(stop), "--sums", "--overwrite"}));
        const std::string out = folder.file(std::to_string(stop) + ".exr");
        const auto json = finished(folder, with(render, {"-o", out, "--resume", part}));
        CHECK(json.at("kept_spp") == stop);
        CHECK(json.at("spp") == spp);
        check_same_picture(out, folder.file("whole.exr"));
    }
}

TEST_CASE("nothing is replaced by less, and nobody goes on with another picture", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string out = folder.file("out.exr");
    const Arguments render = {"render", scene, "--size", "8", "-o", out};
    finished(folder, with(render, {"--spp", "8", "--sums"}));
    check_refusal(run_diptych(folder, with(render, {"--spp", "4"})), 2, {out, "8 samples", "--overwrite"});
    CHECK(read_metadata(out).at("spp") == "8");
    finished(folder, with(render, {"--spp", "8"}));  // as many may
    finished(folder, with(render, {"--spp", "4", "--overwrite", "--sums"}));
    CHECK(read_metadata(out).at("spp") == "4");

    const auto refuse = [&](const Arguments& more, const Arguments& words) {
        const std::string other = folder.file("other.exr");
        check_refusal(run_diptych(folder, with({"render", scene, "--size", "8", "-o", other}, more)), 2, words);
    };
    refuse({"--spp", "8", "--resume", out, "--seed", "3"}, {out, "seed is 0 and 3"});
    refuse({"--spp", "2", "--resume", out}, {out, "holds 4 samples", "more than the 2"});
    refuse({"--spp", "8", "--resume", folder.file("none.exr")}, {"none.exr", "no such file"});
    finished(folder, {"render", scene, "--size", "8", "-o", folder.file("plain.exr"), "--spp", "2"});
    refuse({"--spp", "8", "--resume", folder.file("plain.exr")}, {"plain.exr", "without the sums"});
    // What lies beside the output is looked at too.
    std::filesystem::copy(out, folder.file("other.part.exr"));
    refuse({"--spp", "8", "--max-depth", "2"}, {"other.part.exr", "max_depth is 8 and 2", "--overwrite"});
    const auto json = finished(folder, {"render", scene, "--size", "8", "-o", folder.file("other.exr"), "--spp", "8"});
    CHECK(json.at("kept_spp") == 4);
    CHECK_FALSE(std::filesystem::exists(folder.file("other.part.exr")));
}

TEST_CASE("a sequence skips its finished frames", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "moving-light");
    const Arguments render = {"render", scene, "--size", "8", "--spp", "2", "--frames", "4", "--fps", "2"};
    const auto sequence = [&](const std::string& name, const Arguments& more) {
        return finished(folder, with(render, with({"-o", folder.file(name)}, more)));
    };
    CHECK(sequence("a.#.exr", {}).size() == 4);
    CHECK(sequence("a.#.exr", {}).empty());
    const std::string third = folder.file("a.2.exr");
    std::filesystem::rename(third, folder.file("kept.exr"));
    const auto json = sequence("a.#.exr", {});
    REQUIRE(json.size() == 1);
    CHECK(json[0].at("frame") == 2);
    check_same_picture(third, folder.file("kept.exr"));
    CHECK(sequence("a.#.exr", {"--overwrite"}).size() == 4);
    check_refusal(run_diptych(folder, with(render, {"-o", folder.file("a.#.exr"), "--seed", "9"})), 2,
                  {"a.0.exr", "another picture", "seed"});
    // Frames of ranges are those of the whole.
    CHECK(sequence("b.#.exr", {"--first-frame", "3"}).size() == 1);
    check_same_picture(folder.file("b.3.exr"), folder.file("a.3.exr"));
    check_refusal(run_diptych(folder, with(render, {"-o", folder.file("b.#.exr"), "--first-frame", "4"})), 2,
                  {"--first-frame 4", "4 frames"});
}

TEST_CASE("a sequence of restir goes on to the same bits, or begins a few frames earlier", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "moving-light");
    const auto sequence = [&](const std::string& name, const Arguments& more) {
        const Arguments all = {"render", scene, "--size", "8", "--spp", "1", "--frames", "4", "--integrator", "restir",
                               "-o", folder.file(name)};
        return finished(folder, with(all, more));
    };
    const auto color = [&](const std::string& name) { return read_image(folder.file(name)).color.data; };
    sequence("a.#.exr", {});
    std::filesystem::rename(folder.file("a.2.exr"), folder.file("kept.exr"));
    CHECK(sequence("a.#.exr", {}).size() == 1);
    CHECK(color("a.2.exr") == color("kept.exr"));
    // Split by ranges: the frame that a range begins with has looked back to the warm-up's frames alone.
    CHECK(sequence("b.#.exr", {"--first-frame", "2", "--warm-up", "2"}).size() == 2);
    const std::string command = read_metadata(folder.file("b.3.exr")).at("command");
    std::vector<std::string> words = words_of(command);
    words.erase(words.begin());
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        words[i + 1] = words[i] == "-o" ? folder.file("alone.exr") : words[i + 1];
    }
    REQUIRE(run_diptych(folder, words).exit_code == 0);
    CHECK(color("alone.exr") == color("b.3.exr"));
}

TEST_CASE("A hundred kills lose nothing that was written", "[app][nightly]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string checkpoint = folder.file("c.exr");
    const Arguments render = {"render", scene, "--size", "48", "--spp", "20000"};
    std::mt19937 random(std::random_device{}());
    std::uint64_t samples = 0;
    int kills = 0;
    for (; kills < 100; ++kills) {
        Process process(folder, with(render, {"-o", folder.file("out.exr"), "--checkpoint", checkpoint, "--every", "0.05"}));
        std::this_thread::sleep_for(std::chrono::milliseconds(random() % 3000));
        process.send(SIGKILL);
        process.finish();
        if (!std::filesystem::exists(checkpoint)) {
            continue;
        }
        const std::optional<FilmFile> kept = read_film(checkpoint);
        REQUIRE(kept);
        CHECK(kept->samples.count() >= samples);
        samples = kept->samples.count();
    }
    std::printf("%d kills, %d samples per pixel kept\n", kills, static_cast<int>(samples));
    CHECK(samples > 0);
    const Arguments rest = {"render", scene, "--size", "48", "--spp", std::to_string(samples + 5)};
    finished(folder, with(rest, {"-o", folder.file("out.exr"), "--resume", checkpoint, "--overwrite"}));
    finished(folder, with(rest, {"-o", folder.file("whole.exr")}));
    check_same_picture(folder.file("out.exr"), folder.file("whole.exr"));
}
