#include "render/seeds.h"

#include <cassert>
#include <string>

#include "language/compat.h"
#include "error.h"

namespace diptych::core {
namespace {

constexpr std::uint32_t purpose_shift = 28;

/// The user's seed times 2^32 over the golden ratio, of which multiples are spread as evenly as can be.
std::uint32_t offset_of(std::uint32_t given) {
    return MUTANT(SEEDS_OF_COMMANDS_OVERLAP, given * 0x9e3779b9U, given << 4U) >> (32U - purpose_shift);
}

std::uint32_t upper_bits(SeedPurpose purpose) {
    if (MUTANT(SEEDS_OF_STAGES_SHARED, false, purpose == SeedPurpose::verify_again)) {
        purpose = SeedPurpose::verify;
    }
    if (MUTANT(SEEDS_OF_REFERENCE_SHARED, false, purpose == SeedPurpose::converge_reference)) {
        purpose = SeedPurpose::converge;
    }
    return static_cast<std::uint32_t>(purpose) << purpose_shift;
}

}  // namespace

SeedPlan::SeedPlan(std::uint32_t given, SeedPurpose purpose, std::uint32_t sides, std::uint32_t runs)
    : purpose_(purpose), offset_(offset_of(given)), sides_(sides), runs_(runs) {
    if (parts() == 0) {
        throw Error(std::to_string(sides) + " sides of " + std::to_string(runs) +
                    " runs want more seeds than there are (" + std::to_string(seeds_of_purpose) + ")");
    }
}

std::uint32_t SeedPlan::seed(std::uint32_t side, std::uint32_t run, std::uint64_t part) const {
    assert(side < sides_ && run < runs_);
    if (part >= parts()) {
        throw Error("chain or frame " + std::to_string(part + 1) + " of " + std::to_string(sides_) + " sides of " +
                    std::to_string(runs_) + " runs: there are seeds for " + std::to_string(parts()));
    }
    const std::uint64_t place =
        MUTANT(SEEDS_OF_PARTS_SHARED, part * part_step(), 0U) + MUTANT(SEEDS_OF_SIDES_SHARED, side, 0U) * runs_ + run;
    return upper_bits(purpose_) | static_cast<std::uint32_t>((offset_ + place) % seeds_of_purpose);
}

std::uint64_t SeedPlan::parts() const {
    return seeds_of_purpose / part_step();
}

std::uint64_t SeedPlan::part_step() const {
    return std::uint64_t{sides_} * runs_;
}

std::uint32_t neighbor_seed(std::uint32_t given, std::uint32_t place) {
    return given + MUTANT(SEEDS_OF_NEIGHBORS_SHARED, place, 0U);
}

}  // namespace diptych::core
