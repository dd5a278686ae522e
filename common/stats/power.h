// How small a difference a test can see.
#pragma once

namespace diptych::core {

/// Samples a side for a two-sided test at level `alpha` to find a relative difference `delta` of the means with
/// probability `power`, where a sample's standard deviation is `cv` times its mean: 2 (z_{1-alpha/2} + z_power)²
/// (cv/delta)². Normal approximation.
double samples_per_side(double alpha, double power, double cv, double delta);

/// The difference that a t-test at level `alpha` finds with probability `power`, given the difference's standard error
/// and its degrees of freedom: (t_{1-alpha/2} + t_power) se.
double minimum_detectable(double standard_error, double freedom, double alpha, double power);

}  // namespace diptych::core
