#include "catch.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/progressive.h"

using namespace diptych::core;

namespace {

/// Two pixels, each sample is worth 1 and takes `sample_seconds` of a clock of its own.
class FakeRenderer : public Renderer {
public:
    explicit FakeRenderer(double sample_seconds) : sample_seconds_(sample_seconds) {
        film_.width = 2;
        film_.height = 1;
        film_.pixels.resize(2);
        film_.moments.resize(2);
    }

    std::string backend() const override { return "fake"; }
    std::string device() const override { return "none"; }
    Capabilities capabilities() const override { return {}; }
    RendererCosts costs() const override { return {}; }
    double device_seconds() const override { return clock; }
    TraversalBench bench_traversal(std::uint32_t) override { return {}; }

    void restart(std::uint32_t) override {}
    void move_to(const PackedScene&) override {}

    void render(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) override {
        firsts.push_back(first);
        counts.push_back(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            for (std::size_t pixel = 0; pixel < 2; ++pixel) {
                if (cancel) {
                    return;
                }
                const glm::vec3 radiance(noise ? 2 * ((first + i) % 2) : 1);
                shared::film_add(film_.pixels[pixel], radiance, 3);
                shared::film_add_moments(film_.moments[pixel], radiance);
                if (cancel_after > 0 && ++added_ == cancel_after) {
                    *to_cancel = true;
                }
            }
            const double machine = clock < slow_from ? 1 : 2;
            clock += machine * sample_seconds_ * (1 + slow_down * static_cast<double>(first + i));
        }
    }

    Film film() const override {
        ++looks;
        clock += look_seconds;
        return film_;
    }

    mutable double clock = 0;
    mutable int looks = 0;
    double look_seconds = 0;
    bool noise = false;
    double slow_down = 0;         // each sample takes longer than the one before by this share of the first
    double slow_from = HUGE_VAL;  // clock from which the machine has half its speed
    std::vector<std::uint32_t> firsts;
    std::vector<std::uint32_t> counts;
    std::uint32_t cancel_after = 0;  // samples of pixels
    std::atomic<bool>* to_cancel = nullptr;

private:
    double sample_seconds_;
    Film film_;
    std::uint32_t added_ = 0;
};

ProgressiveHooks clocked(FakeRenderer& renderer) {
    ProgressiveHooks hooks;
    hooks.now = [&renderer] { return renderer.clock; };
    return hooks;
}

}  // namespace

TEST_CASE("a sample count is met exactly, by batches that follow one another", "[render]") {
    FakeRenderer renderer(0.003);
    std::atomic<bool> cancel = false;
    ProgressiveTarget target;
    target.first = 10;
    target.spp = 1000;
    const ProgressiveResult result = render_progressively(renderer, target, cancel, clocked(renderer));
    CHECK(result.spp == 1000);
    CHECK(result.seconds == Approx(3));
    CHECK_FALSE(result.interrupted);
    std::uint32_t next = 10;
    for (std::size_t i = 0; i < renderer.counts.size(); ++i) {
        CHECK(renderer.firsts[i] == next);
        CHECK(renderer.counts[i] * 0.003 < 0.3);  // short enough to be told of
        next += renderer.counts[i];
    }
    CHECK(renderer.counts.size() < 25);  // and not all of them single samples
}

TEST_CASE("fast samples go in batches of at most 4096", "[render]") {
    FakeRenderer renderer(1e-9);
    std::atomic<bool> cancel = false;
    ProgressiveTarget target;
    target.spp = 100000;
    CHECK(render_progressively(renderer, target, cancel, clocked(renderer)).spp == 100000);
    CHECK(*std::max_element(renderer.counts.begin(), renderer.counts.end()) == 4096);
}

TEST_CASE("a time is met within five percent", "[render]") {
    const double sample_seconds = GENERATE(1e-6, 0.0007, 0.09);
    const double slow_down = GENERATE(0.0, 1e-6);
    FakeRenderer renderer(sample_seconds);
    renderer.slow_down = slow_down;
    std::atomic<bool> cancel = false;
    ProgressiveTarget target;
    target.seconds = 2;
    const ProgressiveResult result = render_progressively(renderer, target, cancel, clocked(renderer));
    CHECK(result.seconds == Approx(2).epsilon(0.05));
    CHECK(result.spp == renderer.film().pixels[0].samples);
    CHECK_FALSE(result.interrupted);
}

TEST_CASE("a time is met on a machine that has other work to do from some moment on", "[render]") {
    FakeRenderer renderer(GENERATE(1e-6, 0.0007, 0.009));
    renderer.slow_from = GENERATE(0.3, 0.375, 0.4, 0.45, 0.49);
    std::atomic<bool> cancel = false;
    ProgressiveTarget target;
    target.seconds = 0.5;
    CHECK(render_progressively(renderer, target, cancel, clocked(renderer)).seconds == Approx(0.5).epsilon(0.05));
}

