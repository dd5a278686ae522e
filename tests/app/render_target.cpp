#include "catch.h"

#include <csignal>
#include <nlohmann/json.hpp>

#include "image/layered_image.h"
#include "image/metrics.h"
#include "process.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

using Json = nlohmann::json;

ProcessResult render_until(const TemporaryFolder& folder, const std::string& scene, const std::string& output,
                           std::vector<std::string> more) {
    std::vector<std::string> arguments = {"render", scene, "-o", folder.file(output), "--size", "24", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_diptych(folder, arguments);
}

}  // namespace

TEST_CASE("a render with --target-error ends where the error is as small", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::vector<std::string> target = {"--target-error", "0.002", "--sampler", "independent"};
    REQUIRE(render_until(folder, scene, "truth.exr", {"--spp", "1024", "--seed", "99"}).exit_code == 0);
    const LayeredImage truth = read_image(folder.file("truth.exr"));
    double error = 0;
    Json json;
    for (const char* seed : {"0", "1", "2", "3"}) {
        std::vector<std::string> seeded = target;
        seeded.insert(seeded.end(), {"--seed", seed});
        const ProcessResult result = render_until(folder, scene, "out.exr", seeded);
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        json = Json::parse(result.out);
        CHECK(json.at("target_met") == true);
        CHECK(json.at("estimated_relmse").get<double>() <= 0.002);
        CHECK(json.at("estimated_relmse").get<double>() > 0.0017);  // not much further
        CHECK(json.at("interrupted") == false);
        error += compare_images(read_image(folder.file("out.exr")), truth).relmse / 4;
    }
    CHECK(error == Approx(0.002).epsilon(0.3));  // what it was said to be, about
    // The same seed stops at the same count, whatever the number of threads.
    std::vector<std::string> one_thread = target;
    one_thread.insert(one_thread.end(), {"--threads", "1", "--seed", "3"});
    CHECK(Json::parse(render_until(folder, scene, "again.exr", one_thread).out).at("spp") == json.at("spp"));
    const ProcessResult png = render_until(folder, scene, "out.png", {"--target-error", "0.05"});
    REQUIRE(png.exit_code == 0);
    CHECK(Json::parse(png.out).at("command").get<std::string>().find("--no-layers") != std::string::npos);
}

TEST_CASE("an error target yields to other limits, and is refused where it means nothing", "[app][timed]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const auto json = Json::parse(render_until(folder, scene, "out.exr", {"--target-error", "1e-9", "--spp", "40"}).out);
    CHECK(json.at("spp") == 40);
    CHECK(json.at("target_met") == false);
    const double seconds = seconds_taken(0.5, [&] {
        return render_until(folder, scene, "out.exr", {"--target-error", "1e-9", "--time", "0.5"});
    });
    CHECK(seconds == Approx(0.5).epsilon(0.05));
    check_refusal(render_until(folder, scene, "out.exr", {"--target-error", "0.01", "--integrator", "restir"}), 2,
                  {"--target-error", "restir", "resamples a frame as a whole"});
    check_refusal(render_until(folder, scene, "out.exr", {"--target-error", "0.01", "--integrator", "ris"}), 2,
                  {"--target-error", "ris"});
    check_refusal(render_until(folder, scene, "out.exr", {"--target-error", "0.01", "--no-layers"}), 2,
                  {"--no-layers", "standard errors"});
    check_refusal(render_until(folder, scene, "out.exr", {"--target-error", "0.01", "--sampler", "hammersley"}), 2,
                  {"hammersley", "--spp"});
    check_refusal(render_until(folder, scene, "out.exr", {"--target-error", "0"}), 2, {"--target-error"});
    check_refusal(render_until(folder, scene, "out.exr", {"--target-error", "nan"}), 2, {"--target-error"});
}

TEST_CASE("the progress line tells the time left until the error is met", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    Process process(folder, {"render", scene, "-o", folder.file("out.exr"), "--size", "32", "--target-error", "1e-12"});
    REQUIRE(process.wait_for_error_text("relMSE", 60));
    process.send(SIGINT);
    const ProcessResult result = process.finish();
    INFO(result.err);
    CHECK(result.exit_code == 130);
    CHECK(result.err.find("ETA ?") == std::string::npos);
    CHECK(result.err.find("ETA ") != std::string::npos);
}
