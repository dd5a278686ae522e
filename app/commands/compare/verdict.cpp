#include "commands/compare/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych::core::app {

namespace {

/// Of the pixels: where so many agree, those that do not are paths that rounding sent elsewhere.
constexpr double rounding_share = 0.99;

bool same_entry(const LayeredImage& a, const LayeredImage& b, const char* name) {
    const auto in_a = a.metadata.find(name);
    const auto in_b = b.metadata.find(name);
    return in_a != a.metadata.end() && in_b != b.metadata.end() && in_a->second == in_b->second;
}

/// Pixels and frames of restir reuse what others found, and their pictures say so.
bool is_correlated(const LayeredImage& image) {
    const auto correlated = image.metadata.find("correlated");
    return correlated != image.metadata.end() && correlated->second == "yes";
}

/// How far the means are apart, in percent, over the channel where that is most.
double mean_difference_percent(const Difference& difference) {
    double most = 0;
    for (const double ratio : difference.mean_ratio) {
        most = std::isfinite(ratio) ? std::max(most, std::abs(ratio - 1) * 100) : most;
    }
    return most;
}

}  // namespace

double largest_z(const Difference& difference) {
    double largest = 0;
    for (const double z : difference.z_mean) {
        if (std::isnan(z)) {
            return z;
        }
        largest = std::max(largest, std::abs(z));
    }
    return largest;
}

Verdict judge(const Difference& difference, const LayeredImage& a, const LayeredImage& b) {
    Verdict verdict;
    verdict.correlated = is_correlated(a) || is_correlated(b);
    verdict.same_random_numbers = same_entry(a, b, "seed") && same_entry(a, b, "sampler");
    const std::string apart = fmt::format("The means differ by at most {:.2g} %; {:.2f} % of the pixels agree to 0.1 %",
                                          mean_difference_percent(difference), 100 * difference.fraction_equal);
    const double z = largest_z(difference);
    if (difference.mse == 0 && difference.nonfinite == 0) {
        verdict.text = "The two pictures are identical.";
    } else if (verdict.same_random_numbers && difference.fraction_equal >= rounding_share) {
        verdict.text = apart + "; both used the same random numbers, and the remaining difference is rounding.";
    } else if (verdict.same_random_numbers) {
        verdict.text = apart + "; both used the same random numbers, so no test can tell whether that is noise.";
    } else if (verdict.correlated) {
        verdict.text = apart + "; the samples of restir are correlated, so only verify can tell whether that is noise.";
    } else if (std::isnan(z)) {
        verdict.text = apart + "; without standard errors, no test can tell whether that is noise.";
    } else {
        verdict.noise = z < noise_limit;
        verdict.text =
            fmt::format("{}; {} (largest |z| {:.2f}, the limit is {}).", apart,
                        *verdict.noise ? "that is within the noise" : "that is MORE than noise", z, noise_limit);
    }
    return verdict;
}

}  // namespace diptych::core::app
