// Renders that several processes share, under mpirun.
#include "catch.h"

#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "image/layered_image.h"
#include "process.h"
#include "render/film_file.h"
#include "skipping.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

using Arguments = std::vector<std::string>;

const std::string mpirun = "/usr/bin/mpirun";

bool has_mpi() {
    const std::filesystem::path beside = std::filesystem::path(DIPTYCH_PROGRAM).parent_path() / "libdiptych_mpi.so";
    return std::filesystem::exists(beside) && std::filesystem::exists(mpirun);
}

/// Debian's mpirun does not run as root, nor more ranks than cores, unless it is told to.
// Open MPI 4 asks for ssh even where no other machine is named, and ends without it. `true` is never run.
const Arguments mpi_environment = {"OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
                                   "OMPI_MCA_plm_rsh_agent=true"};

Arguments on_ranks(int ranks, const Arguments& arguments, const Arguments& options = {}) {
    Arguments all = {"--oversubscribe", "--bind-to", "none", "-n", std::to_string(ranks)};
    return with(with(all, options), with({DIPTYCH_PROGRAM}, arguments));
}

ProcessResult run_on_ranks(const TemporaryFolder& folder, int ranks, const Arguments& arguments) {
    return run_diptych(folder, on_ranks(ranks, arguments), mpi_environment, mpirun);
}

/// The process of a rank that has `mark` in its command line; 0 where there is none.
pid_t process_of_rank(int rank, const std::string& mark) {
    const auto text_of = [](const std::filesystem::path& path) {
        std::ifstream file(path, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
        const std::string name = entry.path().filename().string();
        if (name.find_first_not_of("0123456789") == std::string::npos &&
            contains(text_of(entry.path() / "cmdline"), mark) &&
            contains(text_of(entry.path() / "environ"), std::string("\0PMIX_RANK=", 11) + std::to_string(rank))) {
            return std::stoi(name);
        }
    }
    return 0;
}

bool wait_for_files(const Arguments& paths) {
    for (int tries = 0; tries < 400; ++tries) {
        if (std::all_of(paths.begin(), paths.end(), [](const auto& path) { return std::filesystem::exists(path); })) {
            return true;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
}

void check_as_by_one_process(const std::string& a, const std::string& b) {
    const LayeredImage first = read_image(a);
    const LayeredImage second = read_image(b);
    for (const char* name : {"spp", "samples", "rays", "nonfinite"}) {
        CHECK(first.metadata.at(name) == second.metadata.at(name));
    }
    CHECK(first.color.data == second.color.data);
    REQUIRE(first.standard_error);
    CHECK(first.standard_error->data == second.standard_error->data);
    CHECK(first.albedo->data == second.albedo->data);
    CHECK(first.depth->data == second.depth->data);
}

/// A picture of a second or two, one thread a rank.
Arguments long_render(const std::string& scene, int spp = 6000) {
    return {"render", scene, "--size", "24", "--spp", std::to_string(spp), "--threads", "1", "-o"};
}

void check_long_render(const std::string& scene, const std::string& path, int spp = 6000) {
    const TemporaryFolder folder;
    const std::string one = folder.file("one.exr");
    REQUIRE(run_diptych(folder, {"render", scene, "--size", "24", "--spp", std::to_string(spp), "-o", one}).exit_code == 0);
    check_as_by_one_process(path, one);
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++count;
    }
    return count;
}

std::vector<std::string> part_files(const TemporaryFolder& folder) {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        if (entry.path().string().ends_with(".part.exr")) {
            files.push_back(entry.path().string());
        }
    }
    return files;
}

}  // namespace

#define NEED_MPI()                                                                                                     \
    do {                                                                                                               \
        if (!has_mpi()) {                                                                                              \
            SKIP_TEST("no mpirun, or built without Open MPI");                                                         \
        }                                                                                                              \
    } while (false)

namespace {

template <typename T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

bool same_sums(const std::string& a, const std::string& b) {
    const std::optional<FilmFile> file_a = read_film(a);
    const std::optional<FilmFile> file_b = read_film(b);
    REQUIRE(file_a);
    REQUIRE(file_b);
    return same_bytes(file_a->film.pixels, file_b->film.pixels) && same_bytes(file_a->film.moments, file_b->film.moments) &&
           same_bytes(file_a->film.first_hits, file_b->film.first_hits);
}

}  // namespace

