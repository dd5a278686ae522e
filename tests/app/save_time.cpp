// How long a large picture takes from the signal to the end of the program.
#include "catch.h"

#include <csignal>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

#include <sys/resource.h>
#include <unistd.h>

#include "clock.h"
#include "process.h"
#include "render/film_file.h"
#include "threads.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

double ticks() {
    return static_cast<double>(sysconf(_SC_CLK_TCK));
}

/// Processor seconds of a process that runs.
double processor_seconds(int process) {
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    std::string text;
    std::getline(file, text);
    std::istringstream fields(text.substr(text.rfind(')') + 1));
    std::string skipped;
    for (int field = 3; field < 14; ++field) {
        fields >> skipped;
    }
    double user = 0;
    double system = 0;
    fields >> user >> system;
    return (user + system) / ticks();
}

/// Of all processes that this one has waited for.
double processor_seconds_of_children() {
    rusage use = {};
    getrusage(RUSAGE_CHILDREN, &use);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(use.ru_utime) + seconds(use.ru_stime);
}

/// Of all processes on the machine.
double processor_seconds_of_machine() {
    std::ifstream file("/proc/stat");
    std::string name;
    double user = 0, nice = 0, system = 0;
    file >> name >> user >> nice >> system;
    return (user + nice + system) / ticks();
}

}  // namespace

TEST_CASE("after a signal, a picture of 4096x4096 with all layers is saved within two seconds", "[app][nightly]") {
    const TemporaryFolder folder;
    const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    if (memory < 6e9 || static_cast<double>(std::filesystem::space(folder.path()).available) < 4e9) {
        SKIP_TEST("the picture needs 5 GB of memory and 4 GB of the disk");
    }
    const std::string scene = generate_scene(folder, "cornell");
    const double children_before = processor_seconds_of_children();
    Process process(folder, {"render", scene, "--size", "4096x4096", "--max-depth", "2", "--spp", "100000", "-o",
                             folder.file("large.exr")});
    REQUIRE(process.wait_for_error_text("spp", 300));
    const double before = processor_seconds(process.id());
    const double machine_before = processor_seconds_of_machine();
    const Stopwatch watch;
    process.send(SIGTERM);
    const ProcessResult result = process.finish();
    const double wall = watch.seconds();
    const double own = processor_seconds_of_children() - children_before - before;
    const double others = processor_seconds_of_machine() - machine_before - own;
    INFO(result.err);
    REQUIRE(result.exit_code == 128 + SIGTERM);
    fmt::print("saved in {:.2f} s, {:.2f} s of processors; other processes took {:.2f} s\n", wall, own, others);
    CHECK(own < 2.0 * machine_threads());
    if (others < 0.1 * wall * machine_threads()) {
        CHECK(wall < 2);
    }
    const std::optional<FilmFile> film = read_film(folder.file("large.part.exr"));
    REQUIRE(film);
    CHECK(samples_of_every_pixel(film->film) >= 1);
}
