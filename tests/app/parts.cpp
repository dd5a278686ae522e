// Parts of a picture's samples, and `merge`.
#include "catch.h"

#include <algorithm>

#include "image/layered_image.h"
#include "process.h"
#include "render/film_file.h"
#include "render/save_film.h"
#include "skipping.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

std::vector<std::string> render(const std::string& scene, const std::string& out, const std::vector<std::string>& more) {
    return with({"render", scene, "-o", out, "--size", "24x16"}, more);
}

void check_same_picture(const std::string& a, const std::string& b) {
    const LayeredImage first = read_image(a);
    const LayeredImage second = read_image(b);
    CHECK(first.color.data == second.color.data);
    REQUIRE(first.standard_error);
    CHECK(first.standard_error->data == second.standard_error->data);
    CHECK(first.albedo->data == second.albedo->data);
    CHECK(first.normal->data == second.normal->data);
    CHECK(first.depth->data == second.depth->data);
    for (const char* name : {"spp", "samples", "rays", "nonfinite", "seed"}) {
        CAPTURE(name);
        CHECK(first.metadata.count(name) == second.metadata.count(name));
        CHECK(first.metadata.at(name) == second.metadata.at(name));
    }
}

}  // namespace

TEST_CASE("parts of the samples merge to the picture of one run, to the bit", "[app]") {
    const std::string backend = GENERATE("cpu", "vulkan", "oracle");
    if (backend == "vulkan" && !program_has_vulkan()) {
        report_left_out("Vulkan: no device with ray tracing, or built without");
        return;
    }
    CAPTURE(backend);
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const auto part = [&](const std::string& name, const std::vector<std::string>& more) {
        const ProcessResult result = run_diptych(folder, render(scene, folder.file(name), with({"--backend", backend}, more)));
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        return folder.file(name);
    };
    const std::string whole = part("whole.exr", {"--spp", "20"});
    const std::string first = part("0.exr", {"--samples", "0:3"});
    const std::string second = part("1.exr", {"--samples", "3:17"});
    const std::string last = part("2.exr", {"--samples", "17:20"});
    const std::string merged = folder.file("merged.exr");
    const ProcessResult result = run_diptych(folder, {"merge", last, first, second, "-o", merged});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    check_same_picture(merged, whole);
    CHECK_FALSE(read_film(merged));
    // A tree of merges, whose inner nodes keep their sums.
    REQUIRE(run_diptych(folder, {"merge", first, last, "-o", folder.file("ends.exr"), "--partial"}).exit_code == 0);
    REQUIRE(run_diptych(folder, {"merge", second, folder.file("ends.exr"), "-o", folder.file("tree.exr")}).exit_code == 0);
    check_same_picture(folder.file("tree.exr"), whole);
    // The command that the metadata hold makes it again.
    const std::string command = read_metadata(merged).at("command");
    CHECK(contains(command, "--spp 20"));
    CHECK(contains(command, "-o " + merged));
}

TEST_CASE("merge names the part that does not belong, and the samples that are missing", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const auto part = [&](const std::string& name, const std::vector<std::string>& more) {
        const ProcessResult result = run_diptych(folder, render(scene, folder.file(name), more));
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        return folder.file(name);
    };
    const std::string first = part("first.exr", {"--samples", "0:2"});
    const std::string out = folder.file("out.exr");
    const auto refuse = [&](const std::vector<std::string>& parts, const std::vector<std::string>& words) {
        check_refusal(run_diptych(folder, with({"merge"}, with(parts, {"-o", out}))), 2, words);
        CHECK_FALSE(std::filesystem::exists(out));
    };
    refuse({first, part("gap.exr", {"--samples", "4:6"})}, {out, "2:4", "--partial"});
    refuse({part("end.exr", {"--samples", "2:4"})}, {out, "0:2"});
    refuse({first, part("overlap.exr", {"--samples", "1:3"})}, {"overlap.exr", "first.exr", "1:2"});
    refuse({first, part("seed.exr", {"--samples", "2:4", "--seed", "7"})}, {"seed.exr", "seed is 0 and 7"});
    refuse({first, part("depth.exr", {"--samples", "2:4", "--max-depth", "3"})}, {"depth.exr", "max_depth is 8 and 3"});
    refuse({first, part("plain.exr", {"--spp", "2"})}, {"plain.exr", "--samples"});
    refuse({first, part("layers.exr", {"--samples", "2:4", "--no-layers"})}, {"layers.exr", "first_hit_layers"});
    const std::string other = generate_scene(folder, "furnace");
    const ProcessResult elsewhere =
        run_diptych(folder, render(other, folder.file("other.exr"), {"--samples", "2:4"}));
    REQUIRE(elsewhere.exit_code == 0);
    refuse({first, folder.file("other.exr")}, {"other.exr", "first.exr"});
    check_refusal(run_diptych(folder, {"merge", first, "-o", first}), 2, {first, "one of the parts"});
    // Of another version of the program.
    FilmFile old = *read_film(first);
    old.metadata["program"] = "diptych 0.0.1";
    old.metadata["samples"] = "2:4";
    save_film_file(old, folder.file("old.exr"), true);
    refuse({first, folder.file("old.exr")}, {"old.exr", "diptych 0.0.1"});
}

