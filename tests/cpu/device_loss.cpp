// How a picture outlasts the loss of its device, shown on renderers that are lost on demand.
#include "clock.h"
#include "error.h"
#include "generate/generate.h"
#include "render/lasting_picture.h"
#include "render/merge_films.h"
#include "render/progressive.h"
#include "render_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

const std::atomic<bool> never{false};

/// When devices are lost: the number of render calls that each of them, in the order of their opening, lets pass.
struct Losses {
    std::vector<int> passing;  // beyond these, devices hold
    int opened = 0;
    int refused = 0;  // openings that fail after the first
};

/// The CPU's renderer as a device that can be lost.
class LosingRenderer final : public Renderer {
public:
    LosingRenderer(std::unique_ptr<Renderer> renderer, std::string name, int passing)
        : renderer_(std::move(renderer)), name_(std::move(name)), passing_(passing) {}
    std::string backend() const override { return "vulkan"; }
    std::string device() const override { return name_; }
    Capabilities capabilities() const override { return renderer_->capabilities(); }
    RendererCosts costs() const override { return renderer_->costs(); }
    void render(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) override {
        lost_ = lost_ || passing_-- == 0;
        require();
        renderer_->render(first, count, cancel);
    }
    void restart(std::uint32_t seed) override {
        require();
        renderer_->restart(seed);
    }
    void clear_film() override {
        require();
        renderer_->clear_film();
    }
    void move_to(const PackedScene& moment) override { renderer_->move_to(moment); }
    double device_seconds() const override { return renderer_->device_seconds(); }
    Film film() const override {
        require();
        return renderer_->film();
    }
    TraversalBench bench_traversal(std::uint32_t samples) override { return renderer_->bench_traversal(samples); }

private:
    void require() const {
        if (lost_) {
            throw DeviceLost(name_ + " is lost");
        }
    }

    std::unique_ptr<Renderer> renderer_;
    std::string name_;
    int passing_;
    bool lost_ = false;
};

MakeRenderer losing(Losses& losses) {
    return [&losses](const Scene&, const PackedScene& packed, const RenderSettings&) {
        const auto place = static_cast<std::size_t>(losses.opened++);
        if (place > 0 && losses.refused-- > 0) {
            throw NoDevice("no device yet");
        }
        const int passing = place < losses.passing.size() ? losses.passing[place] : -1;
        return std::make_unique<LosingRenderer>(make_cpu_renderer(packed, 2), "device", passing);
    };
}

std::unique_ptr<Renderer> on_cpu(const Scene&, const PackedScene& packed, const RenderSettings&) {
    return make_cpu_renderer(packed, 2);
}

RenderSettings small_settings(Integrator integrator = Integrator::path) {
    RenderSettings s;
    s.width = 20;
    s.height = 15;
    s.integrator = integrator;
    s.max_depth = 3;
    s.seed = 5;
    s.standard_error = s.first_hit_layers = true;
    return s;
}

DeviceLossPolicy policy_of(OnDeviceLost choice, std::vector<std::string>* reported = nullptr) {
    DeviceLossPolicy policy;
    policy.choice = choice;
    policy.first_pause = 0;
    policy.cpu = on_cpu;
    if (reported != nullptr) {
        policy.report = [reported](const std::string& line) { reported->push_back(line); };
    }
    return policy;
}

/// The film of samples [0, count), rendered in two parts that were merged.
Film in_parts(const Scene& scene, const RenderSettings& settings, std::uint32_t first_part, std::uint32_t count) {
    Session session(scene, settings, on_cpu);
    session.render(0, first_part, never);
    Film film = session.film();
    session.restart(settings.seed);
    session.render(first_part, count - first_part, never);
    merge_films(session.film(), film);
    return film;
}

}  // namespace

TEST_CASE("A picture goes on from the film that was read last, on the device or on the CPU, with the same samples") {
    const Scene scene = generate_scene("cornell").scene;
    const auto choice = GENERATE(OnDeviceLost::retry, OnDeviceLost::cpu);
    Losses losses{.passing = {3}};  // lost in the fourth call
    std::vector<std::string> reported;
    Session session(scene, small_settings(), losing(losses));
    LossGuard guard(policy_of(choice, &reported));
    LastingPicture picture(session, guard, never, {});
    picture.render(0, 2, never);
    picture.render(2, 3, never);
    CHECK(picture.film().pixels[0].samples == 5);
    picture.render(5, 1, never);  // not read, so it is lost and rendered again
    picture.render(6, 2, never);
    CHECK(picture.lost_samples() == 3);  // of which the film does not know yet
    CHECK(same_film(picture.film(), in_parts(scene, small_settings(), 5, 8)));
    CHECK(picture.lost_samples() == 0);
    CHECK(guard.losses() == 1);
    REQUIRE(reported.size() == 1);
    if (choice == OnDeviceLost::cpu) {
        CHECK(reported[0] == "device is lost; the CPU goes on");
        CHECK(picture.device() == "device; " + session.renderer().device() + " from sample 5 on");
        CHECK(losses.opened == 1);
    } else {
        CHECK(reported[0] == "device is lost; retry 1 of 3 in 0 s");
        CHECK(picture.device() == "device");
        CHECK(losses.opened == 2);
    }
}

