// What tests of a view share: a small scene, a wait for shots, a renderer that obeys.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "catch.h"
#include "error.h"
#include "generate/shapes.h"
#include "view/panel_worker.h"

namespace diptych::core::tests {

/// A lit square under a constant sky.
inline std::shared_ptr<Scene> small_scene() {
    auto scene = std::make_shared<Scene>();
    scene->name = "small";
    Primitive square;
    square.material = add_material(*scene, make_material("matter", glm::vec3(0.5F), 0, 1));
    add_quad(square, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
    add_object(*scene, "square", {square});
    scene->cameras.push_back(make_camera("camera", {0, 1, 3}, {0, 0, 0}, 45));
    scene->environment.kind = EnvironmentKind::constant;
    return scene;
}

inline app::ViewJob job_of(const std::shared_ptr<const Scene>& scene, std::uint64_t version, int size = 16) {
    app::ViewJob job;
    job.scene = scene;
    job.version = version;
    job.state.scene = 1;
    job.state.camera = scene->cameras.at(0);
    RenderSettings& settings = job.state.request.settings;
    settings.width = size;
    settings.height = size;
    settings.standard_error = true;
    settings.max_depth = 2;
    return job;
}

using Shown = std::function<bool(const app::PanelShot&)>;

/// The first shot that is as wanted; fails the test after half a minute.
inline std::shared_ptr<const app::PanelShot> await_shot(const app::PanelWorker& worker, const Shown& wanted) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (std::chrono::steady_clock::now() < end) {
        const auto shot = worker.shot();
        if (wanted(*shot)) {
            return shot;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    FAIL("no such shot came: version " << worker.shot()->version << ", spp " << worker.shot()->spp << ", error '"
                                       << worker.shot()->error << "'");
    return nullptr;
}

/// What a fake renderer was told, in order, and what it is to do.
class Script {
public:
    void note(const std::string& call) {
        const std::lock_guard lock(mutex_);
        calls_.push_back(call);
    }
    std::vector<std::string> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(calls_, {});
    }
    /// Renders wait while it is closed, or until they are cancelled.
    void close_gate(bool closed) {
        const std::lock_guard lock(mutex_);
        closed_ = closed;
    }
    bool closed() {
        const std::lock_guard lock(mutex_);
        return closed_;
    }
    std::atomic<int> cut_short = 0;
    std::atomic<bool> lose_device = false;

private:
    std::mutex mutex_;
    std::vector<std::string> calls_;
    bool closed_ = false;
};

class FakeRenderer final : public Renderer {
public:
    FakeRenderer(std::shared_ptr<Script> script, const PackedScene& packed) : script_(std::move(script)) {
        script_->note("make");
        size(packed);
    }

    std::string backend() const override { return "fake"; }
    std::string device() const override { return "none"; }
    Capabilities capabilities() const override { return {true, true, false, true}; }
    RendererCosts costs() const override { return {}; }

    void render(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) override {
        script_->note("render " + std::to_string(first) + " " + std::to_string(count));
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        while (script_->closed() && !cancel) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        if (script_->lose_device) {
            throw DeviceLost("the device is lost");
        }
        if (cancel) {
            ++script_->cut_short;
            return;
        }
        for (shared::FilmPixel& pixel : film_.pixels) {
            pixel.samples += count;
        }
    }
    void restart(std::uint32_t seed) override {
        script_->note("restart " + std::to_string(seed));
        empty();
    }
    void clear_film() override {
        script_->note("clear");
        empty();
    }
    void move_to(const PackedScene&) override { script_->note("move"); }
    void reconfigure(const PackedScene& packed) override {
        script_->note("reconfigure " + std::to_string(packed.constants.size.x));
        size(packed);
    }
    double device_seconds() const override { return 0; }
    Film film() const override { return film_; }
    TraversalBench bench_traversal(std::uint32_t) override { return {}; }

private:
    void size(const PackedScene& packed) {
        film_.width = static_cast<int>(packed.constants.size.x);
        film_.height = static_cast<int>(packed.constants.size.y);
        empty();
    }
    void empty() {
        film_.pixels.assign(static_cast<std::size_t>(film_.width) * static_cast<std::size_t>(film_.height), {});
    }

    std::shared_ptr<Script> script_;
    Film film_;
};

inline app::RendererFactory fake_factory(const std::shared_ptr<Script>& script) {
    return [script](const PackedScene& packed) { return std::make_unique<FakeRenderer>(script, packed); };
}

}  // namespace diptych::core::tests
