// A view's frames without window or device: what is posted, what is played, what survives.
#include "view/frame_loop.h"

#include "backend/cpu_renderer.h"
#include "pose/pose.h"
#include "view/camera_control.h"
#include "view_fixture.h"

using namespace diptych::core;
using namespace diptych::core::app;
using namespace diptych::core::tests;

namespace {

LoadedScene loaded(std::shared_ptr<Scene> scene) {
    LoadedScene out;
    out.generation = 1;
    out.bounds = scene_bounds(*scene);
    out.request.scene = "small.gltf";
    out.request.settings.width = 16;
    out.request.settings.height = 16;
    out.request.settings.standard_error = true;
    out.scene = std::move(scene);
    return out;
}

/// A camera that an animation carries from x = 0 to x = 2 in a second.
std::shared_ptr<Scene> scene_of_moving_camera() {
    auto scene = small_scene();
    Node node;
    node.translation = {0, 1, 3};
    scene->nodes = {node};
    scene->cameras[0].node = 0;
    scene->animations = {{"", {{AnimatedProperty::translation, 0, Interpolation::linear, {0, 1}, {0, 1, 3, 2, 1, 3}}}}};
    pose_scene(*scene, 0);
    return scene;
}

struct Panels {
    std::shared_ptr<Script> cpu = std::make_shared<Script>();
    std::shared_ptr<Script> vulkan = std::make_shared<Script>();

    FrameLoopOptions options() const { return {fake_factory(cpu), fake_factory(vulkan)}; }
};

}  // namespace

TEST_CASE("Only a change is posted, and only to panels that are shown", "[view]") {
    const Panels panels;
    FrameLoop loop(panels.options(), loaded(small_scene()));
    loop.state().shown.panel = ShownPanel::cpu;
    loop.step(10);
    CHECK(loop.version() == 1);
    CHECK(!loop.moving());
    loop.step(10.1);
    CHECK(loop.version() == 1);
    await_shot(*loop.worker(Panel::cpu), [](const PanelShot& shot) { return shot.spp > 2; });
    CHECK(panels.vulkan->take().empty());
    loop.state().shown.panel = ShownPanel::split;
    loop.step(11);
    CHECK(loop.version() == 2);
    await_shot(*loop.worker(Panel::vulkan), [](const PanelShot& shot) { return shot.version == 2 && shot.spp > 0; });
    loop.state().shown.exposure = 2;
    loop.step(12);
    CHECK(loop.version() == 2);
    loop.state().rendered.request.settings.max_depth = 3;
    loop.step(13);
    CHECK(loop.version() == 3);
}

TEST_CASE("One change is answered in full, a run of them as a motion", "[view]") {
    const Panels panels;
    FrameLoop loop(panels.options(), loaded(small_scene()));
    loop.step(10);
    const auto nudge = [&] { loop.state().rendered.camera.camera_to_world[3].x += 0.01; };
    nudge();
    loop.step(11);
    CHECK(!loop.moving());
    nudge();
    loop.step(11.05);
    CHECK(loop.moving());
    loop.step(11.1);
    CHECK(loop.moving());
    const std::uint64_t version = loop.version();
    loop.step(11.3);  // no more of them: rest, which the panels must hear of
    CHECK(!loop.moving());
    CHECK(loop.version() == version + 1);
    loop.state().interacting = true;
    loop.step(12);
    CHECK(loop.moving());
    loop.state().interacting = false;
    loop.step(12.01);
    CHECK(!loop.moving());
}

TEST_CASE("The animation plays round, and the scene's camera with it", "[view]") {
    const Panels panels;
    FrameLoop loop(panels.options(), loaded(scene_of_moving_camera()));
    CHECK(loop.state().animation.duration == 1);
    loop.step(10);
    loop.state().animation.playing = true;
    loop.step(10.25);
    CHECK(loop.moving());
    CHECK(loop.state().rendered.time == Approx(0.25));
    CHECK(loop.state().rendered.camera.camera_to_world[3].x == Approx(0.5));
    loop.step(11.5);
    CHECK(loop.state().rendered.time == Approx(0.5));
    loop.state().follows_camera = false;  // a hand has taken it
    fly(loop.state().rendered.camera, {0, 0, 1});
    loop.step(11.6);
    CHECK(loop.state().rendered.camera.camera_to_world[3].x == Approx(1));
    loop.show_camera(0);
    CHECK(loop.state().rendered.camera.camera_to_world[3].x == Approx(1.2));
}

TEST_CASE("A scene that does not open leaves the one that is shown", "[view]") {
    const Panels panels;
    FrameLoop loop(panels.options(), loaded(small_scene()));
    loop.step(10);
    loop.open_scene("/nowhere/none.gltf");
    std::vector<std::string> errors;
    for (int i = 0; i < 2000 && errors.empty(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        loop.step(11 + 0.01 * i);
        errors = loop.take_errors();
    }
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].find("none.gltf") != std::string::npos);
    CHECK(loop.scene().generation == 1);
    CHECK(loop.version() == 1);
}

TEST_CASE("The panels' running test compares what both show", "[view]") {
    FrameLoopOptions options;
    options.cpu = [](const PackedScene& packed) { return make_cpu_renderer(packed, 1); };
    options.vulkan = options.cpu;  // another seed, the same code
    FrameLoop loop(options, loaded(small_scene()));
    loop.state().shown.panel = ShownPanel::split;
    for (int i = 0; i < 3000 && loop.light().agreement == Agreement::waiting; ++i) {
        loop.step(10 + 0.01 * i);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    CHECK((loop.light().agreement == Agreement::agree || loop.light().agreement == Agreement::doubtful));
    CHECK(loop.light().largest > 0);  // the seeds differ
    CHECK(!loop.history(Panel::cpu).points().empty());
}

TEST_CASE("The command repeats what is seen", "[view]") {
    const Panels panels;
    FrameLoop loop(panels.options(), loaded(scene_of_moving_camera()));
    loop.step(10);
    const std::string own = loop.repeat_command(Panel::cpu, "out.exr");
    CHECK(own.find("diptych render small.gltf") == 0);
    CHECK(own.find("--eye") == std::string::npos);
    CHECK(own.find("--start 0") != std::string::npos);
    CHECK(own.find("--size 16x16") != std::string::npos);
    orbit(loop.state().rendered.camera, loop.state().pivot, 0.3, 0.1);
    loop.state().rendered.camera.lens.radius = 0.25;
    loop.state().rendered.request.sun = Sun{10, 20, 3};
    loop.state().rendered.request.settings.seed = 6;
    const std::string moved = loop.repeat_command(Panel::vulkan, "out.exr");
    CHECK(moved.find("--eye ") != std::string::npos);
    CHECK(moved.find("--look-at ") != std::string::npos);
    CHECK(moved.find("--aperture 0.25") != std::string::npos);
    CHECK(moved.find("--sun 10,20,3") != std::string::npos);
    CHECK(moved.find("--backend vulkan") != std::string::npos);
    CHECK(moved.find("--seed 7") != std::string::npos);  // the Vulkan panel's own
}
