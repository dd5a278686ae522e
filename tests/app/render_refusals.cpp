#include "catch.h"

#include <algorithm>

#include "process.h"

using namespace diptych::core::tests;

namespace {

ProcessResult render(const TemporaryFolder& folder, const std::string& scene, std::vector<std::string> more) {
    std::vector<std::string> arguments = {"render", scene, "--spp", "1", "--size", "8"};
    if (std::find(more.begin(), more.end(), "-o") == more.end()) {
        more.insert(more.begin(), {"-o", folder.file("out.exr")});
    }
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_diptych(folder, arguments);
}

}  // namespace

TEST_CASE("render refuses files that it cannot read or write", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    check_refusal(render(folder, folder.file("missing.gltf"), {}), 2, {"missing.gltf", "no such file"});
    check_refusal(render(folder, scene, {"-o", folder.file("no/out.exr")}), 2, {"no/out.exr", "folder"});
    check_refusal(render(folder, scene, {"-o", folder.file("out.jpg")}), 2, {"out.jpg", ".exr"});
    check_refusal(render(folder, scene, {"--env", folder.file("missing.hdr")}), 2, {"missing.hdr", "no such file"});
    write_text(folder.file("broken.gltf"), "{\"asset\": ");
    check_refusal(render(folder, folder.file("broken.gltf"), {}), 2, {"broken.gltf"});
    CHECK_FALSE(std::filesystem::exists(folder.file("out.exr")));
}

TEST_CASE("render refuses an unwritable output before it looks at the scene", "[app]") {
    const TemporaryFolder folder;
    check_refusal(render(folder, folder.file("missing.gltf"), {"-o", folder.file("no/out.exr")}), 2, {"no/out.exr"});
}

