#include "catch.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>

#include "../common/generate_fixture.h"
#include "error.h"
#include "fixture.h"
#include "measure/converge/measurement.h"

using namespace diptych::core;
using namespace diptych::core::measure_tests;
using diptych::core::generate_tests::TemporaryFolder;

namespace {

constexpr std::uint32_t runs = 2;

Method method(const std::string& name, Integrator integrator, std::uint32_t place, SeedPurpose purpose) {
    Method method{.name = name, .request = small_request(), .seeds = SeedPlan(1, purpose, 2, 16), .place = place};
    method.request.settings.integrator = integrator;
    method.request.settings.seed = method.seed_of(0);
    method.picture_seed = SeedPlan(1, SeedPurpose::converge_picture, 2, 1).seed(place, 0);
    return method;
}

ConvergeSubject subject_of(const Scene& scene) {
    return {scene,
            {method("cpu:brdf", Integrator::brdf, 0, SeedPurpose::converge),
             method("cpu:path", Integrator::path, 1, SeedPurpose::converge)},
            {},
            method("cpu:path with seeds of its own", Integrator::path, 0, SeedPurpose::converge_reference),
            open_on_cpu};
}

struct Measured {
    bool whole = false;
    int steps = 0;
    std::optional<ConvergeSummary> summary;
    std::vector<ErrorRow> rows;
};

/// Cancelled as that step begins; never for 0.
Measured measure(const std::filesystem::path& folder, const ConvergeSubject& subject, int cancel_at = 0) {
    std::filesystem::create_directories(folder);
    ConvergeSettings settings;
    settings.runs = runs;
    settings.spp_max = 5;  // 4 is the power of two that is not above it
    settings.picture_seconds = 1e-3;
    settings.maker.program = "a test";
    ConvergeState state(folder.string());
    std::atomic<bool> cancel = false;
    Measured measured;
    const StepHook begin = [&](const std::string&) { cancel = ++measured.steps == cancel_at || cancel; };
    ConvergeMeasurement measurement(settings, subject, state, begin);
    measured.whole = measurement.run(cancel);
    CHECK(measured.steps <= converge_steps(settings, subject.methods.size()));
    measured.summary = measurement.summary();
    measured.rows = state.rows();
    return measured;
}

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

/// Method, run, samples and errors, as the bits are, in any order.
std::set<std::tuple<std::string, std::uint32_t, std::uint32_t, double, double>> errors(const Measured& measured) {
    std::set<std::tuple<std::string, std::uint32_t, std::uint32_t, double, double>> all;
    for (const ErrorRow& row : measured.rows) {
        all.emplace(row.method, row.run, row.spp, row.mse, row.relmse);
    }
    return all;
}

}  // namespace

TEST_CASE("The engine of converge measures every method at 1, 2, 4... samples and says what it found") {
    const TemporaryFolder folder;
    const Scene scene = cornell();
    const ConvergeSubject subject = subject_of(scene);
    const Measured measured = measure(folder.path(), subject);
    REQUIRE(measured.whole);
    CHECK(measured.rows.size() == 2 * runs * 3);
    REQUIRE(measured.summary);
    REQUIRE(measured.summary->methods.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        const MethodSummary& method = measured.summary->methods[i];
        CHECK(method.method == &subject.methods[i]);
        CHECK(method.runs == runs);
        REQUIRE(method.checkpoints.size() == 3);
        CHECK(method.checkpoints.back().spp == 4);
        CHECK(method.checkpoints.back().mse.value < method.checkpoints.front().mse.value);
        REQUIRE(method.setup);
        CHECK(method.setup->bytes > 0);
        REQUIRE(method.picture);
        CHECK(method.picture->wanted_seconds == 1e-3);
    }
}

TEST_CASE("The engine of converge goes on from wherever it was cancelled, to the same errors") {
    const TemporaryFolder folder;
    const Scene scene = cornell();
    const ConvergeSubject subject = subject_of(scene);
    const Measured whole = measure(folder.path() / "whole", subject);
    REQUIRE(whole.whole);
    // The reference's first and last block, a run, the last picture.
    const int blocks = static_cast<int>(reference_blocks);
    for (const int step : {1, blocks, blocks + 2, whole.steps}) {
        INFO("cancelled at step " << step);
        const std::filesystem::path place = folder.path() / std::to_string(step);
        const Measured stopped = measure(place, subject, step);
        CHECK_FALSE(stopped.whole);
        CHECK(stopped.steps == step);
        CHECK(stopped.summary.has_value() == (step > blocks + 1));
        const Measured resumed = measure(place, subject);
        REQUIRE(resumed.whole);
        CHECK(errors(resumed) == errors(whole));
        CHECK(resumed.summary->noise.mse == whole.summary->noise.mse);
    }
}

