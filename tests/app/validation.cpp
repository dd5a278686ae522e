#include "catch.h"

#include <nlohmann/json.hpp>

#include "process.h"

using namespace diptych::core::tests;

TEST_CASE("a command under validation ends with 1 if the layer had anything to say, and says how much", "[app]") {
    if (!program_has_validation()) {
        SKIP_TEST("no Vulkan device with ray tracing, or no validation layer (package vulkan-validationlayers)");
    }
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::vector<std::string> arguments = {"render", scene, "-o",          folder.file("out.exr"),
                                                "--spp",  "1",   "--backend",   "vulkan",
                                                "--size", "8",   "--validation"};
    const ProcessResult silent = run_diptych(folder, arguments);
    INFO(silent.err);
    CHECK(silent.exit_code == 0);
    CHECK(silent.err.find("validation:") == std::string::npos);

    // The layer's advice on performance always finds something; older and newer layers know its switch by different
    // names.
    write_text(folder.file("vk_layer_settings.txt"),
               "khronos_validation.enables = VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT\n"
               "khronos_validation.validate_best_practices = true\n");
    const ProcessResult result =
        run_diptych(folder, arguments, {"VK_LAYER_SETTINGS_PATH=" + folder.file("vk_layer_settings.txt")});
    std::size_t lines = 0;
    for (std::size_t at = result.err.find("\nvalidation: "); at != std::string::npos;
         at = result.err.find("\nvalidation: ", at + 1)) {
        ++lines;
    }
    CHECK(lines > 0);
    CHECK(result.exit_code == 1);
    CHECK(result.err.find("diptych: validation: the layer had ") != std::string::npos);
    CHECK(std::filesystem::exists(folder.file("out.exr")));
}
