// --on-device-lost: commands of this process on renderers that are lost on demand.
#include "catch.h"

#include <array>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "../common/image_fixtures.h"
#include "backend/cpu_renderer.h"
#include "commands/program.h"
#include "error.h"
#include "image/image_file.h"
#include "session/make_renderer.h"

using namespace diptych::core;
using diptych::core::image_tests::TemporaryFolder;

namespace {

enum class Lost { in_render, in_restart, in_opening };

/// The CPU's renderer, lost in the call of that kind which counts `left` down to 0; renderers made later hold.
class LosingRenderer final : public Renderer {
public:
    LosingRenderer(const PackedScene& packed, Lost where, std::atomic<int>& left)
        : renderer_(make_cpu_renderer(packed, 1)), where_(where), left_(left) {
        note(Lost::in_opening);
        require();
    }
    std::string backend() const override { return "vulkan"; }
    std::string device() const override { return "a device"; }
    Capabilities capabilities() const override { return {true, true, false, false}; }
    RendererCosts costs() const override { return renderer_->costs(); }
    void render(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) override {
        note(Lost::in_render);
        require();
        renderer_->render(first, count, cancel);
    }
    void restart(std::uint32_t seed) override {
        note(Lost::in_restart);
        require();
        renderer_->restart(seed);
    }
    void clear_film() override {
        require();
        renderer_->clear_film();
    }
    void move_to(const PackedScene& moment) override {
        require();
        renderer_->move_to(moment);
    }
    double device_seconds() const override { return renderer_->device_seconds(); }
    Film film() const override {
        require();
        return renderer_->film();
    }
    TraversalBench bench_traversal(std::uint32_t samples) override { return renderer_->bench_traversal(samples); }

private:
    void note(Lost call) { lost_ = lost_ || (call == where_ && left_-- == 1); }
    void require() const {
        if (lost_) {
            throw DeviceLost("Vulkan, rendering: the device is lost");
        }
    }