TEST_CASE("a sample that outlasts the time is rendered whole, once", "[render]") {
    FakeRenderer renderer(10);
    std::atomic<bool> cancel = false;
    ProgressiveTarget target;
    target.seconds = 1;
    CHECK(render_progressively(renderer, target, cancel, clocked(renderer)).spp == 1);
}

TEST_CASE("an error target stops where the estimate meets it, at a count that hangs on no clock", "[render]") {
    const double sample_seconds = GENERATE(1e-6, 0.02);
    FakeRenderer renderer(sample_seconds);
    renderer.noise = true;  // radiance 0 and 2 in turn: variance 1, so the relMSE of N samples is about 1 / N / 1.01
    const std::atomic<bool> cancel = false;
    ProgressiveTarget target;
    target.relmse = 0.005;
    std::vector<Progress> reports;
    ProgressiveHooks hooks = clocked(renderer);
    hooks.progress = [&](const Progress& progress) { reports.push_back(progress); };
    const ProgressiveResult result = render_progressively(renderer, target, cancel, hooks);
    CHECK(result.target_met);
    CHECK_FALSE(result.interrupted);
    CHECK(result.spp >= 198);
    CHECK(result.spp <= 200);
    REQUIRE(reports.back().relmse);
    CHECK(*reports.back().relmse <= 0.005);
    CHECK(std::isinf(reports.front().eta_seconds));  // nothing is known before 16 samples
    CHECK(reports[reports.size() - 2].eta_seconds ==
          Approx((200 - reports[reports.size() - 2].spp) * sample_seconds).epsilon(0.1));
    // Other limits still hold, and the first one met counts.
    FakeRenderer limited(sample_seconds);
    limited.noise = true;
    target.spp = 50;
    const ProgressiveResult short_of_it = render_progressively(limited, target, cancel, clocked(limited));
    CHECK(short_of_it.spp == 50);
    CHECK_FALSE(short_of_it.target_met);
    CHECK_FALSE(short_of_it.interrupted);
}

TEST_CASE("a few equal samples do not pass for exact", "[render]") {
    FakeRenderer renderer(0.001);
    const std::atomic<bool> cancel = false;
    ProgressiveTarget target;
    target.relmse = 0.1;
    CHECK(render_progressively(renderer, target, cancel, clocked(renderer)).spp == least_judged_samples);
}

TEST_CASE("cancelling keeps what every pixel has", "[render]") {
    FakeRenderer renderer(0.001);
    std::atomic<bool> cancel = false;
    renderer.to_cancel = &cancel;
    renderer.cancel_after = 2 * 500 + 1;  // 500 whole samples, and one pixel more
    ProgressiveTarget target;
    target.spp = 100000;
    const ProgressiveResult result = render_progressively(renderer, target, cancel, clocked(renderer));
    CHECK(result.interrupted);
    CHECK(result.spp == 500);
    CHECK(renderer.film().pixels[0].samples == 501);
}

TEST_CASE("cancelling before the start renders nothing", "[render]") {
    FakeRenderer renderer(0.001);
    const std::atomic<bool> cancel = true;
    ProgressiveTarget target;
    target.spp = 5;
    const ProgressiveResult result = render_progressively(renderer, target, cancel, clocked(renderer));
    CHECK(result.interrupted);
    CHECK(result.spp == 0);
    CHECK(renderer.counts.empty());
}

TEST_CASE("progress tells speed, time left and error, and looks at the film sparingly", "[render]") {
    FakeRenderer renderer(0.01);
    renderer.look_seconds = 0.1;
    std::atomic<bool> cancel = false;
    std::vector<Progress> reports;
    ProgressiveHooks hooks = clocked(renderer);
    hooks.progress = [&](const Progress& progress) { reports.push_back(progress); };
    ProgressiveTarget target;
    target.spp = 2000;
    const ProgressiveResult result = render_progressively(renderer, target, cancel, hooks);
    REQUIRE(reports.size() > 10);
    const Progress& last = reports.back();
    CHECK(last.spp == 2000);
    CHECK(last.eta_seconds == 0);
    CHECK(last.samples_per_second == Approx(2 / 0.01));
    CHECK(last.rays_per_second == Approx(2 * 3 / 0.01));
    REQUIRE(last.relmse);
    CHECK(*last.relmse == 0);
    CHECK(reports.front().eta_seconds == Approx(1999 * 0.01));
    CHECK(result.seconds == Approx(20));      // looking is not rendering
    CHECK(renderer.looks * 0.1 < 0.05 * 20);  // a look costs 0.1 s, so they come 5 s apart
}
