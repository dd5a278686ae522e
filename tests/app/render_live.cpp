// A viewer on the network sees the render grow.
#include "catch.h"
#include "image/layered_image.h"
#include "process.h"
#include "tev_receiver.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

std::vector<std::string> arguments(const TemporaryFolder& folder, const std::string& endpoint,
                                   const std::vector<std::string>& more) {
    std::vector<std::string> all = {"render", generate_scene(folder, "cornell"), "-o", folder.file("a.exr"), "--live",
                                    endpoint};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

}  // namespace

TEST_CASE("a viewer on the network ends with the picture of the file, to the bit", "[app]") {
    const TemporaryFolder folder;
    for (const std::string backend : {"cpu", "oracle"}) {
        INFO(backend);
        TevReceiver viewer;
        const ProcessResult result = run_diptych(
            folder, arguments(folder, viewer.endpoint(), {"--size", "640x480", "--spp", "1", "--backend", backend}));
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        const auto& images = viewer.finish();
        REQUIRE(images.size() == 1);
        CHECK(images.begin()->first == folder.file("a.exr"));
        const ReceivedImage& image = images.begin()->second;
        CHECK(image.width == 640);
        CHECK(image.height == 480);
        CHECK(image.channels == std::vector<std::string>{"R", "G", "B"});
        CHECK(image.updates >= 4);  // 3.5 MB by bands of 1 MiB
        CHECK(image.data == read_image(folder.file("a.exr")).color.data);
    }
}

TEST_CASE("a viewer sees a render before it ends, and a sequence picture by picture", "[app]") {
    const TemporaryFolder folder;
    {
        TevReceiver viewer;
        const ProcessResult result =
            run_diptych(folder, arguments(folder, viewer.endpoint(), {"--size", "32x24", "--time", "2.5"}));
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        CHECK(viewer.finish().at(folder.file("a.exr")).updates >= 2);
    }
    TevReceiver viewer;
    const ProcessResult result =
        run_diptych(folder, arguments(folder, viewer.endpoint(),
                                      {"--size", "32x24", "--spp", "2", "--frames", "2", "--orbit", "5"}));
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    const auto& images = viewer.finish();
    REQUIRE(images.size() == 2);
    for (const auto& [file, image] : images) {
        CHECK(image.data == read_image(file).color.data);
    }
}

TEST_CASE("a viewer that hangs up costs a warning, not the render", "[app]") {
    const TemporaryFolder folder;
    TevReceiver viewer(1);
    const ProcessResult result = run_diptych(
        folder, arguments(folder, viewer.endpoint(), {"--size", "1024x768", "--spp", "1", "--max-depth", "1"}));
    CHECK(result.exit_code == 0);
    CHECK(result.err.find("the render goes on without it") != std::string::npos);
    CHECK(read_image(folder.file("a.exr")).color.width == 1024);
}

TEST_CASE("a viewer that is not there, or no address, is refused before the work", "[app]") {
    const TemporaryFolder folder;
    std::string nobody;
    {
        const TevReceiver viewer;
        nobody = viewer.endpoint();
    }
    for (const std::string& endpoint :
         {nobody, std::string("localhost"), std::string("localhost:0"), std::string("localhost:70000"),
          std::string("::1:14158"), std::string(":14158"), std::string("localhost:http")}) {
        INFO(endpoint);
        const ProcessResult result =
            run_diptych(folder, arguments(folder, endpoint, {"--size", "16x16", "--spp", "1"}));
        CHECK(result.exit_code == 2);
        CHECK(result.err.find("--live " + endpoint + ":") != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(folder.file("a.exr")));
    }
}
