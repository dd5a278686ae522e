// A panel's thread: the least work for a change, no sample that nobody sees, no film that was cut short.
#include "view/panel_worker.h"

#include <algorithm>

#include "backend/cpu_renderer.h"
#include "generate/generate.h"
#include "pose/pose.h"
#include "render/film_statistics.h"
#include "view/panel_engine.h"
#include "view_fixture.h"

using namespace diptych::core;
using namespace diptych::core::app;
using namespace diptych::core::tests;

namespace {

/// What was called but for renders.
std::vector<std::string> changes(Script& script) {
    std::vector<std::string> calls = script.take();
    calls.erase(
        std::remove_if(calls.begin(), calls.end(), [](const std::string& c) { return c.rfind("render", 0) == 0; }),
        calls.end());
    return calls;
}

Shown shows(std::uint64_t version, std::uint32_t spp = 1) {
    return [=](const PanelShot& shot) { return shot.version == version && shot.spp >= spp; };
}

RendererFactory cpu_factory() {
    return [](const PackedScene& packed) { return make_cpu_renderer(packed, 1); };
}

bool same_sums(const Film& a, const Film& b) {
    const auto same = [](const shared::FilmPixel& p, const shared::FilmPixel& q) {
        return rounded(p.sum) == rounded(q.sum) && p.samples == q.samples && p.rays == q.rays;
    };
    return a.width == b.width && a.height == b.height && a.pixels.size() == b.pixels.size() &&
           std::equal(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), same);
}

/// The film of so many samples by a renderer made for just this.
Film fresh_film(const Scene& loaded, const RenderedState& state, std::uint32_t seed_offset, std::uint32_t spp) {
    Scene scene = loaded;
    put_moment(loaded, moment_of(state), state.request.settings.camera, scene);
    const RenderSettings settings = panel_settings(state.request.settings, seed_offset, 1);
    const PackedScene packed = pack_scene(scene, settings);
    const auto renderer = make_cpu_renderer(packed, 1);
    renderer->render(0, spp, std::atomic<bool>(false));
    return renderer->film();
}

}  // namespace

TEST_CASE("A panel does the least that a change asks for", "[view]") {
    const auto script = std::make_shared<Script>();
    const auto scene = small_scene();
    PanelWorker worker("fake", fake_factory(script), 5);
    CHECK(worker.shot()->version == 0);
    ViewJob job = job_of(scene, 1);
    worker.post(job);
    await_shot(worker, shows(1, 4));
    CHECK(changes(*script) == std::vector<std::string>{"make"});

    job.version = 2;  // the same picture goes on
    job.state.request.exposure = 2;
    worker.post(job);
    CHECK(await_shot(worker, shows(2, 5))->spp >= 5);
    CHECK(changes(*script).empty());

    job.version = 3;
    job.state.request.settings.seed = 7;
    worker.post(job);
    await_shot(worker, shows(3));
    CHECK(changes(*script) == std::vector<std::string>{"restart 12"});

    job.version = 4;
    job.state.camera.camera_to_world[3].y += 0.5;
    worker.post(job);
    await_shot(worker, shows(4));
    CHECK(changes(*script) == std::vector<std::string>{"move", "restart 12"});

    job.version = 5;
    job.state.request.settings.max_depth = 4;
    worker.post(job);
    await_shot(worker, shows(5));
    CHECK(changes(*script) == std::vector<std::string>{"reconfigure 16"});

    job.version = 6;
    job.state.scene = 2;
    worker.post(job);
    await_shot(worker, shows(6));
    CHECK(changes(*script) == std::vector<std::string>{"make"});
}

TEST_CASE("A panel at rest adds to the picture, and paused it does not", "[view]") {
    const auto script = std::make_shared<Script>();
    PanelWorker worker("fake", fake_factory(script));
    ViewJob job = job_of(small_scene(), 1);
    worker.post(job);
    const std::uint32_t spp = await_shot(worker, shows(1, 10))->spp;
    CHECK(worker.film().get().film.pixels[0].samples >= spp);
    job.version = 2;
    job.paused = true;
    worker.post(job);
    await_shot(worker, shows(2));
    const std::uint32_t before = worker.film().get().outcome.spp;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    CHECK(worker.film().get().outcome.spp == before);
    job.version = 3;
    job.paused = false;
    worker.post(job);
    CHECK(await_shot(worker, shows(3, before + 1))->spp > before);
    CHECK(changes(*script) == std::vector<std::string>{"make"});
}

TEST_CASE("A film asked for right after a change is that of the change", "[view]") {
    const auto script = std::make_shared<Script>();
    PanelWorker worker("fake", fake_factory(script));
    CHECK_THROWS_AS(worker.film().get(), Error);  // none is coming
    ViewJob job = job_of(small_scene(), 1);
    for (job.version = 1; job.version <= 20; ++job.version) {
        job.state.camera.lens.focus_distance = static_cast<double>(job.version);
        worker.post(job);
        const KeptFilm kept = worker.film().get();
        CHECK(kept.outcome.spp >= 1);
        CHECK(kept.camera.lens.focus_distance == static_cast<double>(job.version));
    }
}

