#include "measure/path_agreement.h"

#include <algorithm>
#include <cmath>

namespace diptych::core {
namespace {

using shared::NONE;
using shared::PathSummary;

constexpr std::size_t most_examples = 5;

/// P(X >= count) of a Poisson variable.
double poisson_upper(std::uint64_t count, double mean) {
    if (count == 0) {
        return 1;
    }
    double sum = 0;
    double k = static_cast<double>(count);
    double term = std::exp(k * std::log(mean) - mean - std::lgamma(k + 1));
    if (mean > k) {  // terms would grow first: the complement is the shorter sum
        for (; k >= 1; --k) {
            term = std::exp((k - 1) * std::log(mean) - mean - std::lgamma(k));
            sum += term;
            if (term < 1e-18 * sum) {
                break;
            }
        }
        return std::max(1 - sum, 0.0);
    }
    for (; term > 1e-18 * sum; ++k) {
        sum += term;
        term *= mean / (k + 1);
    }
    return std::min(sum, 1.0);
}

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Keeps the list sorted and short.
template <class Before>
void keep_example(std::vector<PairedExample>& examples, const PairedExample& example, Before before) {
    examples.insert(std::upper_bound(examples.begin(), examples.end(), example, before), example);
    if (examples.size() > most_examples) {
        examples.pop_back();
    }
}

}  // namespace

const char* name_of(PairedVerdict verdict) {
    return verdict == PairedVerdict::pass ? "PASS" : verdict == PairedVerdict::fail ? "FAIL" : "INCONCLUSIVE";
}

std::uint32_t first_divergence(const PathSummary& a, const PathSummary& b) {
    const std::uint32_t longest = std::min(std::max(a.vertices, b.vertices), shared::SIGNATURE_VERTICES);
    for (std::uint32_t i = 0; i < longest; ++i) {
        if (a.signature[i] != b.signature[i]) {
            return i;
        }
    }
    return a.vertices == b.vertices ? NONE : longest - 1;
}

bool PairedTest::add_one(const shared::PathQuery& query, const PathSummary& a, const PathSummary& b) {
    ++sums_.paths;
    const std::uint32_t parts_at = first_divergence(a, b);
    const std::uint32_t longest = std::min(std::max(a.vertices, b.vertices), shared::SIGNATURE_VERTICES);
    if (sums_.bounces.size() < longest) {
        sums_.bounces.resize(longest);
    }
    for (std::uint32_t i = 0; i < longest && i <= parts_at; ++i) {
        ++sums_.bounces[i].reached;
        sums_.bounces[i].parted += i == parts_at ? 1 : 0;
    }
    if (!finite(a.radiance) || !finite(b.radiance)) {
        const bool both = !finite(a.radiance) && !finite(b.radiance);
        sums_.nonfinite += both ? 0 : 1;
        return !both;
    }
    double relative = 0;
    bool within = true;
    for (int c = 0; c < 3; ++c) {
        const double x = static_cast<double>(a.radiance[c]);
        const double y = static_cast<double>(b.radiance[c]);
        const double larger = std::max(std::abs(x), std::abs(y));
        within = within && std::abs(x - y) <= limits_.relative * larger + limits_.absolute;
        relative = std::max(relative, larger > 0 ? std::max(std::abs(x - y) - limits_.absolute, 0.0) / larger : 0.0);
        sums_.total[static_cast<std::size_t>(c)] += 0.5 * (x + y);
    }
    for (int c = 0; c < 3 && (parts_at != NONE || !within); ++c) {
        const double difference = static_cast<double>(a.radiance[c]) - static_cast<double>(b.radiance[c]);
        sums_.divergent_sum[static_cast<std::size_t>(c)] += difference;
        squares_[static_cast<std::size_t>(c)] += difference * difference;
    }
    if (parts_at != NONE) {
        keep_example(sums_.parted_examples, {query, parts_at, relative}, [](const auto& p, const auto& q) {
            return p.vertex != q.vertex ? p.vertex < q.vertex : p.difference > q.difference;
        });
        return true;
    }
    ++sums_.alike;
    sums_.worst_relative = std::max(sums_.worst_relative, relative);
    if (!within) {
        ++sums_.drifted;
        keep_example(sums_.drifted_examples, {query, a.vertices, relative},
                     [](const auto& p, const auto& q) { return p.difference > q.difference; });
    }
    return !within;
}

std::vector<bool> PairedTest::add(std::span<const shared::PathQuery> queries, std::span<const PathSummary> a,
                                  std::span<const PathSummary> b) {
    std::vector<bool> differs(queries.size());
    for (std::size_t i = 0; i < queries.size(); ++i) {
        differs[i] = add_one(queries[i], a[i], b[i]);
    }
    return differs;
}

PairedReport PairedTest::report() const {
    PairedReport report = sums_;
    const auto fail = [&](const std::string& reason) {
        report.verdict = PairedVerdict::fail;
        report.reason += (report.reason.empty() ? "" : "; ") + reason;
    };
    report.verdict = PairedVerdict::pass;
    report.drifted_p = poisson_upper(report.drifted, limits_.drifted * static_cast<double>(report.alike));
    if (report.drifted_p < limits_.p) {
        fail("too many paths that decided alike differ");
    }
    if (report.nonfinite > 0) {
        fail("samples are finite on one backend alone");
    }
    for (std::size_t i = 0; i < report.bounces.size(); ++i) {
        PairedBounce& bounce = report.bounces[i];
        bounce.p = poisson_upper(bounce.parted, limits_.divergent * static_cast<double>(bounce.reached));
        if (bounce.p < limits_.p) {
            fail("too many paths part at vertex " + std::to_string(i));
        }
    }
    for (std::size_t c = 0; c < 3; ++c) {
        // Rounding of sums is no lean.
        report.divergent_error[c] = std::sqrt(squares_[c]);
        const double floor = 1e-9 * std::abs(report.total[c]);
        const double error = std::hypot(report.divergent_error[c], floor);
        report.divergent_z[c] = error > 0 ? report.divergent_sum[c] / error : 0;
    }
    const double z =
        std::max({std::abs(report.divergent_z[0]), std::abs(report.divergent_z[1]), std::abs(report.divergent_z[2])});
    if (z > limits_.z) {
        fail("paths that differ lean to one side");
    }
    if (report.verdict == PairedVerdict::pass && report.paths < least_paths) {
        report.verdict = PairedVerdict::inconclusive;
        report.reason = "too few paths to know how many part";
    }
    return report;
}

}  // namespace diptych::core