TEST_CASE("one, two and three ranks give the sums and the picture of one process, to the bit", "[app]") {
    NEED_MPI();
    const std::string backend = GENERATE("cpu", "vulkan", "oracle");
    if (backend == "vulkan" && !program_has_vulkan()) {
        report_left_out("Vulkan: no device with ray tracing, or built without");
        return;
    }
    CAPTURE(backend);
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const Arguments render = {"render", scene, "--backend", backend, "--size", "24x16", "--sums", "--spp",
                              backend == "vulkan" ? "200" : "1500"};
    const std::string one = folder.file("one.exr");
    REQUIRE(run_diptych(folder, with(render, {"-o", one})).exit_code == 0);
    for (const int ranks : backend == "cpu" ? std::vector<int>{1, 2, 3} : std::vector<int>{3}) {
        CAPTURE(ranks);
        const std::string out = folder.file(std::to_string(ranks) + ".exr");
        const ProcessResult result = run_on_ranks(folder, ranks, with(render, {"-o", out, "--json"}));
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        check_as_by_one_process(out, one);
        CHECK(same_sums(out, one));
        const auto json = nlohmann::json::parse(result.out);  // one line, of rank 0
        if (ranks > 1) {
            CHECK(json.at("ranks") == ranks);
            CHECK(contains(json.at("device").get<std::string>(), " x "));  // more than one rank took samples
        }
    }
    CHECK(part_files(folder).empty());
}

namespace {

void kill_a_rank(bool recovers, int spp) {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string out = folder.file("out.exr");
    const Arguments render = long_render(scene, spp);
    const Arguments checkpoint = {"--checkpoint", folder.file("c.exr"), "--every", "0.3"};
    Process process(folder, on_ranks(3, with(with(render, {out}), checkpoint), recovers ? Arguments{"--enable-recovery"} : Arguments{}),
                    mpi_environment, mpirun);
    const Arguments parts = {folder.file("c.rank0.part.exr"), folder.file("c.rank1.part.exr"), folder.file("c.rank2.part.exr")};
    REQUIRE(wait_for_files(parts));
    const pid_t victim = process_of_rank(1, out);
    REQUIRE(victim > 0);
    REQUIRE(kill(victim, SIGKILL) == 0);
    const ProcessResult result = process.finish();
    INFO(result.err);
    if (recovers) {
        CHECK(result.exit_code == 0);
        CHECK(contains(result.err, "rank 1 on "));
        CHECK(contains(result.err, "has died"));
    } else {
        // mpirun ends the others too. Their samples lie in their parts, and the dead rank's in its checkpoint.
        CHECK(result.exit_code != 0);
        CHECK_FALSE(std::filesystem::exists(out));
        std::uint64_t kept = 0;
        for (const std::string& part : part_files(folder)) {
            kept += read_film(part)->samples.count();
        }
        CHECK(kept > 0);
        // One process goes on from what three have left.
        const ProcessResult rest = run_diptych(folder, with(with(render, {out, "--json"}), checkpoint));
        INFO(rest.err);
        REQUIRE(rest.exit_code == 0);
        CHECK(nlohmann::json::parse(rest.out).at("kept_spp") >= kept);
    }
    CHECK(part_files(folder).empty());
    check_long_render(scene, out, spp);
}

}  // namespace

TEST_CASE("a rank that is killed is named, and the others finish its work", "[app]") {
    NEED_MPI();
    kill_a_rank(true, 6000);
}

// mpirun ends the others after a second, by which a fast machine must not be done.
TEST_CASE("a rank that is killed is named, and one process goes on from what all had", "[app][nightly]") {
    NEED_MPI();
    kill_a_rank(false, 60000);
}

namespace {

/// Interrupts a render on two ranks, and goes on with three.
void stop_and_go_on(bool whole_job, int spp) {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string out = folder.file("out.exr");
    const Arguments render = long_render(scene, spp);
    Process process(folder, on_ranks(2, with(render, {out})), mpi_environment, mpirun);
    REQUIRE(process.wait_for_error_text("/" + std::to_string(spp) + " spp", 30));
    if (whole_job) {
        process.send(SIGINT);
    } else {
        REQUIRE(kill(process_of_rank(1, out), SIGTERM) == 0);
    }
    const ProcessResult result = process.finish();
    INFO(result.err);
    CHECK(result.exit_code != 0);
    CHECK_FALSE(std::filesystem::exists(out));
    if (!whole_job) {
        CHECK(result.exit_code == 128 + SIGTERM);
        CHECK(contains(result.out, "out.rank0.part.exr, " + folder.file("out.rank1.part.exr")));
        CHECK(contains(result.out, "mpirun -n 2"));
    }
    CHECK(part_files(folder).size() == 2);
    const ProcessResult rest = run_on_ranks(folder, 3, with(render, {out, "--json"}));
    INFO(rest.err);
    REQUIRE(rest.exit_code == 0);
    CHECK(nlohmann::json::parse(rest.out).at("kept_spp") > 0);
    CHECK(part_files(folder).empty());
    check_long_render(scene, out, spp);
}

}  // namespace