TEST_CASE("render refuses options out of range or at odds", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const auto refused = [&](std::vector<std::string> more, const std::vector<std::string>& parts) {
        INFO(more[0]);
        check_refusal(render(folder, scene, std::move(more)), 2, parts);
    };
    refused({"--integrator", "bdpt"}, {"--integrator bdpt", "brdf, direct, path"});
    refused({"--brdf", "phong"}, {"--brdf phong", "ggx, blinn-phong"});
    refused({"--sampler", "halton"}, {"--sampler halton", "sobol"});
    refused({"--mis", "max"}, {"--mis max", "power, balance"});
    refused({"--light-sampler", "near"}, {"--light-sampler near", "uniform, power, spatial"});
    refused({"--tonemap", "reinhard"}, {"reinhard", "pbr-neutral"});
    refused({"--backend", "metal"}, {"--backend metal", "cpu, vulkan"});
    refused({"--camera", "Left"}, {"no camera 'Left'", "0 'camera'"});
    refused({"--camera", "7"}, {"no camera '7'", "0 'camera'"});
    refused({"--eye", "1,2,3"}, {"--eye", "--look-at"});
    refused({"--look-at", "1,2,3"}, {"--look-at", "--eye"});
    refused({"--up", "0,0,1"}, {"--up", "--eye"});
    refused({"--eye", "1,2,3", "--look-at", "1,2,3"}, {"--eye", "one point"});
    refused({"--eye", "0,3,0", "--look-at", "0,0,0"}, {"--up", "parallel"});
    refused({"--eye", "1,2", "--look-at", "0,0,0"}, {"--eye"});
    refused({"--eye", "1,2,nan", "--look-at", "0,0,0"}, {"--eye", "finite"});
    refused({"--fov", "180"}, {"--fov", "179"});
    refused({"--view-height", "2"}, {"--view-height", "not orthographic"});
    refused({"--sun", "0,91,1"}, {"--sun 0,91,1", "elevation"});
    refused({"--sun", "0,45,-1"}, {"--sun 0,45,-1", "irradiance"});
    refused({"--time", "3"}, {"--time", "--spp"});
    refused({"--device", "0"}, {"--device", "--backend vulkan"});
    refused({"--validation"}, {"--validation", "--backend vulkan"});
    refused({"--backend", "vulkan", "--threads", "2"}, {"--threads", "--backend cpu"});
    refused({"--backend", "oracle", "--device", "0"}, {"--device", "--backend vulkan"});
    refused({"--backend", "oracle", "--integrator", "path"}, {"--integrator", "--backend oracle", "--oracle-mode"});
    refused({"--backend", "oracle", "--mis", "power"}, {"--mis", "--backend oracle", "--oracle-mode"});
    refused({"--backend", "oracle", "--oracle-mode", "light"}, {"--oracle-mode light", "mis, bsdf, hemisphere, area"});
    refused({"--oracle-mode", "area"}, {"--oracle-mode", "--backend oracle"});
    refused({"--threads", "0"}, {"--threads"});
    refused({"--env", "1,2"}, {"--env 1,2", "R,G,B"});
    refused({"--env", "1,-2,3"}, {"--env 1,-2,3", "negative"});
    refused({"--env-scale", "2"}, {"no", "give --env"});
    refused({"--env", "1,1,1", "--env-scale", "nan"}, {"--env-scale", "nan"});
    refused({"--env", "1,1,1", "--env-scale", "inf"}, {"--env-scale", "inf"});
    refused({"--env-rotate", "nan"}, {"--env-rotate", "nan"});
    refused({"--exposure", "nan"}, {"--exposure", "nan"});
    refused({"--aperture", "nan"}, {"--aperture", "nan"});
    refused({"--env", scene}, {"environment map"});
    write_text(folder.file("sky.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16000 +X 16000\n");
    refused({"--env", folder.file("sky.hdr")}, {"environment map", "sky.hdr", "at least 128000 bytes"});
    refused({"--env", folder.file("sky.hdr:beauty")}, {"sky.hdr", "no layer 'beauty'"});
    refused({"--aperture", "0.1"}, {"--aperture", "--focus"});
    refused({"--seed", "-1"}, {"--seed"});
    refused({"--layers", "-o", folder.file("out.png")}, {"--layers", "out.png", ".exr"});
    CHECK_FALSE(std::filesystem::exists(folder.file("out.exr")));
    CHECK_FALSE(std::filesystem::exists(folder.file("out.png")));
}

TEST_CASE("render refuses bad sizes and counts", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string out = folder.file("out.exr");
    for (const std::string size : {"0x8", "8x", "x8", "8x8x8", "-8x8", "8.5x8", "big", "99999x8", "30000x30000"}) {
        INFO(size);
        check_refusal(run_diptych(folder, {"render", scene, "-o", out, "--size=" + size}), 2, {"--size " + size});
    }
    check_refusal(run_diptych(folder, {"render", scene, "-o", out, "--spp", "0"}), 2, {"--spp"});
    check_refusal(run_diptych(folder, {"render", scene, "-o", out, "--spp", "many"}), 2, {"--spp"});
    check_refusal(run_diptych(folder, {"render", scene, "-o", out, "--sampler", "hammersley", "--time", "1"}), 2,
                  {"--sampler hammersley", "--sample-count"});
    CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("without a Vulkan device the Vulkan backend is refused and the CPU works", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string missing = folder.file("no-driver.json");
    const std::vector<std::string> no_driver = {"VK_DRIVER_FILES=" + missing, "VK_ICD_FILENAMES=" + missing,
                                                "VK_ADD_DRIVER_FILES="};
    const std::vector<std::string> arguments = {"render", scene, "-o",       folder.file("out.exr"), "--spp", "1",
                                                "--size", "8",   "--backend"};
    std::vector<std::string> vulkan = arguments;
    vulkan.emplace_back("vulkan");
    const ProcessResult devices = run_diptych(folder, {"info", "--devices"});
    const bool built_without = devices.out.find("built without Vulkan") != std::string::npos;
    check_refusal(run_diptych(folder, vulkan, no_driver), built_without ? 2 : 3,
                  {built_without ? "DIPTYCH_VULKAN=OFF" : "ulkan"});
    CHECK_FALSE(std::filesystem::exists(folder.file("out.exr")));
    std::vector<std::string> cpu = arguments;
    cpu.emplace_back("cpu");
    CHECK(run_diptych(folder, cpu, no_driver).exit_code == 0);
    CHECK(std::filesystem::exists(folder.file("out.exr")));
}
