// Rendering by the public interface: pieces, stops, moments, views and threads.
#include <chrono>
#include <limits>
#include <thread>

#include "library/library_fixture.h"

using namespace library_tests;

namespace {

dp::Session open(const dp::Scene& scene, dp::Backend backend, const dp::Settings& settings) {
    dp::BackendChoice choice;
    choice.backend = backend;
    return {scene, choice, settings};
}

const dp::Scene& cornell() {
    static const dp::Scene scene = dp::load(source_dir + "/scenes/cornell.gltf");
    return scene;
}

}  // namespace

TEST_CASE("A picture has the bits of the program's") {
    const Folder folder;
    for (const dp::Backend backend : panels()) {
        for (const dp::Integrator integrator : {dp::Integrator::path, dp::Integrator::restir}) {
            const std::string name = dp::name_of(backend) + "-" + dp::name_of(integrator);
            const std::string theirs = folder.file(name + "-program.exr");
            const std::string ours = folder.file(name + ".exr");
            const std::string command = std::string("'" DIPTYCH_PROGRAM "' render '") + source_dir +
                                        "/scenes/cornell.gltf' --backend " + dp::name_of(backend) + " --integrator " +
                                        dp::name_of(integrator) + " --size 24x16 --max-depth 3 --spp 4 --seed 7 -o '" +
                                        theirs + "' 2>/dev/null >&2";
            INFO(command);
            REQUIRE(std::system(command.c_str()) == 0);
            dp::Settings settings = small_settings(integrator);
            settings.seed = 7;
            rendered(cornell(), backend, settings, 4).save(ours);
            const dp::Comparison difference = dp::compare(ours, theirs);
            CHECK(difference.mse == 0);
            CHECK(difference.fraction_equal == 1);
        }
    }
}

TEST_CASE("Consecutive calls have the bits of one, and a stopped render goes on where it stopped") {
    for (const dp::Backend backend : panels()) {
        for (const dp::Integrator integrator : {dp::Integrator::path, dp::Integrator::restir}) {
            const dp::Film whole = rendered(cornell(), backend, small_settings(integrator), 12);
            dp::Session session = open(cornell(), backend, small_settings(integrator));
            session.render_range(0, 3);
            session.render_range(3, 4);
            std::stop_source stop;
            dp::RenderOptions options;
            options.stop = stop.get_token();
            options.progress = [&](const dp::Progress&) { stop.request_stop(); };
            const dp::RenderResult stopped = session.render(5, options);
            CHECK(session.film().info().spp == 7 + stopped.spp);
            session.render(12 - session.film().info().spp);
            CHECK(same_bits(session.film(), whole));
            CHECK_THROWS_WITH(session.render_range(3, 1), "session: sample 3 was rendered before; the next is 12");
            CHECK(same_bits(session.film(), whole));
        }
    }
}

TEST_CASE("A stop ends a long render, and the film stays even") {
    dp::Settings settings = small_settings();
    settings.size = {128, 128};
    dp::Session session = open(cornell(), dp::Backend::cpu, settings);
    std::stop_source stop;
    dp::RenderOptions options;
    options.stop = stop.get_token();
    std::thread other([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        stop.request_stop();
    });
    const dp::RenderResult result = session.render(100000000, options);
    other.join();
    CHECK(result.stopped);
    CHECK(result.spp > 0);
    const std::vector<std::uint32_t> counts = session.film().sample_counts();
    CHECK(std::all_of(counts.begin(), counts.end(), [&](std::uint32_t n) { return n == result.spp; }));
}

TEST_CASE("A time limit and an error limit end a render") {
    dp::Session session = open(cornell(), dp::Backend::cpu, small_settings());
    dp::RenderOptions options;
    options.relmse = 0.05;
    session.render(0, options);
    CHECK(session.film().relmse_estimate() <= 0.05);
    options = {};
    options.seconds = 0.1;
    CHECK(session.render(0, options).spp > 0);
    dp::Settings bare = small_settings();
    bare.standard_error = false;
    options.relmse = 0.05;
    dp::Session without = open(cornell(), dp::Backend::cpu, bare);
    CHECK_THROWS_AS(without.render(0, options), dp::Error);
}

TEST_CASE("restart, set_settings and set_camera render what a new session would") {
    for (const dp::Backend backend : {dp::Backend::cpu, dp::Backend::vulkan, dp::Backend::oracle}) {
        if (backend == dp::Backend::vulkan && dp::devices().empty()) {
            continue;
        }
        INFO(dp::name_of(backend));
        dp::Settings settings = small_settings();
        dp::Session session = open(cornell(), backend, settings);
        session.render(2);
        session.restart(9);
        session.render(2);
        settings.seed = 9;
        CHECK(same_bits(session.film(), rendered(cornell(), backend, settings, 2)));

        settings.integrator = dp::Integrator::direct;
        settings.size = {20, 12};
        session.set_settings(settings);
        session.render(2);
        CHECK(same_bits(session.film(), rendered(cornell(), backend, settings, 2)));

        dp::Scene seen = cornell().copy();
        dp::Camera camera = dp::look_at({0.2, 1, 3}, {0, 1, 0});
        seen.cameras()[0] = camera;
        session.set_camera(camera);
        session.render(2);
        CHECK(same_bits(session.film(), rendered(seen, backend, settings, 2)));
    }
}

