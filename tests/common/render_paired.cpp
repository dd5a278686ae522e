// Where two recorded paths part, and the verdict over many.
#include "catch.h"

#include <random>

#include "measure/path_agreement.h"
#include "render/recorded_path.h"

using namespace diptych::core;

namespace {

RecordedPath short_path() {
    RecordedPath path;
    for (std::uint32_t i = 0; i < 3; ++i) {
        const shared::Hit hit{i, 2 * i, 7, glm::vec2(0.25F, 0.5F), 4};
        shared::PathVertexRecord v = shared::begin_vertex_record(glm::vec3(0, 0, 1), hit);
        v.position = glm::vec3(1, 2, static_cast<float>(i));
        v.light = 5;
        v.light_pdf = 0.25F;
        v.direct = glm::vec3(0.5F, 0.25F, 0.125F);
        v.lobe = shared::LOBE_DIFFUSE;
        v.throughput = glm::vec3(0.5F);
        path.vertices.push_back(v);
    }
    path.radiance = glm::vec3(1, 2, 3);
    return path;
}

shared::PathSummary summary_of(const RecordedPath& path) {
    shared::PathSummary s = shared::begin_path_summary();
    for (const shared::PathVertexRecord& v : path.vertices) {
        shared::summarize_vertex(s, v);
    }
    s.radiance = path.radiance;
    return s;
}

/// `count` paths, of which each `period`-th parts at vertex 1 with a difference drawn by `difference`.
template <class Difference>
PairedReport run_test(int count, int period, float rounding, Difference difference) {
    PairedTest test;
    RecordedPath parted = short_path();
    parted.vertices[1].primitive = 8;
    const shared::PathSummary b = summary_of(short_path());
    const shared::PathSummary other = summary_of(parted);
    for (int i = 0; i < count; ++i) {
        const bool parts = i % period == period - 1;
        shared::PathSummary a = parts ? other : b;
        a.radiance *= parts ? 1 + difference() : 1 + rounding;
        const shared::PathQuery query{{static_cast<std::uint32_t>(i), 0}, 0};
        const std::vector<bool> differs = test.add({&query, 1}, {&a, 1}, {&b, 1});
        CHECK(differs.front() == (parts || rounding > 1e-3F));
    }
    return test.report();
}

}  // namespace

TEST_CASE("paths part at the first field that differs, named", "[render]") {
    const RecordedPath a = short_path();
    CHECK_FALSE(find_parting(a, a, 0));

    RecordedPath b = a;
    b.vertices[2].light = 6;
    b.vertices[2].throughput *= 2;  // comes after the light
    std::optional<Parting> parting = find_parting(a, b, 1e-3);
    REQUIRE(parting);
    CHECK(parting->vertex == 2);
    CHECK(parting->field == RecordField::light);
    CHECK(parting->difference == 1);

    b = a;
    b.vertices[1].light_pdf = 0.2525F;
    parting = find_parting(a, b, 1e-3);
    REQUIRE(parting);
    CHECK(parting->field == RecordField::light_pdf);
    CHECK(parting->difference == Approx(0.0025 / 0.2525).epsilon(1e-3));
    CHECK_FALSE(find_parting(a, b, 0.02));

    b = a;
    b.vertices[0].position.x += 0.04F;  // a hundredth of the way there
    parting = find_parting(a, b, 1e-3);
    REQUIRE(parting);
    CHECK(parting->field == RecordField::position);
    CHECK(parting->difference == Approx(0.01).epsilon(1e-3));

    b = a;
    b.vertices.pop_back();
    parting = find_parting(a, b, 1e-3);
    REQUIRE(parting);
    CHECK(parting->vertex == 2);
    CHECK(parting->field == RecordField::length);

    b = a;
    b.radiance.y = NAN;
    parting = find_parting(a, b, 1e-3);
    REQUIRE(parting);
    CHECK(parting->field == RecordField::radiance);
}

TEST_CASE("every decision is in a path's signature, and tells where paths part", "[render]") {
    const RecordedPath path = short_path();
    const shared::PathSummary whole = summary_of(path);
    CHECK(first_divergence(whole, whole) == shared::NONE);
    using Change = void (*)(shared::PathVertexRecord&);
    const Change changes[] = {[](auto& v) { v.instance += 1; },
                              [](auto& v) { v.geometry += 1; },
                              [](auto& v) { v.primitive += 1; },
                              [](auto& v) { v.light += 1; },
                              [](auto& v) { v.shadow = shared::SHADOW_BLOCKED; },
                              [](auto& v) { v.lobe = shared::LOBE_SPECULAR; },
                              [](auto& v) { v.roulette = shared::ROULETTE_KILLED; }};
    for (const Change change : changes) {
        for (std::uint32_t at = 0; at < 3; ++at) {
            RecordedPath other = path;
            change(other.vertices[at]);
            CHECK(first_divergence(whole, summary_of(other)) == at);
        }
    }
    RecordedPath other = path;
    other.vertices[1].throughput *= 1.001F;  // measured, not decided
    CHECK(first_divergence(whole, summary_of(other)) == shared::NONE);
    other.vertices.pop_back();
    CHECK(first_divergence(whole, summary_of(other)) == 2);
    for (int i = 0; i < 30; ++i) {
        other.vertices.push_back(path.vertices[0]);
    }
    RecordedPath longer = other;
    longer.vertices.push_back(path.vertices[0]);
    CHECK(first_divergence(summary_of(other), summary_of(longer)) == shared::SIGNATURE_VERTICES - 1);
}

TEST_CASE("the paired test passes rounding and a few balanced partings, and nothing else", "[render]") {
    std::mt19937 random(3);
    std::normal_distribution<float> noise(0, 0.5F);
    const auto balanced = [&] { return noise(random); };

    const PairedReport good = run_test(20000, 1000, 1e-5F, balanced);
    CHECK(good.verdict == PairedVerdict::pass);
    CHECK(good.paths == 20000);
    CHECK(good.alike == 19980);
    CHECK(good.drifted == 0);
    REQUIRE(good.bounces.size() == 3);
    CHECK(good.bounces[0].parted == 0);
    CHECK(good.bounces[1].reached == 20000);
    CHECK(good.bounces[1].parted == 20);
    CHECK(good.bounces[2].reached == 19980);
    CHECK(good.bounces[1].p == Approx(0.5297).epsilon(1e-3));  // P(X >= 20) of a Poisson variable of mean 20
    CHECK(good.worst_relative == Approx(1e-5).epsilon(0.05));
    CHECK(good.parted_examples.size() == 5);
    CHECK(good.parted_examples[0].vertex == 1);

    const PairedReport apart = run_test(20000, 1000, 2e-3F, balanced);
    CHECK(apart.verdict == PairedVerdict::fail);
    CHECK(apart.drifted == 19980);
    CHECK(apart.drifted_examples.size() == 5);
    CHECK(run_test(20000, 300, 0, balanced).verdict == PairedVerdict::fail);
    const PairedReport leaning = run_test(60000, 1000, 0, [] { return -0.5F; });
    CHECK(leaning.verdict == PairedVerdict::fail);
    CHECK(leaning.divergent_z[0] == Approx(-std::sqrt(60.0)));
    CHECK(run_test(2000, 5000, 0, balanced).verdict == PairedVerdict::inconclusive);
}
