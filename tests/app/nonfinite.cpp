#include "catch.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "image/layered_image.h"
#include "process.h"
#include "skipping.h"

using namespace diptych::core;
using namespace diptych::core::tests;

TEST_CASE("render warns of samples that it dropped, counts them, and writes what is left", "[app]") {
    const std::string backend = GENERATE("cpu", "vulkan");
    if (backend == "vulkan" && !program_has_vulkan()) {
        report_left_out("Vulkan: no device with ray tracing, or built without");
        return;
    }
    const TemporaryFolder folder;
    const std::string scene = write_bare_triangle(folder);
    // A sky and a sun near the largest float: what the triangle reflects of both overflows. The sky itself does not.
    const ProcessResult result =
        run_diptych(folder, {"render", scene, "-o", folder.file("out.exr"), "--backend", backend, "--env",
                             "3e38,3e38,3e38", "--sun", "180,60,3.3e38", "--integrator", "direct", "--spp", "4", "--size", "16", "--json"});
    INFO(backend << "\n" << result.err);
    REQUIRE(result.exit_code == 0);
    const auto count = nlohmann::json::parse(result.out).at("nonfinite").get<int>();
    CHECK(count > 0);
    CHECK(count < 16 * 16 * 4);
    CHECK(result.err.find("warning: " + folder.file("out.exr") + ": " + std::to_string(count) + " of 1024 samples") !=
          std::string::npos);
    const LayeredImage image = read_image(folder.file("out.exr"));
    CHECK(image.metadata.at("nonfinite") == std::to_string(count));
    for (const float value : image.color.data) {
        REQUIRE(std::isfinite(value));
    }
}
