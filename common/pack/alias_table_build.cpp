#include "pack/alias_table_build.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace diptych::core {

std::vector<double> pick_probabilities(std::span<const double> weights, double defensive) {
    const auto usable = [](double w) { return w > 0 ? std::min(w, 1e300) : 0.0; };
    double largest = 0;
    for (const double w : weights) {
        largest = std::max(largest, usable(w));
    }
    std::vector<double> probabilities(weights.size(), 0.0);
    if (!(largest > 0)) {
        return probabilities;
    }
    double sum = 0;
    double positive = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        // A light too dim for the quotient still counts as one that can be picked.
        probabilities[i] = usable(weights[i]) > 0 ? std::max(usable(weights[i]) / largest, 1e-300) : 0.0;
        sum += probabilities[i];
        positive += probabilities[i] > 0 ? 1 : 0;
    }
    for (double& p : probabilities) {
        p = p > 0 ? (1 - defensive) * p / sum + defensive / positive : 0.0;
    }
    return probabilities;
}

std::vector<shared::AliasEntry> build_alias_table(std::span<const double> probabilities) {
    const std::size_t n = probabilities.size();
    std::vector<shared::AliasEntry> table(n);
    std::vector<double> scaled(n);
    std::vector<std::uint32_t> small;
    std::vector<std::uint32_t> large;
    for (std::size_t i = 0; i < n; ++i) {
        scaled[i] = probabilities[i] * static_cast<double>(n);
        (scaled[i] < 1 ? small : large).push_back(static_cast<std::uint32_t>(i));
    }
    while (!small.empty() && !large.empty()) {
        const std::uint32_t s = small.back();
        const std::uint32_t l = large.back();
        small.pop_back();
        table[s] = {static_cast<float>(scaled[s]), l};
        scaled[l] -= MUTANT(ALIAS_REMAINDER, 1 - scaled[s], 0.0);
        if (scaled[l] < 1) {
            large.pop_back();
            small.push_back(l);
        }
    }
    // What is left differs from 1 by rounding alone, unless it has no probability at all.
    const auto keep = [&](std::uint32_t i) { table[i] = {1.0F, i}; };
    std::for_each(large.begin(), large.end(), keep);
    const auto most = std::max_element(probabilities.begin(), probabilities.end());
    for (const std::uint32_t i : small) {
        if (probabilities[i] > 0) {
            keep(i);
        } else {
            table[i] = {0.0F, static_cast<std::uint32_t>(most - probabilities.begin())};
        }
    }
    return table;
}

}  // namespace diptych::core