TEST_CASE("pose shows a moment, and an edit stays at it") {
    dp::Scene scene = dp::load(source_dir + "/scenes/moving-light.gltf");
    REQUIRE(scene.duration() > 0);
    for (const dp::Backend backend : panels()) {
        dp::Session session = open(scene, backend, small_settings());
        session.pose(0.5 * scene.duration());
        session.render(2);
        const dp::Film later = session.film();
        session.pose(0);
        session.render(2);
        CHECK_FALSE(same_bits(session.film(), later));
        session.pose(0.5 * scene.duration());
        session.render(2);
        CHECK(same_bits(session.film(), later));

        dp::Scene edited = scene.copy();
        dp::Session followed = open(edited, backend, small_settings());
        followed.pose(0.5 * scene.duration());
        followed.render(1);
        edited.materials()[0].roughness = 0.3F;
        followed.render(2);
        dp::Session fresh = open(edited, backend, small_settings());
        fresh.pose(0.5 * scene.duration());
        fresh.render(2);
        CHECK(same_bits(followed.film(), fresh.film()));
        CHECK_FALSE(same_bits(followed.film(), later));
    }
}

TEST_CASE("A camera and a moment can be taken back") {
    dp::Scene scene = dp::load(source_dir + "/scenes/moving-light.gltf");
    const dp::Film expected = rendered(scene, dp::Backend::cpu, small_settings(), 2);
    dp::Session session = open(scene, dp::Backend::cpu, small_settings());
    session.pose(0.5 * scene.duration());
    session.set_camera(dp::look_at({0.2, 1, 3}, {0, 1, 0}));
    session.render(2);
    CHECK_FALSE(same_bits(session.film(), expected));
    session.set_camera({});
    session.pose({});
    session.render(2);
    CHECK(same_bits(session.film(), expected));
    CHECK_THROWS_AS(session.pose(std::numeric_limits<double>::infinity()), dp::Error);
}

TEST_CASE("A session whose scene could not be built goes on once the scene is mended") {
    for (const dp::Backend backend : panels()) {
        dp::Scene scene = small_scene();
        dp::Session session = open(scene, backend, small_settings());
        session.render(2);
        const dp::Film expected = session.film();
        scene.instance("wall").object_to_world[12] = 1e300;  // beyond single precision, which packing finds out
        CHECK_THROWS_AS(session.render(2), dp::Error);
        CHECK_THROWS_AS(session.render(2), dp::Error);
        scene.instance("wall").object_to_world[12] = 0;
        session.render(2);
        CHECK(same_bits(session.film(), expected));
    }
}

TEST_CASE("Frames of restir go on from one another, and of other integrators do not") {
    dp::Scene scene = dp::load(source_dir + "/scenes/moving-light.gltf");
    for (const dp::Backend backend : panels()) {
        dp::Session session = open(scene, backend, small_settings(dp::Integrator::restir));
        session.pose(0);
        session.render(1);
        session.pose(0.04);
        session.render(1);
        dp::Session fresh = open(scene, backend, small_settings(dp::Integrator::restir));
        fresh.pose(0.04);
        fresh.render(1);
        CHECK_FALSE(same_bits(session.film(), fresh.film()));
    }
}

TEST_CASE("Sessions run side by side, and one may be moved to another thread") {
    for (const dp::Backend backend : panels()) {
        const dp::Film expected = rendered(cornell(), backend, small_settings(), 6);
        std::vector<dp::Session> sessions;
        for (int i = 0; i < 3; ++i) {
            sessions.push_back(open(cornell(), backend, small_settings()));
            sessions.back().render(2);
        }
        std::vector<std::thread> threads;
        for (dp::Session& session : sessions) {
            threads.emplace_back([&session] {
                session.render(2);
                session.render(2);
            });
        }
        for (std::thread& thread : threads) {
            thread.join();
        }
        for (const dp::Session& session : sessions) {
            CHECK(same_bits(session.film(), expected));
        }
    }
}

TEST_CASE("A scene without a camera is seen whole, and one without light is lit where a file asks for neither") {
    dp::Scene scene = small_scene();
    scene.cameras().clear();
    const dp::Film film = rendered(scene, dp::Backend::cpu, small_settings(), 1);
    CHECK(scene.cameras().size() == 1);
    CHECK(std::any_of(film.radiance().begin(), film.radiance().end(), [](float x) { return x > 0; }));
    CHECK_FALSE(dp::Session(scene).capabilities().replay == false);
    dp::BackendChoice oracle;
    oracle.backend = dp::Backend::oracle;
    CHECK_FALSE(dp::Session(scene, oracle).capabilities().replay);
}
