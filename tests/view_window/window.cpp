// The whole program in a window, driven by synthetic input, under the validation layer.
#include <algorithm>

#include "catch.h"
#include "image/image_file.h"
#include "image/layered_image.h"
#include "open_display.h"

using namespace diptych::core;
using namespace diptych::core::tests;

TEST_CASE("a view is opened, orbited, flown, switched, resized, saved and closed", "[view_window]") {
    OPEN_DISPLAY(display, folder, scene)
    DrivenView view(display, folder, scene, {"--panel", "vulkan", "--scale", "0.2", "--max-depth", "2"});
    CHECK(view.await("integrator")["name"] == "path");
    const Event begun = view.await("spp", is_settled);
    CHECK(begun["width"] == 128);
    CHECK(begun["height"] == 80);

    view.drag(1, 320, 250, 60, 20);
    const auto is_newer = [&](const Event& event) { return event["version"] > begun["version"]; };
    view.await("applied", is_newer);
    const Event orbited = view.await("spp", [&](const Event& event) { return is_newer(event) && is_settled(event); });

    // Saved pictures tell where wheel and keys have brought the camera.
    Event before = orbited;
    const auto saved_picture = [&] {
        view.key("ctrl+shift+s");
        return read_image(view.await("saved")["file"].get<std::string>());
    };
    const auto picture_after = [&](const std::vector<std::string>& deeds, const std::string& answer = "") {
        display.hand(deeds);
        if (!answer.empty()) {
            view.await(answer);
        }
        const auto follows = [&](const Event& event) { return event["version"] > before["version"]; };
        before = view.last("applied", follows);
        view.await("spp", [&](const Event& event) { return event["version"] == before["version"]; });
        return saved_picture();
    };
    const auto farthest = [](const LayeredImage& image) {
        return *std::max_element(image.depth->data.begin(), image.depth->data.end());
    };
    const LayeredImage afar = saved_picture();
    const LayeredImage rolled =
        picture_after({"mousemove", "320", "250", "sleep", "0.2", "click", "4", "sleep", "0.1", "click", "4"});
    const LayeredImage flown =
        picture_after({"keydown", "w", "sleep", "0.3", "keyup", "w", "sleep", "0.1", "key", "f"}, "focused");
    CHECK(farthest(rolled) < 0.95F * farthest(afar));
    CHECK(farthest(flown) < 0.99F * farthest(rolled));
    CHECK(rolled.metadata.at("command").find("--focus") == std::string::npos);
    CHECK(flown.metadata.at("command").find("--focus") != std::string::npos);

    // S is let go after Ctrl, and does not fly meanwhile.
    display.hand({"keydown", "Control_L", "keydown", "s", "keyup", "Control_L", "sleep", "0.3", "keyup", "s"});
    view.await("screenshot");
    CHECK(view.last("applied")["version"] == before["version"]);

    view.key("i");
    CHECK(view.await("integrator")["name"] == "ris");
    view.await("spp", [](const Event& event) { return event["integrator"] == "ris" && event["spp"] >= 2; });
    view.click(view.placed("integrator"));
    view.click(view.placed("integrator:restir"));
    CHECK(view.await("integrator")["name"] == "restir");
    view.await("spp", [](const Event& event) { return event["integrator"] == "restir" && event["spp"] >= 2; });
    view.key("shift+i");
    view.key("shift+i");
    view.await("spp", [](const Event& event) { return event["integrator"] == "path" && is_settled(event); });

    display.hand({"windowsize", "--sync", std::to_string(view.window()), "500", "360"});
    const Event resized = view.await("resized");
    CHECK(resized["width"] == 100);
    CHECK(resized["height"] == 72);
    view.await("spp", [](const Event& event) { return event["width"] == 100 && is_settled(event); });

    view.key("ctrl+s");
    const RawImage picture = read_raw(view.await("screenshot")["file"].get<std::string>());
    CHECK(picture.image.width == 500);
    CHECK(picture.image.height == 360);
    double sum = 0;
    for (const float value : picture.image.data) {
        sum += static_cast<double>(value);
    }
    CHECK(sum / static_cast<double>(picture.image.data.size()) > 0.02);  // not black

    const LayeredImage saved = saved_picture();
    CHECK(saved.color.width == 100);
    CHECK(saved.depth);
    CHECK(saved.metadata.at("command").find("--eye") != std::string::npos);  // the camera was orbited
    CHECK(orbited["version"] > begun["version"]);
    check_clean(view.quit());
}

TEST_CASE("files dropped on a view open, and a broken one leaves the scene up", "[view_window]") {
    OPEN_DISPLAY(display, folder, scene)
    const std::string other = generate_scene(folder, "furnace");
    const std::string broken = folder.file("broken.gltf");
    write_text(broken, "{\"asset\": {\"version\": \"2.0\"}, \"scenes\": 7");
    DrivenView view(display, folder, scene, {"--panel", "split", "--scale", "0.1", "--max-depth", "2"});
    view.await("spp", [](const Event& event) { return event["panel"] == "cpu" && is_settled(event); });
    view.await("spp", [](const Event& event) { return event["panel"] == "vulkan" && is_settled(event); });

    REQUIRE(drop_files(display.name(), view.window(), {broken}));
    const std::string error = view.await("error")["text"].get<std::string>();
    CHECK(error.find("broken.gltf") != std::string::npos);
    view.key("p");
    CHECK(view.await("panel")["name"] == "difference");
    CHECK(view.latest("applied")["scene"] == 1);

    REQUIRE(drop_files(display.name(), view.window(), {other}));
    CHECK(view.await("dropped")["file"] == other);
    view.await("spp", [](const Event& event) {
        return event["scene"] > 1 && event["panel"] == "vulkan" && is_settled(event);
    });

    // A click replays a pixel's path on both panels.
    display.hand(
        {"mousemove", "--sync", "200", "300", "sleep", "0.2", "mousedown", "1", "sleep", "0.2", "mouseup", "1"});
    const Event replayed = view.await("replayed");
    CHECK(replayed["paths"] == 2);
    CHECK(replayed["parted"] == false);
    check_clean(view.quit());
}

TEST_CASE("without a display a view says what to do instead", "[view_window]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    // Without XDG_RUNTIME_DIR libwayland would add a line of its own; with it, GLFW tries Wayland in vain.
    for (const std::string& runtime_folder : {std::string(), folder.path().string()}) {
        INFO("XDG_RUNTIME_DIR=" << runtime_folder);
        const ProcessResult result = run_diptych(
            folder, {"view", scene}, {"DISPLAY=", "WAYLAND_DISPLAY=", "XDG_RUNTIME_DIR=" + runtime_folder});
        check_refusal(result, 3, {"--headless", "render --frames", "render --live"});
    }
}