TEST_CASE("What a folder of converge's holds is read back as it was written") {
    const TemporaryFolder folder;
    const MethodSetup setup{"a device", 0.25, 0.5, 0.125, 77};
    const MethodPicture picture{2, 3, 0.1, std::nan(""), "diptych render"};
    ErrorRow row;
    row.method = "cpu:path";
    row.seed = 12;
    row.spp = 4;
    row.mse = 0.1;
    row.rays = 1ULL << 40U;
    {
        ConvergeState state(folder.path().string());
        CHECK_FALSE(state.load_seconds().has_value());
        CHECK_FALSE(state.setup("cpu:path").has_value());
        state.set_load_seconds(1.5);
        state.set_limit("cpu:path", 8);
        state.set_limit("cpu:path", 16);
        state.set_setup("cpu:path", setup);
        state.set_reference({"cpu:brdf", "a device", 64, 16, 0.3});
        state.set_picture("cpu:path", picture);
        state.append({row});
    }
    const ConvergeState state(folder.path().string());
    CHECK(state.load_seconds() == 1.5);
    CHECK(state.limit("cpu:path") == 16U);
    CHECK_FALSE(state.limit("cpu:brdf").has_value());
    REQUIRE(state.setup("cpu:path"));
    CHECK(state.setup("cpu:path")->device == "a device");
    CHECK(state.setup("cpu:path")->compile_seconds == 0.125);
    CHECK(state.setup("cpu:path")->bytes == 77);
    REQUIRE(state.reference());
    CHECK(state.reference()->blocks == 16);
    REQUIRE(state.picture("cpu:path"));
    CHECK(state.picture("cpu:path")->spp == 3);
    CHECK(std::isnan(state.picture("cpu:path")->relmse));
    REQUIRE(state.rows().size() == 1);
    CHECK(state.rows().front().mse == 0.1);
    CHECK(state.rows().front().rays == 1ULL << 40U);
    CHECK(state.runs("cpu:path") == 1);
}

TEST_CASE("A file of converge's that is damaged is named, and nothing is measured with it") {
    const TemporaryFolder folder;
    const Scene scene = cornell();
    const ConvergeSubject subject = subject_of(scene);
    REQUIRE(measure(folder.path(), subject).whole);
    const auto refused = [&](const std::string& file, const std::function<void(std::string&)>& damage) {
        const std::filesystem::path path = folder.path() / file;
        const std::string before = text_of(path);
        std::string after = before;
        damage(after);
        write(path, after);
        std::string said;
        try {
            measure(folder.path(), subject);
        } catch (const Error& error) {
            said = error.what();
        }
        INFO(said);
        CHECK(said.find(path.string() + ": ") == 0);
        CHECK(said.find("is damaged") != std::string::npos);
        write(path, before);
    };
    refused("cpu-path.sums", [](std::string& bytes) { bytes[bytes.size() / 2] ^= 1; });
    refused("cpu-path.sums", [](std::string& bytes) { bytes.resize(bytes.size() - 1); });
    refused("cpu-path.sums", [](std::string& bytes) { bytes += '\0'; });
    refused("cpu-brdf.sums", [](std::string& bytes) { bytes.clear(); });
    refused("results.jsonl", [](std::string& lines) { lines.insert(lines.find('\n') + 1, "[1]\n"); });
    refused("results.jsonl", [](std::string& lines) { lines.insert(lines.find('\n') + 1, "{\"kind\": \"run\"}\n"); });
    refused("results.jsonl", [](std::string& lines) { lines.insert(lines.find('\n') + 1, "{\"kind\": \n"); });
    CHECK(measure(folder.path(), subject).whole);
    write(folder.path() / "reference.blocks", std::string(40, 'x'));
    std::filesystem::remove(folder.path() / "reference.exr");
    refused("reference.blocks", [](std::string&) {});
}