TEST_CASE("a signal to a rank stops all ranks, and the same command goes on from their parts", "[app]") {
    NEED_MPI();
    stop_and_go_on(false, 16000);
}

// mpirun itself passes SIGINT on as SIGTERM, after a second, by which a fast machine must not be done.
TEST_CASE("a signal to mpirun stops all ranks, and the same command goes on from their parts", "[app][nightly]") {
    NEED_MPI();
    stop_and_go_on(true, 60000);
}

TEST_CASE("parts of ranks merge, and are gone on from by --resume", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const Arguments render = {"render", scene, "--size", "16", "-o"};
    // As ranks leave them: each with ranges of its own, between those of the others.
    const auto part = [&](int rank, const Arguments& ranges) {
        Arguments merge = {"merge", "--partial", "-o", folder.file("c.rank" + std::to_string(rank) + ".part.exr")};
        for (const std::string& range : ranges) {
            const std::string file = folder.file(range + ".exr");
            REQUIRE(run_diptych(folder, with(render, {file, "--samples", range})).exit_code == 0);
            merge.push_back(file);
        }
        REQUIRE(run_diptych(folder, merge).exit_code == 0);
    };
    part(0, {"0:4", "9:12"});
    part(1, {"4:7", "15:20"});
    REQUIRE(run_diptych(folder, with(render, {folder.file("one.exr"), "--spp", "30"})).exit_code == 0);
    const std::string parts = folder.file("c.exr");
    const ProcessResult resumed =
        run_diptych(folder, with(render, {folder.file("out.exr"), "--spp", "30", "--resume", parts, "--json"}));
    INFO(resumed.err);
    REQUIRE(resumed.exit_code == 0);
    CHECK(nlohmann::json::parse(resumed.out).at("kept_spp") == 15);
    check_as_by_one_process(folder.file("out.exr"), folder.file("one.exr"));
    const ProcessResult merged = run_diptych(folder, {"merge", folder.file("c.rank0.part.exr"), folder.file("c.rank1.part.exr"),
                                                      "-o", folder.file("merged.exr")});
    check_refusal(merged, 2, {"merged.exr", "7:9", "12:15"});
}

TEST_CASE("frames of a sequence are divided among ranks", "[app]") {
    NEED_MPI();
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "moving-light");
    const Arguments render = {"render", scene, "--size", "16", "--spp", "4", "--frames", "5", "--fps", "2", "--json", "-o"};
    REQUIRE(run_diptych(folder, with(render, {folder.file("one.#.exr")})).exit_code == 0);
    const std::string out = folder.file("f.#.exr");
    const ProcessResult result = run_on_ranks(folder, 2, with(render, {out}));
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out);
    REQUIRE(json.size() == 5);
    for (std::size_t frame = 0; frame < 5; ++frame) {
        CHECK(json[frame].at("frame") == frame);
        const std::string name = std::to_string(frame) + ".exr";
        check_as_by_one_process(folder.file("f." + name), folder.file("one." + name));
    }
    std::filesystem::remove(folder.file("f.3.exr"));
    CHECK(nlohmann::json::parse(run_on_ranks(folder, 2, with(render, {out})).out).size() == 1);
}

TEST_CASE("ranks refuse what they cannot share, with one line", "[app]") {
    NEED_MPI();
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const auto refuse = [&](const Arguments& more, const Arguments& words) {
        const ProcessResult result = run_on_ranks(folder, 2, with({"render", scene, "-o", folder.file("o.exr"), "--size", "8"}, more));
        INFO(result.err);
        CHECK(result.exit_code == 2);
        CHECK(count_of(result.err, "diptych: ") == 1);
        for (const std::string& word : words) {
            CHECK(contains(result.err, word));
        }
    };
    refuse({"--integrator", "restir"}, {"--integrator restir", "--no-temporal", "--first-frame"});
    refuse({"--target-error", "0.1"}, {"--target-error", "--spp"});
    refuse({"--spp", "0"}, {"--spp"});
}

TEST_CASE("a process that a launcher started says what is missing where it cannot join the others", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const Arguments render = {"render", scene, "-o", folder.file("o.exr"), "--size", "8", "--spp", "1"};
    // The program without the library beside it.
    const std::string alone = folder.file("diptych");
    std::filesystem::copy(DIPTYCH_PROGRAM, alone);
    std::filesystem::copy(std::filesystem::path(DIPTYCH_PROGRAM).parent_path() / "libdiptych_images.so",
                          folder.file("libdiptych_images.so"));
    CHECK(run_diptych(folder, render, {}, alone).exit_code == 0);
    check_refusal(run_diptych(folder, render, {"OMPI_COMM_WORLD_SIZE=2"}, alone), 2, {"mpirun", "libdiptych_mpi.so"});
}