TEST_CASE("Moving shows previews, rest the whole picture", "[view]") {
    const auto script = std::make_shared<Script>();
    PanelWorker worker("fake", fake_factory(script));
    ViewJob job = job_of(small_scene(), 1, 64);
    job.moving = true;
    job.frame_seconds = 1e-6;  // that nothing fits
    worker.post(job);
    const auto preview = await_shot(worker, shows(1));
    CHECK(preview->divisor == 8);
    CHECK(preview->width == 8);
    CHECK(preview->film->width == 8);
    job.version = 2;
    job.moving = false;
    worker.post(job);
    const auto whole = await_shot(worker, shows(2));
    CHECK(whole->divisor == 1);
    CHECK(whole->film->width == 64);
    CHECK(changes(*script) == std::vector<std::string>{"make", "reconfigure 64"});
}

TEST_CASE("A slow picture at rest gives way at once, and what was cut short is not gone on with", "[view]") {
    const auto script = std::make_shared<Script>();
    PanelWorker worker("fake", fake_factory(script));
    ViewJob job = job_of(small_scene(), 1);
    script->close_gate(true);
    worker.post(job);
    while (script->take().size() < 1) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    // Another state, and back, before the worker has heard of either.
    ViewJob other = job;
    other.version = 2;
    other.state.time = 1;
    worker.post(other);
    job.version = 3;
    worker.post(job);
    script->close_gate(false);
    const auto shot = await_shot(worker, shows(3, 3));
    CHECK(script->cut_short >= 1);
    for (const shared::FilmPixel& pixel : shot->film->pixels) {
        CHECK(pixel.samples <= shot->spp);
    }
}

TEST_CASE("Every preview of a motion shows whole samples", "[view]") {
    const auto script = std::make_shared<Script>();
    PanelWorker worker("fake", fake_factory(script));
    std::atomic<int> shown = 0;
    std::uint64_t last = 0;
    worker.on_shot([&] {
        const auto shot = worker.shot();
        shown += shot->spp > 0 && shot->version != last ? 1 : 0;
        last = shot->spp > 0 ? shot->version : last;
    });
    ViewJob job = job_of(small_scene(), 0, 64);
    job.moving = true;
    for (int i = 1; i <= 100; ++i) {
        job.version = static_cast<std::uint64_t>(i);
        job.state.camera.camera_to_world[3].x = 0.01 * i;
        worker.post(job);
        std::this_thread::sleep_for(std::chrono::microseconds(300));  // faster than a sample
    }
    await_shot(worker, shows(100));
    CHECK(shown > 5);
    for (const std::string& call : script->take()) {
        CHECK(call.rfind("render 0 0", 0) == std::string::npos);
    }
}