TEST_CASE("a part whose sums are damaged is refused by name", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string part = folder.file("part.exr");
    REQUIRE(run_diptych(folder, render(scene, part, {"--samples", "0:2"})).exit_code == 0);
    const LayeredImage layers = read_image(part);
    FilmFile other = *read_film(part);
    other.film.pixels[5].sum.low[1].x ^= 4U;
    save_film_file(other, folder.file("other.exr"), true);  // a whole file: its digests are those of its sums
    CHECK(read_film(folder.file("other.exr")));
    const std::string bytes = file_text(part);
    std::size_t refused = 0;
    for (const double place : {0.3, 0.5, 0.6, 0.7, 0.8, 0.9}) {
        std::string damaged = bytes;
        damaged[static_cast<std::size_t>(place * static_cast<double>(bytes.size()))] ^= 16;
        write_text(folder.file("damaged.exr"), damaged);
        const ProcessResult result = run_diptych(folder, {"merge", folder.file("damaged.exr"), "-o", folder.file("o.exr")});
        INFO(place << ": " << result.err);
        if (result.exit_code == 0) {  // the damage is in what was developed from the sums, which is not read
            CHECK(read_image(folder.file("o.exr")).color.data == layers.color.data);
            continue;
        }
        CHECK(result.exit_code == 2);
        CHECK(contains(result.err, "damaged.exr: "));
        ++refused;
    }
    CHECK(refused > 0);
    // A digit out of all range, which merging would count up to.
    other.film.pixels[0].sum.base = ~0U;
    other.metadata["interrupted"] = "yes";  // else the picture is made of the sums, which counts up to the digit too
    save_film_file(other, folder.file("range.exr"), true);
    check_refusal(run_diptych(folder, {"merge", folder.file("range.exr"), "-o", folder.file("o.exr")}), 2,
                  {"range.exr", "out of range"});
}

TEST_CASE("a part of the samples is refused where samples cannot be taken apart", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const auto refuse = [&](const std::string& out, const std::vector<std::string>& more,
                            const std::vector<std::string>& words) {
        check_refusal(run_diptych(folder, render(scene, folder.file(out), more)), 2, words);
    };
    refuse("p.exr", {"--samples", "0:4", "--integrator", "restir"}, {"--samples", "--no-temporal", "--first-frame"});
    refuse("p.exr", {"--samples", "4:4"}, {"4:4"});
    refuse("p.exr", {"--samples", "0:4", "--time", "1"}, {"--samples", "--time"});
    refuse("p.exr", {"--samples", "0:4", "--frames", "2"}, {"--samples", "--first-frame"});
    refuse("p.exr", {"--samples", "0:4", "--sampler", "hammersley"}, {"--samples", "--sample-count"});
    refuse("p.png", {"--samples", "0:4"}, {"p.png", ".exr"});
    refuse("p.exr", {"--every", "2"}, {"--every", "--checkpoint"});
    refuse("p.exr", {"--checkpoint", folder.file("c.png")}, {"c.png", ".exr"});
}
