// What a user may have meant.
#include "near_miss.h"

#include "catch.h"
#include "gltf_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

TEST_CASE("the nearest word is suggested, and none that is far", "[near-miss]") {
    CHECK(nearest_word("wlak", {"idle", "walk", "run"}) == "walk");
    CHECK(nearest_word("jump", {"idle", "walk", "run"}).empty());
    CHECK(nearest_word("walk", {}).empty());
    CHECK(did_you_mean("wlak", {"walk"}) == " (did you mean 'walk'?)");
    CHECK(did_you_mean("wlak", {"fly"}).empty());
}

TEST_CASE("a path is mended at the first part that is missing", "[near-miss]") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "scenes");
    folder.write("studio.hdr", "");
    folder.write("scenes/helmet.glb", "");
    folder.write("scens.txt", "");  // no folder
    const auto meant = [&](const char* name) { return did_you_mean_file(folder.path() / name); };
    const auto suggested = [&](const char* name) {
        return " (did you mean '" + (folder.path() / name).string() + "'?)";
    };
    CHECK(meant("studio.hrd") == suggested("studio.hdr"));
    CHECK(meant("scenes/helmt.glb") == suggested("scenes/helmet.glb"));
    CHECK(meant("scens/helmet.glb") == suggested("scenes"));
    CHECK(meant("scenes/bottle.glb").empty());
    CHECK(meant("studio.hdr").empty());  // is there
    CHECK(meant("elsewhere/studio.hdr").empty());
}