TEST_CASE("What moves takes the samples that fit a frame, and then waits for what comes next", "[view]") {
    const auto script = std::make_shared<Script>();
    PanelWorker worker("fake", fake_factory(script));
    ViewJob job = job_of(small_scene(), 1);
    job.moving = true;
    job.frame_seconds = 10;
    worker.post(job);  // from which its speed is known
    await_shot(worker, shows(1));
    job.version = 2;
    job.state.camera.camera_to_world[3].y += 0.5;
    worker.post(job);
    const std::uint32_t taken = await_shot(worker, shows(2))->spp;
    CHECK(taken > 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    CHECK(worker.shot()->spp == taken);
    job.version = 3;
    job.moving = false;
    worker.post(job);  // the same picture: it goes on at once
    CHECK(await_shot(worker, shows(3, taken + 1))->spp > taken);
}

TEST_CASE("An error stands in the shot, and the next change tries again", "[view]") {
    const auto script = std::make_shared<Script>();
    bool works = false;
    PanelWorker worker("fake", [&](const PackedScene& packed) -> std::unique_ptr<Renderer> {
        if (!works) {
            throw Error("no memory\nfor this");
        }
        return fake_factory(script)(packed);
    });
    ViewJob job = job_of(small_scene(), 1);
    worker.post(job);
    const auto failed = await_shot(worker, [](const PanelShot& shot) { return !shot.error.empty(); });
    CHECK(failed->error == "no memory for this");
    CHECK(!failed->device_lost);
    CHECK_THROWS_AS(worker.film().get(), Error);
    CHECK_THROWS_AS(worker.record_path({}, 0).get(), Error);
    works = true;
    job.version = 2;
    worker.post(job);
    CHECK(await_shot(worker, shows(2))->error.empty());
}

TEST_CASE("A lost device keeps its last picture until a new renderer has another", "[view]") {
    const auto script = std::make_shared<Script>();
    PanelWorker worker("fake", fake_factory(script));
    ViewJob job = job_of(small_scene(), 1);
    worker.post(job);
    await_shot(worker, shows(1, 3));
    script->lose_device = true;
    const auto lost = await_shot(worker, [](const PanelShot& shot) { return shot.device_lost; });
    REQUIRE(lost->film);
    CHECK(lost->film->pixels[0].samples > 0);
    job.version = 2;
    job.state.time = 3;
    worker.post(job);  // kept for later
    script->lose_device = false;
    worker.recover(fake_factory(script));
    const auto again = await_shot(worker, shows(2));
    CHECK(!again->device_lost);
    CHECK(again->error.empty());
}

TEST_CASE("A panel ends while it renders, and answers who still asks", "[view]") {
    const auto script = std::make_shared<Script>();
    std::future<KeptFilm> film;
    {
        PanelWorker worker("fake", fake_factory(script));
        worker.post(job_of(small_scene(), 1));
        await_shot(worker, shows(1));
        script->close_gate(true);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        film = worker.film();
    }
    CHECK_THROWS_AS(film.get(), Error);
}

TEST_CASE("After any walk of changes a panel's film is that of a fresh renderer", "[view]") {
    const auto scene = small_scene();
    PanelWorker worker("cpu", cpu_factory(), 3);
    ViewJob job = job_of(scene, 0, 12);
    RenderSettings& settings = job.state.request.settings;
    const std::vector<std::function<void()>> walk = {
        [] {},
        [&] { settings.integrator = Integrator::brdf; },
        [&] {
            job.state.request.sun = Sun{30, 40, 2};
        },
        [&] { job.state.request.sun->azimuth = -80; },
        [&] { job.state.request.environment_scale = 0.25; },
        [&] { job.state.request.environment_rotation = 70; },
        [&] { settings.integrator = Integrator::ris; },
        [&] { settings.brdf = BrdfModel::blinn_phong; },
        [&] { job.state.request.environment_scale = 0; },
        [&] { settings.width = 20; },
        [&] { settings.first_hit_layers = true; },
        [&] { job.state.request.sun.reset(), job.state.request.environment_scale = 1; },
        [&] { settings.integrator = Integrator::path; },
        [&] { settings.max_depth = 1; },
        [&] { job.state.camera.lens.radius = 0.1; },
        [&] { settings.seed = 77; },
    };
    for (std::size_t i = 0; i < walk.size(); ++i) {
        INFO("step " << i);
        walk[i]();
        ++job.version;
        job.paused = false;
        worker.post(job);
        await_shot(worker, shows(job.version, 3));
        ++job.version;
        job.paused = true;
        worker.post(job);
        await_shot(worker, shows(job.version, 3));
        const KeptFilm kept = worker.film().get();
        CHECK(same_sums(kept.film, fresh_film(*scene, job.state, 3, kept.outcome.spp)));
        CHECK(kept.request.settings.seed == settings.seed + 3);
    }
}

TEST_CASE("A chain of frames goes on while the camera moves", "[view]") {
    const auto script = std::make_shared<Script>();
    PanelWorker worker("fake", fake_factory(script));
    ViewJob job = job_of(small_scene(), 1, 8);
    job.state.request.settings.integrator = Integrator::restir;
    job.frame_seconds = 1e-9;  // so that each chunk is one sample
    worker.post(job);
    const auto first = await_shot(worker, shows(1, 2));
    CHECK(first->correlated);
    CHECK(!first->figures.standard_error);
    job.version = 2;
    job.paused = true;
    worker.post(job);
    const std::uint32_t before = await_shot(worker, shows(2))->spp;
    script->take();
    job.version = 3;
    job.paused = false;
    job.state.camera.camera_to_world[3].y += 0.5;
    worker.post(job);
    CHECK(await_shot(worker, shows(3, 2))->spp >= 2);
    const std::vector<std::string> calls = script->take();
    REQUIRE(calls.size() >= 5);
    CHECK(calls[0] == "move");
    CHECK(calls[1] == "clear");
    CHECK(calls[2] == "render " + std::to_string(before) + " 1");  // indices go on
    CHECK(calls[3] == "move");                                     // the next frames look back to this same moment
    CHECK(calls[4].rfind("render " + std::to_string(before + 1) + " ", 0) == 0);
}

TEST_CASE("A path is recorded under the seed that is asked for", "[view]") {
    const auto scene = small_scene();
    PanelWorker worker("cpu", cpu_factory(), 3);
    ViewJob job = job_of(scene, 1, 12);
    worker.post(job);
    await_shot(worker, shows(1));
    const shared::PathQuery query{{6, 6}, 2};
    const RecordedPath path = worker.record_path(query, 9).get();
    RenderedState other = job.state;
    other.request.settings.seed = 9;
    Scene posed = *scene;
    put_moment(*scene, moment_of(other), other.request.settings.camera, posed);
    const PackedScene packed = pack_scene(posed, panel_settings(other.request.settings, 0, 1));
    RecordedPath fresh = make_cpu_renderer(packed, 1)->record_paths({&query, 1}).front();
    for (shared::PathVertexRecord& vertex : fresh.vertices) {  // a worker's are the scene's own
        vertex.position += vertex.instance != shared::NONE ? glm::vec3(packed.origin) : glm::vec3(0);
    }
    REQUIRE(path.vertices.size() == fresh.vertices.size());
    CHECK(!find_parting(path, fresh, 0));
    job.version = 2;
    job.state.request.settings.integrator = Integrator::ris;
    worker.post(job);
    await_shot(worker, shows(2));
    CHECK_THROWS_AS(worker.record_path(query, 9).get(), Error);
}
