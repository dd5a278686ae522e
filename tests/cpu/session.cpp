// A session shows what one opened on the spot shows, whatever it has shown before.
#include "render/session.h"

#include "error.h"
#include "generate/generate.h"
#include "pose/pose.h"
#include "render/frames.h"
#include "render/progressive.h"
#include "render_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

const std::atomic<bool> never{false};

std::unique_ptr<Renderer> on_cpu(const Scene&, const PackedScene& packed, const RenderSettings&) {
    return make_cpu_renderer(packed, 2);
}

RenderSettings small_settings(Integrator integrator) {
    RenderSettings s;
    s.width = 24;
    s.height = 18;
    s.integrator = integrator;
    s.max_depth = 3;
    s.seed = 5;
    s.resampling.near_share = 0;  // clusters of lights stay as they were when the scene was packed
    return s;
}

Moment at(double seconds) {
    Moment moment;
    moment.seconds = seconds;
    return moment;
}

Film film_of(Session& session, std::uint32_t spp = 4) {
    session.render(0, spp, never);
    return session.film();
}

}  // namespace

TEST_CASE("A session has a moment's bits whatever it has shown before") {
    const Scene scene = generate_scene("moving-light").scene;
    const RenderSettings settings = small_settings(Integrator::path);
    Session played(scene, settings, on_cpu, Moment());
    for (const double seconds : {1.5, 0.5, 3.0, 1.5}) {
        INFO(seconds);
        played.show(at(seconds));
        Session fresh(scene, settings, on_cpu, at(seconds));
        CHECK(same_film(film_of(played), film_of(fresh)));
    }
    played.show(Moment());
    Session at_rest(scene, settings, on_cpu);
    CHECK(same_film(film_of(played), film_of(at_rest)));
}

TEST_CASE("A session goes on with another camera, sun and settings as one opened under them") {
    const Scene scene = generate_scene("courtyard").scene;
    RenderSettings settings = small_settings(Integrator::path);
    Moment lit;
    lit.sun = Sun{};
    Session session(scene, settings, on_cpu, lit);
    film_of(session);
    Moment other = lit;
    other.sun->azimuth = 90;
    other.camera = scene.cameras[0];
    CHECK(session.change_to(other, settings) == Change::settings);  // the scene's own camera gave way to another
    session.set(settings, other);
    Moment turned = other;
    turned.camera->camera_to_world[3].y += 0.25;
    CHECK(session.change_to(turned, settings) == Change::view);
    session.show(turned);
    film_of(session);
    settings.integrator = Integrator::direct;
    settings.width = 16;
    settings.standard_error = true;
    CHECK(session.change_to(turned, settings) == Change::settings);
    CHECK_THROWS_AS(session.show(Moment()), Error);  // no sun: another pack
    session.set(settings, turned);
    Session fresh(scene, settings, on_cpu, turned);
    // Its origin is where the first camera stood, so that positions round otherwise: means agree, bits need not.
    const Film a = film_of(session, 16), b = film_of(fresh, 16);
    REQUIRE(a.pixels.size() == b.pixels.size());
    for (std::size_t c = 0; c < 3; ++c) {
        CHECK(image_mean(a).mean[c] == Approx(image_mean(b).mean[c]).epsilon(0.01));
    }
}

TEST_CASE("Samples of a picture may be taken in any parts") {
    const Scene scene = generate_scene("cornell").scene;
    Session whole(scene, small_settings(Integrator::path), on_cpu);
    Session parts(scene, small_settings(Integrator::path), on_cpu);
    parts.render(0, 3, never);
    parts.render(3, 1, never);
    CHECK(same_film(film_of(whole), parts.film()));
    parts.restart(6);
    whole.restart(6);
    CHECK(same_film(film_of(whole), film_of(parts)));
}

TEST_CASE("A chain has the same bits whether its frames' samples are taken together or one by one") {
    const Scene scene = generate_scene("moving-light").scene;
    RenderSettings settings = small_settings(Integrator::restir);
    settings.moves = true;
    Session together(scene, settings, on_cpu, Moment());
    Session alone(scene, settings, on_cpu, Moment());
    CHECK(together.chained());
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
        INFO(frame);
        const Moment moment = at(0.4 * frame);
        const std::optional<std::uint32_t> seed = frame == 0 ? std::optional(9U) : std::nullopt;
        together.show(moment, seed);
        alone.show(moment, seed);
        CHECK(alone.first_sample() == 3 * frame);
        CHECK(alone.looks_back());
        together.render(0, 3, never);
        alone.render(0, 1, never);
        alone.render(1, 1, never);
        CHECK(!alone.looks_back());
        alone.render(2, 1, never);
        CHECK(same_film(together.film(), alone.film()));
    }
    const Film last = alone.film();
    together.show(at(0), 9);  // the chain anew, to the same end
    together.render(0, 3, never);
    for (std::uint32_t frame = 1; frame < 4; ++frame) {
        together.show(at(0.4 * frame));
        ProgressiveTarget target;
        target.spp = 3;
        CHECK(render_progressively(together, target, never).spp == 3);
    }
    CHECK(same_film(together.film(), last));
}

TEST_CASE("A chain's samples but a frame's first look back to that frame's own moment") {
    const Scene scene = generate_scene("moving-light").scene;
    RenderSettings settings = small_settings(Integrator::restir);
    settings.moves = true;
    Session session(scene, settings, on_cpu, Moment());
    Scene posed = scene;
    PackedScene packed = pack_scene(posed, settings);
    const auto renderer = make_cpu_renderer(packed, 2);
    const auto go_to = [&](double seconds) {
        pose_scene(posed, seconds);
        pack_moment(posed, settings, packed);
        renderer->move_to(packed);
    };
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
        INFO(frame);
        const double seconds = 0.8 + 0.1 * frame;  // the lamp switches on at 1 s
        session.show(at(seconds), frame == 0 ? std::optional(9U) : std::nullopt);
        session.render(0, 3, never);
        go_to(seconds);
        if (frame == 0) {
            renderer->restart(9);
        } else {
            renderer->clear_film();
        }
        renderer->render(3 * frame, 1, never);
        go_to(seconds);  // the moment before is this one now
        renderer->render(3 * frame + 1, 2, never);
        CHECK(same_film(session.film(), renderer->film()));
    }
}

TEST_CASE("Frames of a request are its moments, and an orbit starts from where the scene has the camera") {
    const Scene scene = generate_scene("courtyard").scene;
    RenderRequest request;
    request.settings = small_settings(Integrator::path);
    request.start = 1;
    request.fps = 10;
    request.orbit = 18;
    const FrameMoments moments(scene, request);
    CHECK(*moments.at(5).seconds == Approx(1.5));
    CHECK(moments.at(0).orbit->degrees == Approx(180));
    CHECK(moments.at(5).orbit->degrees == Approx(270));
    Scene once = scene, twice = scene;
    put_moment(scene, moments.at(3), 0, once);
    put_moment(scene, moments.at(1), 0, twice);
    put_moment(scene, moments.at(3), 0, twice);
    CHECK(once.cameras[0].camera_to_world == twice.cameras[0].camera_to_world);
}

TEST_CASE("A session at rest refuses to be shown another moment") {
    const Scene scene = generate_scene("cornell").scene;
    Session session(scene, small_settings(Integrator::path), on_cpu);
    CHECK_THROWS_AS(session.show(at(1)), Error);
}
