// Records and signatures of paths.
#include "path/path_record.h"

#include <set>

#include "catch.h"

using namespace diptych::core::shared;

namespace {

Hit hit_at(uint instance) {
    return {instance, 3, 4, vec2(0.25f, 0.5f), 7.0f};
}

}  // namespace

TEST_CASE("A vertex's record begins with its hit and nothing done, and a miss has no ids") {
    const PathVertexRecord v = begin_vertex_record(vec3(0, 0, 1), hit_at(2));
    CHECK(v.direction == vec3(0, 0, 1));
    CHECK(v.instance == 2);
    CHECK(v.geometry == 3);
    CHECK(v.primitive == 4);
    CHECK(v.barycentrics == vec2(0.25f, 0.5f));
    CHECK(v.t == 7.0f);
    CHECK(v.survival == 1.0f);  // no roulette
    CHECK(v.emission_weight == 0.0f);
    CHECK(v.light == NONE);
    CHECK(v.shadow == SHADOW_NOT_TRACED);
    CHECK(v.lobe == LOBE_NONE);
    CHECK(v.roulette == ROULETTE_NOT_PLAYED);
    const PathVertexRecord miss = begin_vertex_record(vec3(0, 0, 1), hit_at(NONE));
    CHECK(miss.instance == NONE);
    CHECK(miss.geometry == NONE);
    CHECK(miss.primitive == NONE);
    CHECK(miss.barycentrics == vec2(0.0f, 0.0f));
    CHECK(miss.t == INFINITE_DISTANCE);
}

TEST_CASE("A signature tells paths apart from the vertex on where they decide otherwise, past its end too") {
    const PathVertexRecord same = begin_vertex_record(vec3(0, 0, 1), hit_at(2));
    constexpr uint length = SIGNATURE_VERTICES + 4;
    for (uint parting = 0; parting < length; parting++) {
        PathSummary a = begin_path_summary();
        PathSummary b = begin_path_summary();
        for (uint n = 0; n < length; n++) {
            summarize_vertex(a, same);
            PathVertexRecord other = same;
            other.shadow = n == parting ? SHADOW_FREE : same.shadow;
            summarize_vertex(b, other);
        }
        CAPTURE(parting);
        CHECK(a.vertices == length);
        for (uint n = 0; n < SIGNATURE_VERTICES; n++) {
            CHECK((a.signature[n] == b.signature[n]) == (n < parting && n + 1 < SIGNATURE_VERTICES));
        }
    }
}

TEST_CASE("Every decision at a vertex is in its signature") {
    const PathVertexRecord v = begin_vertex_record(vec3(0, 0, 1), hit_at(2));
    std::set<uint> seen{vertex_decisions(v)};
    const auto differs = [&](auto change) {
        PathVertexRecord other = v;
        change(other);
        return seen.insert(vertex_decisions(other)).second;
    };
    CHECK(differs([](PathVertexRecord& o) { o.instance = 3; }));
    CHECK(differs([](PathVertexRecord& o) { o.geometry = 2; }));
    CHECK(differs([](PathVertexRecord& o) { o.primitive = 5; }));
    CHECK(differs([](PathVertexRecord& o) { o.light = 0; }));
    CHECK(differs([](PathVertexRecord& o) { o.shadow = SHADOW_BLOCKED; }));
    CHECK(differs([](PathVertexRecord& o) { o.lobe = LOBE_MIRROR; }));
    CHECK(differs([](PathVertexRecord& o) { o.lobe = LOBE_MIRROR | FACET_TANGENT; }));
    CHECK(differs([](PathVertexRecord& o) { o.roulette = ROULETTE_NOT_PLAYED + 1; }));
}