    std::unique_ptr<Renderer> renderer_;
    Lost where_;
    std::atomic<int>& left_;
    bool lost_ = false;
};

/// Runs the program. Its device is lost in the call of that number; 0 is never.
int run_losing(int call, std::vector<std::string> words, Lost where = Lost::in_render) {
    std::atomic<int> left = call;
    app::replace_renderers([&](const Scene&, const PackedScene& packed, const RenderRequest& request) {
        std::unique_ptr<Renderer> renderer;
        if (request.backend == "vulkan") {
            renderer = std::make_unique<LosingRenderer>(packed, where, left);
        } else {
            renderer = make_cpu_renderer(packed, 1);
        }
        return renderer;
    });
    words.insert(words.begin(), "diptych");
    std::vector<char*> arguments;
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    const int code = app::run_program(static_cast<int>(arguments.size()), arguments.data());
    app::replace_renderers({});
    return code;
}

const std::string cornell = DIPTYCH_SOURCE_DIR "/scenes/cornell.gltf";
const std::string moving_light = DIPTYCH_SOURCE_DIR "/scenes/moving-light.gltf";

std::vector<std::string> on_vulkan(const std::string& command, const std::string& scene,
                                   std::vector<std::string> more) {
    std::vector<std::string> words = {command, scene, "--size", "16x16", "--max-depth", "2"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

std::string file_in(const TemporaryFolder& folder, const std::string& name) {
    return (folder / name).string();
}

bool equal_colors(const std::string& a, const std::string& b) {
    return read_image(a).color.data == read_image(b).color.data;
}

std::string text_in(const std::filesystem::path& path) {
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

}  // namespace

TEST_CASE("render: a picture whose device was lost is rendered to its end, or the render stops with exit code 3") {
    const TemporaryFolder folder;
    const auto render = [&](int call, const std::string& name, const std::string& choice) {
        return run_losing(call, on_vulkan("render", cornell,
                                          {"--backend", "vulkan", "--spp", "40", "-o", file_in(folder, name),
                                           "--on-device-lost", choice}));
    };
    REQUIRE(render(0, "whole.exr", "stop") == 0);
    CHECK(render(3, "retried.exr", "retry") == 0);
    CHECK(equal_colors(file_in(folder, "retried.exr"), file_in(folder, "whole.exr")));
    CHECK(render(3, "finished.exr", "cpu") == 0);
    CHECK(equal_colors(file_in(folder, "finished.exr"), file_in(folder, "whole.exr")));
    CHECK(read_image(file_in(folder, "finished.exr")).metadata.at("spp") == "40");
    CHECK(render(3, "stopped.exr", "stop") == 3);
    // It was lost before the film was read for the first time.
    CHECK_FALSE(std::filesystem::exists(file_in(folder, "stopped.exr")));
    CHECK(render(0, "unknown.exr", "never") == 2);
}

TEST_CASE("A device that is lost while its session opens is opened anew, the CPU goes on, or exit code 3") {
    const TemporaryFolder folder;
    const std::string scene = GENERATE(cornell, moving_light);
    const std::vector<std::string> frames =
        scene == moving_light ? std::vector<std::string>{"--frames", "1"} : std::vector<std::string>();
    const auto render = [&](int opening, const std::string& name, const std::string& choice) {
        std::vector<std::string> more = {"--backend", "vulkan", "--spp", "4", "-o", file_in(folder, name),
                                         "--on-device-lost", choice};
        more.insert(more.end(), frames.begin(), frames.end());
        return run_losing(opening, on_vulkan("render", scene, more), Lost::in_opening);
    };
    REQUIRE(render(0, "whole.exr", "stop") == 0);
    CHECK(render(1, "retried.exr", "retry") == 0);
    CHECK(equal_colors(file_in(folder, "retried.exr"), file_in(folder, "whole.exr")));
    CHECK(render(1, "finished.exr", "cpu") == 0);
    CHECK(equal_colors(file_in(folder, "finished.exr"), file_in(folder, "whole.exr")));
    CHECK(render(1, "stopped.exr", "stop") == 3);
    CHECK_FALSE(std::filesystem::exists(file_in(folder, "stopped.exr")));
}

TEST_CASE("verify and converge: a device that is lost while its session opens is opened anew, or exit code 3") {
    const TemporaryFolder folder;
    const auto verify = [&](int opening, const std::string& choice) {
        return run_losing(opening, on_vulkan("verify", moving_light, {"--runs", "4", "--spp", "2", "--integrators", "path",
                                                                      "--on-device-lost", choice}),
                          Lost::in_opening);
    };
    CHECK(verify(1, "retry") == 0);
    CHECK(verify(1, "stop") == 3);
    const auto converge = [&](const std::string& choice) {
        return run_losing(1, on_vulkan("converge", cornell, {"--methods", "vulkan:path", "--reference", "cpu:direct",
                                                             "--spp-max", "2", "--runs", "3", "-o",
                                                             file_in(folder, choice), "--on-device-lost", choice}),
                          Lost::in_opening);
    };
    CHECK(converge("retry") == 0);
    CHECK(converge("stop") == 3);
}

TEST_CASE("render: frames of a sequence whose device was lost are those of one that was not") {
    const TemporaryFolder folder;
    const std::string integrator = GENERATE("path", "restir");
    const auto render = [&](int call, const std::string& name) {
        return run_losing(call, on_vulkan("render", moving_light,
                                          {"--backend", "vulkan", "--spp", "2", "--frames", "3", "--integrator",
                                           integrator, "-o", file_in(folder, name + ".exr"), "--on-device-lost",
                                           "retry"}));
    };
    REQUIRE(render(0, "whole") == 0);
    REQUIRE(render(4, "retried") == 0);
    for (const char* frame : {".0000.exr", ".0001.exr", ".0002.exr"}) {
        INFO(integrator << " " << frame);
        CHECK(equal_colors(file_in(folder, "whole") + frame, file_in(folder, "retried") + frame));
    }
}

TEST_CASE("verify: a run that lost its device is rendered again, or ends the verification with exit code 3") {
    const TemporaryFolder folder;
    const auto verify = [&](int call, std::vector<std::string> more) {
        std::vector<std::string> words = on_vulkan("verify", moving_light, {"--runs", "4", "--spp", "2"});
        words.insert(words.end(), more.begin(), more.end());
        return run_losing(call, words);
    };
    /// Name and text of all figures of a verification that was to retry. They show the p-values of all tiles.
    const auto figures_of = [&](int call, std::vector<std::string> more) {
        const std::string figures = file_in(folder, "figures");
        std::filesystem::remove_all(figures);
        more.insert(more.end(), {"--on-device-lost", "retry", "-o", figures});
        CHECK(verify(call, more) == 0);
        std::map<std::string, std::string> texts;
        for (const auto& file : std::filesystem::directory_iterator(figures)) {
            texts[file.path().filename().string()] = text_in(file.path());
        }
        return texts;
    };
    const std::vector<std::string> at_rest = {"--integrators", "path"};
    const std::vector<std::string> chains = {"--integrators", "restir", "--frame", "0,2"};  // frame 0 is judged once
    for (const std::vector<std::string>& options : {at_rest, chains}) {
        INFO(options[1]);
        const auto expected = figures_of(0, options);
        CHECK_FALSE(expected.empty());
        CHECK(figures_of(3, options) == expected);
        CHECK(verify(3, options) == 3);
    }
    std::vector<std::string> by_cpu = at_rest;
    by_cpu.insert(by_cpu.end(), {"--on-device-lost", "cpu"});
    CHECK(verify(3, by_cpu) == 2);  // it would compare the CPU with itself
}

TEST_CASE("converge: a run that lost its device is rendered again, or the same command goes on") {
    const TemporaryFolder folder;
    // Each run begins with a restart.
    const auto converge = [&](int run, const std::string& name, const std::string& choice) {
        return run_losing(run,
                          on_vulkan("converge", cornell,
                                    {"--methods", "vulkan:path", "--reference", "cpu:direct", "--spp-max", "4",
                                     "--runs", "3", "-o", file_in(folder, name), "--on-device-lost", choice}),
                          Lost::in_restart);
    };
    /// Run, samples and error of all rows.
    const auto errors = [&](const std::string& name) {
        std::vector<std::array<double, 3>> rows;
        std::stringstream text(text_in(file_in(folder, name) + "/results.jsonl"));
        for (std::string line; std::getline(text, line);) {
            const nlohmann::json event = nlohmann::json::parse(line);
            for (const nlohmann::json& row : event.value("checkpoints", nlohmann::json::array())) {
                rows.push_back({event["run"], row["spp"], row["mse"]});
            }
        }
        return rows;
    };
    REQUIRE(converge(0, "whole", "stop") == 0);
    REQUIRE(errors("whole").size() == 9);
    CHECK(converge(2, "retried", "retry") == 0);
    CHECK(errors("retried") == errors("whole"));
    CHECK(converge(2, "stopped", "stop") == 3);
    CHECK(errors("stopped").size() == 3);  // the run before the loss is kept
    CHECK(converge(0, "stopped", "stop") == 0);
    CHECK(errors("stopped") == errors("whole"));
}
