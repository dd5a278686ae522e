// Seeds of renders that have to be independent: no two of them are equal, by construction.
//
// A renderer takes 32 bits. The upper 4 say what a render is for, so that renders for different purposes never share a
// seed. The lower 28 are an offset by the user's seed plus the render's place among those of its purpose (mod 2^28).
// Renders of one command therefore have distinct seeds while their places are below 2^28; SeedPlan refuses greater
// ones. Offsets of two user's seeds below 2^10 are more than 2^16 apart, so such commands share no seed either while
// each renders at most 2^16 times for a purpose.
#pragma once

#include <cstdint>

namespace diptych::core {

/// The upper 4 bits of a seed. `given` is never derived: 0 is what seeds from the command line have there, as long as
/// they are below 2^28.
enum class SeedPurpose : std::uint32_t {
    given,
    verify,
    verify_again,  // the second stage
    converge,
    converge_picture,
    converge_reference,
    test,  // of this program's own tests
};

inline constexpr std::uint64_t seeds_of_purpose = 1U << 28U;

/// The seeds of one purpose, for sides with so many runs each. The runs of a part are consecutive, then come the sides,
/// then the parts: chains that a run plays, or frames that it renders apart. There may be as many parts as seeds last.
class SeedPlan {
public:
    SeedPlan(std::uint32_t given, SeedPurpose purpose, std::uint32_t sides, std::uint32_t runs);

    /// Throws Error for a part that is not below parts().
    std::uint32_t seed(std::uint32_t side, std::uint32_t run, std::uint64_t part = 0) const;

    /// Parts that there are seeds for.
    std::uint64_t parts() const;

    /// From a seed to that of the same side and run in the next part, mod 2^28.
    std::uint64_t part_step() const;

private:
    SeedPurpose purpose_;
    std::uint32_t offset_;
    std::uint32_t sides_;
    std::uint32_t runs_;
};

/// Frames of a sequence that `render` paints, or panels that a view shows side by side: neighbours of the seed that is
/// given, so that the first is the seed itself.
std::uint32_t neighbor_seed(std::uint32_t given, std::uint32_t place);

}  // namespace diptych::core
