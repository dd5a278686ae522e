// The same paths on two backends, from the same random numbers. Nearly all must decide alike and come to the same
// radiance; a few may part at a decision that hangs on a rounding, or drift apart where a chain of bounces magnifies
// one; those few must not lean to one side.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "path/path_record.h"

namespace diptych::core {

struct PairedLimits {
    double relative =
        1e-3;  // |a-b| <= relative max(|a|,|b|) + absolute, each channel, or paths that decided alike have drifted
    double absolute = 1e-6;
    double drifted = 1e-3;    // of the paths that decided alike
    double divergent = 1e-3;  // of the paths that come to a bounce, those that part there
    double p = 1e-4;          // a fraction fails where so many are less probable than this at the limit
    double z = 4;  // of the signed sum of the differences of paths that parted or drifted; p = 6e-5 a channel
};

/// Fewer paths than this could not tell a divergent fraction at the limit from none (95 %).
inline constexpr std::uint64_t least_paths = 3000;

enum class PairedVerdict { pass, fail, inconclusive };
const char* name_of(PairedVerdict verdict);

/// Paths that come to vertex n of both backends alike, and those that part there.
struct PairedBounce {
    std::uint64_t reached = 0;
    std::uint64_t parted = 0;
    double p = 1;  // of so many or more, were the fraction at the limit (Poisson)
};

/// A path worth replaying.
struct PairedExample {
    shared::PathQuery query{};
    std::uint32_t vertex = 0;  // where it parts; past its end where only its radiance differs
    double difference = 0;     // relative, of the radiance
};

struct PairedReport {
    std::uint64_t paths = 0;
    std::uint64_t alike = 0;      // every decision the same
    std::uint64_t drifted = 0;    // of those, radiance beyond the limit
    std::uint64_t nonfinite = 0;  // paths of which a radiance is not finite on one backend alone
    double worst_relative = 0;    // of those alike: |a-b| - absolute over the larger
    std::vector<PairedBounce> bounces;
    double drifted_p = 1;                     // of so many or more, were their share at the limit (Poisson)
    std::array<double, 3> divergent_sum{};    // of a - b over paths that parted or drifted
    std::array<double, 3> divergent_error{};  // its standard error, were the mean 0
    std::array<double, 3> divergent_z{};
    std::array<double, 3> total{};                // of (a + b) / 2 over all paths
    std::vector<PairedExample> drifted_examples;  // the worst first
    std::vector<PairedExample> parted_examples;   // the earliest first, then the worst
    PairedVerdict verdict = PairedVerdict::inconclusive;
    std::string reason;  // of a verdict other than pass
};

/// Takes paths in any number of portions.
class PairedTest {
public:
    explicit PairedTest(const PairedLimits& limits = {}) : limits_(limits) {}

    /// The three have one length. Returns for each path whether it parted or drifted: what a picture of them shows.
    std::vector<bool> add(std::span<const shared::PathQuery> queries, std::span<const shared::PathSummary> a,
                          std::span<const shared::PathSummary> b);

    PairedReport report() const;

private:
    bool add_one(const shared::PathQuery& query, const shared::PathSummary& a, const shared::PathSummary& b);

    PairedLimits limits_;
    PairedReport sums_;
    std::array<double, 3> squares_{};
};

/// The vertex before which all decisions are the same; none where all are. Bounces beyond the signature's length count
/// as its last.
std::uint32_t first_divergence(const shared::PathSummary& a, const shared::PathSummary& b);

}  // namespace diptych::core
