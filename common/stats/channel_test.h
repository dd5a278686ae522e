// Do two sets of independent RGB means have one expectation? Welch's test in as many dimensions as the channels vary
// in.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace diptych::core {

using Channels = std::array<double, 3>;

enum class ChannelState {
    tested,
    equal,    // nothing varies, and the sides agree to rounding
    unequal,  // something does not vary, and the sides disagree there; or a value is not finite
};

/// A direction of colour whose difference has a standard error below `rounding` times the brightest mean does not vary:
/// what is left is the rounding of fp32, which is no two compilers' alike. There, sides are unequal beyond eight times
/// as much, if the runs are so many that so small an error is no accident (p of Student's t below 1e-9); else the
/// direction is tested like any other.
inline constexpr double channel_rounding = 1e-5;

/// Both sides' runs (a's first) in the directions in which they vary: centred, uncorrelated, in units of the
/// difference's standard error. Row-major, `rank` numbers a run. The test does not depend on these units; they keep its
/// matrices well conditioned.
struct ChannelRuns {
    ChannelState state = ChannelState::equal;
    int rank = 0;
    std::size_t count_a = 0;
    std::size_t count_b = 0;
    std::vector<double> values;
    std::vector<double> deviations;  // of the values from their side's mean
};

/// At least two runs a side.
ChannelRuns channel_runs(std::span<const Channels> a, std::span<const Channels> b);

/// p of T² = d' (S1/n1 + S2/n2)^-1 d under one expectation and any two covariances: F by the degrees of freedom of
/// Krishnamoorthy and Yu 2004 ("Modified Nel and Van der Merwe test for the multivariate Behrens-Fisher problem"). In
/// one dimension, as for a grey picture, that is Welch's two-sided t-test. 1 where the state is equal, 0 where it is
/// unequal.
double channel_p(const ChannelRuns& runs);

/// The same test of a draw without difference in the means: every run's deviation from the mean of its side, times
/// sign[i] (+1 or -1; a's first, as many of each kind on a side as can be). Each side keeps its own variance and tails.
/// For normal runs, p is uniform to the last degree of freedom: the deviations have lost one, so the test reckons with
/// one less. State tested, three runs a side or more.
double resampled_channel_p(const ChannelRuns& runs, std::span<const double> sign);

}  // namespace diptych::core
