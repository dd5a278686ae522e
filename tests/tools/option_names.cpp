// Messages of the library in the command line's words.
#include "catch.h"

#include "console/option_names.h"
#include "error.h"
#include "scene/viewpoint.h"
#include "settings/names.h"

using namespace diptych::core;
using diptych::core::app::with_option_names;

namespace {

template <typename Work>
std::string refusal(const Work& work) {
    try {
        work();
    } catch (const Error& error) {
        return with_option_names(error.what());
    }
    return "accepted";
}

}  // namespace

TEST_CASE("settings become options, and other text stays", "[tools]") {
    CHECK(with_option_names("`eye`: wants `look_at`, a point") == "--eye: wants --look-at, a point");
    CHECK(with_option_names("give another `output`") == "give another -o");
    CHECK(with_option_names("no name").size() == 7);
    CHECK(with_option_names("") == "");
    CHECK(with_option_names("a `file`: `clip` chooses") == "a `file`: --clip chooses");
    CHECK(with_option_names("one ` alone, `clip` after it") == "one ` alone, --clip after it");
    CHECK(with_option_names("ends in `clip") == "ends in `clip");
    CHECK(with_option_names("``clip``") == "`--clip`");
    for (const app::OptionName& name : app::option_names()) {
        INFO(name.setting);
        CHECK(with_option_names("`" + std::string(name.setting) + "`") == name.option);
    }
}

TEST_CASE("errors of the library name options on the command line alone", "[tools]") {
    CHECK(refusal([] { integrator_from_name("bdpt"); }) ==
          "--integrator bdpt: there are only brdf, direct, path, ris, restir");
    Camera camera;
    Viewpoint viewpoint;
    viewpoint.eye = glm::dvec3(1);
    CHECK(refusal([&] { place_at(viewpoint, camera); }) == "--eye: wants --look-at, the point it looks at");
    viewpoint = {};
    viewpoint.view_height = 2;
    CHECK_THAT(refusal([&] { place_at(viewpoint, camera); }), Catch::Contains("--view-height: the camera") &&
                                                                  Catch::Contains("give --fov"));
}
