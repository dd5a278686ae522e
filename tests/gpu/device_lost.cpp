// A device that is lost while it renders: what is said, what is left, and how a picture goes on.
#include "error.h"
#include "generate/generate.h"
#include "gpu_fixture.h"
#include "render/lasting_picture.h"
#include "render/merge_films.h"
#include "render/session.h"
#include "renderer/path_renderer.h"

namespace diptych::core::tests {
namespace {

const std::atomic<bool> not_cancelled = false;

RenderSettings lost_settings(Integrator integrator) {
    RenderSettings settings;
    settings.width = 20;
    settings.height = 15;
    settings.max_depth = 2;
    settings.seed = 9;
    settings.integrator = integrator;
    settings.standard_error = settings.first_hit_layers = true;
    return settings;
}

/// Loses the device at the submission after `passing`.
void lose_after(Gpu& gpu, int passing) {
    gpu.faults.submission = [left = std::make_shared<std::atomic<int>>(passing)] { return (*left)-- == 0; };
}

/// Opens a device for every renderer, as after a loss, and counts them.
struct Devices {
    std::vector<std::shared_ptr<Gpu>> opened;

    MakeRenderer maker() {
        return [this](const Scene&, const PackedScene& packed, const RenderSettings&) {
            opened.push_back(open_test_gpu());
            return std::make_unique<PathRenderer>(opened.back(), packed);
        };
    }
};

}  // namespace

TEST_CASE("A device that is lost at any submission of a picture says so and leaves nothing behind") {
    NEED_VULKAN();
    const PackedScene packed = generated_scene("cornell", lost_settings(Integrator::path));
    const int passing = GENERATE(0, 3, 12);
    const std::shared_ptr<Gpu> gpu = open_test_gpu();
    lose_after(*gpu, passing);
    const auto render = [&] {
        PathRenderer renderer(gpu, packed);
        for (std::uint32_t sample = 0; sample < 64; ++sample) {
            renderer.render(sample, 1, not_cancelled);
        }
    };
    CHECK_THROWS_AS(render(), DeviceLost);
    CHECK(is_lost(*gpu));
    BytesByPurpose bytes = gpu->memory_use->bytes();
    bytes[static_cast<std::size_t>(Purpose::pipelines)] = 0;  // the device's own
    CHECK(text_of(bytes) == "nothing");
    CHECK_THROWS_AS(render(), DeviceLost);  // it stays lost
    check_no_validation_messages();
}

TEST_CASE("A device that is lost while a session opens on it is opened anew") {
    NEED_VULKAN();
    const Scene scene = generate_scene("cornell").scene;
    const int passing = GENERATE(0, 1);
    Devices devices;
    const MakeRenderer open = devices.maker();
    const MakeRenderer lose_first = [&](const Scene& opened, const PackedScene& packed, const RenderSettings& settings) {
        if (!devices.opened.empty()) {
            return open(opened, packed, settings);
        }
        devices.opened.push_back(open_test_gpu());
        lose_after(*devices.opened.back(), passing);
        return std::unique_ptr<Renderer>(std::make_unique<PathRenderer>(devices.opened.back(), packed));
    };
    DeviceLossPolicy policy;
    policy.choice = OnDeviceLost::retry;
    policy.first_pause = 0;
    LossGuard guard(policy);
    Session session = guard.open([&](const MakeRenderer&) {
        return Session(scene, lost_settings(Integrator::path), lose_first);
    });
    CHECK(guard.losses() == 1);
    CHECK(devices.opened.size() == 2);
    session.render(0, 2, not_cancelled);
    CHECK(samples_of_every_pixel(session.film()) == 2);
    check_no_validation_messages();
}

namespace {

void check_picture_outlasts_its_device(Integrator integrator) {
    const Scene scene = generate_scene("cornell").scene;
    const RenderSettings settings = lost_settings(integrator);
    const bool chains = chains_frames(settings);
    Devices devices;
    Session whole(scene, settings, devices.maker());
    whole.render(0, 4, not_cancelled);
    Film expected = whole.film();
    if (chains) {
        whole.render(4, 4, not_cancelled);
        expected = whole.film();
    } else {
        whole.restart(settings.seed);
        whole.render(4, 4, not_cancelled);
        merge_films(whole.film(), expected);
    }

    Session session(scene, settings, devices.maker());
    DeviceLossPolicy policy;
    policy.choice = OnDeviceLost::retry;
    policy.first_pause = 0;
    LossGuard guard(policy);
    LastingPicture picture(session, guard, not_cancelled, {});
    picture.render(0, 4, not_cancelled);
    CHECK(picture.film().pixels[0].samples == 4);
    lose_after(*devices.opened.back(), 0);
    picture.render(4, 4, not_cancelled);
    CHECK(guard.losses() == 1);
    CHECK(devices.opened.size() == 3);
    CHECK(same_film(picture.film(), expected));
    lose_after(*devices.opened.back(), 0);  // while the film is read
    CHECK(same_film(picture.film(), expected));
    CHECK(guard.losses() == 2);
    CHECK(picture.device() == whole.renderer().device());  // one device, so nothing is said of the loss
    check_no_validation_messages();
}

}  // namespace

TEST_CASE("A picture on a device that is opened anew has the samples of one that was not lost") {
    NEED_VULKAN();
    check_picture_outlasts_its_device(Integrator::path);
}

TEST_CASE("Frames of restir on a device that is opened anew have the bits of those that lost none", "[nightly]") {
    NEED_VULKAN();
    check_picture_outlasts_its_device(Integrator::restir);
}

}  // namespace diptych::core::tests
