// The command lines that pictures carry.
#include "catch.h"

#include "common/request_of_everything.h"
#include "console/repeat_command.h"

using namespace diptych::core;
using namespace diptych::core::app;
using diptych::core::tests::request_of_everything;

namespace {

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("the repeating command holds every setting and survives a shell", "[tools]") {
    const std::string command = repeat_command(request_of_everything(), 77);
    INFO(command);
    CHECK(contains(command, "diptych render 'a scene'\\''s.gltf' --ignore-extension EXT_one --ignore-extension EXT_two "
                            "--allow-external --memory-limit 1099511627776 -o out.exr "));
    for (const char* part : {"--backend vulkan",   "--device 1",         "--integrator direct",
                             "--spp 77",           "--size 640x480",     "--max-depth 8",
                             "--seed 4294967295",  "--brdf blinn-phong", "--sampler hammersley",
                             "--sample-count 256", "--mis balance",      "--camera 'Front view'",
                             "--env 0.1,0.2,0.3",  "--env-scale 0.1",    "--env-rotate -30",
                             "--aperture 0.01",    "--eye 1,-2.5,3e-07", "--look-at 0,0.1,0",
                             "--up 0,0,1",         "--fov 33.5",         "--view-height 4",
                             "--sun -20,35.5,3",   "--focus 2.5",        "--exposure -1.5",
                              "--tonemap aces",     "--no-layers",        "--generic",
                              "--clip 'slow walk'"}) {
        INFO(part);
        CHECK(contains(command, part));
    }
}

TEST_CASE("the command repeats the sky that a scene was given, whatever decides on it then", "[tools]") {
    RenderRequest request;
    CHECK_FALSE(contains(repeat_command(request, 1), "--env"));
    request.adds_neutral_sky = true;
    CHECK(contains(repeat_command(request, 1), "--env neutral"));
}

TEST_CASE("a picture of this program carries its command", "[tools]") {
    RenderOutcome outcome;
    outcome.maker = this_program();
    outcome.spp = 77;
    const auto metadata = render_metadata(request_of_everything(), outcome);
    CHECK(metadata.at("command") == repeat_command(request_of_everything(), 77));
    CHECK(contains(metadata.at("program"), "diptych "));
}