TEST_CASE("Frames of restir that lost their device begin anew, with the bits of frames that did not") {
    const Scene scene = generate_scene("cornell").scene;
    const RenderSettings settings = small_settings(Integrator::restir);
    Losses losses{.passing = {3}};
    Session session(scene, settings, losing(losses));
    LossGuard guard(policy_of(OnDeviceLost::retry));
    const auto warm_up = [&] {
        session.render(0, 2, never);
        session.next_picture();
    };
    warm_up();
    LastingPicture picture(session, guard, never, warm_up);
    picture.render(0, 2, never);
    CHECK(picture.film().pixels[0].samples == 2);
    picture.render(2, 1, never);
    picture.render(3, 1, never);
    CHECK(guard.losses() == 1);

    Session undisturbed(scene, settings, on_cpu);
    undisturbed.render(0, 2, never);
    undisturbed.next_picture();
    undisturbed.render(0, 4, never);
    CHECK(same_film(picture.film(), undisturbed.film()));
}

TEST_CASE("Devices may be lost one after another before a film has been read") {
    const Scene scene = generate_scene("cornell").scene;
    Losses losses{.passing = {2, 0}};  // the second device is lost at once
    Session session(scene, small_settings(), losing(losses));
    LossGuard guard(policy_of(OnDeviceLost::retry));
    LastingPicture picture(session, guard, never, {});
    ProgressiveTarget target;
    target.spp = 8;
    ProgressiveHooks hooks;
    const ProgressiveResult result = render_progressively(picture, target, never, hooks);
    CHECK(result.spp == 8);
    CHECK_FALSE(result.interrupted);
    const Film film = picture.film();
    CHECK(film_totals(film).samples == std::uint64_t{8} * 20 * 15);
    CHECK(guard.losses() == 2);
    CHECK(same_film(film, render_cpu(scene, small_settings(), 8)));  // the same bits: nothing was there to be merged
}

TEST_CASE("A lost device ends the picture where it is to stop, and what was read last is kept") {
    const Scene scene = generate_scene("cornell").scene;
    Losses losses{.passing = {2}};
    Session session(scene, small_settings(), losing(losses));
    LossGuard guard(policy_of(OnDeviceLost::stop));
    LastingPicture picture(session, guard, never, {});
    picture.render(0, 4, never);
    const Film read = picture.film();
    picture.render(4, 2, never);
    CHECK_THROWS_AS(picture.render(6, 3, never), DeviceLost);
    CHECK(same_film(picture.kept(), read));
    CHECK(picture.kept_samples() == 4);
    CHECK(picture.lost_samples() == 5);
}

TEST_CASE("Retries end after so many losses, and a device that cannot be opened counts as one") {
    const Scene scene = generate_scene("cornell").scene;
    std::vector<std::string> reported;
    Losses losses{.passing = {0, 0, 0, 0, 0}};
    SECTION("lost again and again") {}
    SECTION("not to be opened") { losses.refused = 2; }
    Session session(scene, small_settings(), losing(losses));
    LossGuard guard(policy_of(OnDeviceLost::retry, &reported));
    LastingPicture picture(session, guard, never, {});
    CHECK_THROWS_WITH(picture.render(0, 1, never), Catch::Contains("is lost; it was opened anew 3 times"));
    CHECK(reported.size() == 3);
    CHECK(losses.opened == 4);
}

TEST_CASE("Pauses grow, and an interrupt ends them and the retries") {
    DeviceLossPolicy policy = policy_of(OnDeviceLost::retry);
    std::vector<std::string> reported;
    policy.report = [&](const std::string& line) { reported.push_back(line); };
    policy.first_pause = 0.02;
    LossGuard guard(policy);
    const double begin = now_seconds();
    CHECK_THROWS_AS(guard.run(never, [] { throw DeviceLost("gone"); }, [] {}), DeviceLost);
    CHECK(now_seconds() - begin >= 0.02 + 0.04 + 0.08);

    policy.first_pause = 1000;
    std::atomic<bool> cancel{false};
    policy.report = [&](const std::string&) { cancel = true; };  // the interrupt comes during the pause
    LossGuard interrupted(policy);
    CHECK_THROWS_AS(interrupted.run(cancel, [] { throw DeviceLost("gone"); }, [] {}), DeviceLost);
    CHECK(interrupted.losses() == 2);
}
