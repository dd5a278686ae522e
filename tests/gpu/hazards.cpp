// Barriers between passes: enough of them, and none too many.
#include "commands/hazards.h"

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "catch.h"
#include "passes/pass_table.h"

namespace diptych::core::tests {
namespace {

using Pass = std::vector<Use>;

/// A sequence of passes, and the barrier before each that has one.
struct Sequence {
    std::vector<Pass> passes;
    std::vector<std::optional<Barrier>> barriers;
};

Sequence follow(std::vector<Pass> passes) {
    Sequence sequence{.passes = std::move(passes), .barriers = {}};
    Hazards hazards;
    for (const Pass& pass : sequence.passes) {
        sequence.barriers.push_back(hazards.next(pass));
    }
    return sequence;
}

bool conflict(const Use& a, const Use& b) {
    return a.resource == b.resource && (a.effect != Effect::read || b.effect != Effect::read) &&
           (a.effect != Effect::append || b.effect != Effect::append);
}

/// Whether b of pass j comes after a of pass i: by a barrier between them, or by a write of the same resource that
/// comes after a and before b.
bool ordered(const Sequence& sequence, std::size_t i, const Use& a, std::size_t j, const Use& b) {
    for (std::size_t k = i + 1; k <= j; ++k) {
        const std::optional<Barrier>& barrier = sequence.barriers[k];
        if (barrier && (barrier->before & bit(a.unit)) != 0 && (barrier->after & bit(b.unit)) != 0) {
            return true;
        }
    }
    for (std::size_t k = i + 1; k < j; ++k) {
        for (const Use& between : sequence.passes[k]) {
            if (between.resource == a.resource && between.effect == Effect::write &&
                ordered(sequence, i, a, k, between) && ordered(sequence, k, between, j, b)) {
                return true;
            }
        }
    }
    return false;
}

/// Pairs of uses that conflict and are not ordered.
int hazards_left(const Sequence& sequence) {
    int left = 0;
    for (std::size_t j = 0; j < sequence.passes.size(); ++j) {
        for (std::size_t i = 0; i < j; ++i) {
            for (const Use& a : sequence.passes[i]) {
                for (const Use& b : sequence.passes[j]) {
                    left += conflict(a, b) && !ordered(sequence, i, a, j, b) ? 1 : 0;
                }
            }
        }
    }
    return left;
}

std::vector<Pass> random_passes(std::mt19937& random) {
    const auto below = [&](unsigned limit) { return static_cast<unsigned>(random() % limit); };
    std::vector<Pass> passes(9);
    for (Pass& pass : passes) {
        pass.resize(1 + below(3));
        for (Use& use : pass) {
            use = {static_cast<Resource>(below(3)), static_cast<Unit>(below(4)), static_cast<Effect>(below(3))};
        }
    }
    return passes;
}

Pass of_shader(std::string_view shader, const Pass& more = {}) {
    const auto table = pass_table();
    const auto found =
        std::find_if(table.begin(), table.end(), [&](const PassUses& pass) { return pass.shader == shader; });
    REQUIRE(found != table.end());
    Pass uses = found->uses;
    uses.insert(uses.end(), more.begin(), more.end());
    return uses;
}

/// One letter a pass: | where a barrier stands before it.
std::string bars(const Sequence& sequence) {
    std::string text;
    for (const std::optional<Barrier>& barrier : sequence.barriers) {
        text += barrier ? "|." : ".";
    }
    return text;
}

}  // namespace

TEST_CASE("Hazards of any sequence of passes get barriers, and nothing else does") {
    std::mt19937 random(7);
    for (int i = 0; i < 2000; ++i) {
        Sequence sequence = follow(random_passes(random));
        REQUIRE(hazards_left(sequence) == 0);
        for (std::optional<Barrier>& barrier : sequence.barriers) {
            if (barrier) {
                const std::optional<Barrier> kept = std::exchange(barrier, std::nullopt);
                REQUIRE(hazards_left(sequence) > 0);
                barrier = kept;
            }
        }
    }
}

TEST_CASE("A read is waited for before what it reads is written over") {
    const Use read{Resource::wave_counts, Unit::indirect, Effect::read};
    const Use write{Resource::wave_counts, Unit::compute, Effect::write};
    const Sequence sequence = follow({{read}, {write}});
    REQUIRE(sequence.barriers[1]);
    CHECK(sequence.barriers[1]->before == bit(Unit::indirect));
    CHECK(sequence.barriers[1]->after == bit(Unit::compute));
}

TEST_CASE("Waves and frames have the barriers that they need, and no more") {
    const Use counts{Resource::wave_counts, Unit::indirect, Effect::read};
    const Pass clear = {{Resource::wave_counts, Unit::transfer, Effect::write}};
    const Pass rays = of_shader("wave_rays.rgen", {counts}), shadows = of_shader("wave_shadows.rgen", {counts});
    const Pass shade = of_shader("wave_shade.comp", {counts}), film = of_shader("wave_film.comp");
    // Counts are cleared beside what begins the paths; shadow rays go beside the others.
    CHECK(bars(follow({clear, of_shader("wave_begin.comp"), rays, shadows, shade, rays, shadows, shade, film})) ==
          "..|..|.|..|.|.");
    const Use listed{Resource::candidate_list, Unit::indirect, Effect::read};
    const Pass empty = {{Resource::candidate_list, Unit::transfer, Effect::write}};
    const Pass bsdf = of_shader("restir_bsdf_candidates.rgen", {listed});
    // Of a frame of restir each pass reads what the one before it wrote; the next frame's first hits wait for shading.
    CHECK(bars(follow({of_shader("restir_first_hits.rgen"), empty, of_shader("restir_candidates.comp"),
                       of_shader("restir_share_picked.rgen", {listed}), bsdf, bsdf, of_shader("restir_temporal.comp"),
                       of_shader("restir_spatial.comp"), of_shader("restir_shadows.rgen"),
                       of_shader("restir_shade.comp"), of_shader("restir_first_hits.rgen")})) ==
          "..|.|.|.|.|.|.|.|.|.");
}

}  // namespace diptych::core::tests
