// Films, reservoirs, light tables, and the ends of random numbers.
#include <algorithm>

#include "case_parts.h"
#include "pack/alias_table_build.h"
#include "render/film_statistics.h"
#include "render/merge_films.h"

namespace diptych::core::stability {

namespace {

using shared::uint;

/// Sums of measured_sample over the first `count`, in double.
dvec3 true_sum(float value, std::uint64_t count) {
    dvec3 sum(0);
    for (std::uint64_t i = 0; i < count; ++i) {
        sum += dvec3(shared::measured_sample(value, static_cast<uint>(i)));
    }
    return sum;
}

Film film_of(const MeasuredOutput& o) {
    Film film;
    film.width = film.height = 1;
    film.pixels.resize(1);
    shared::ExactSum& sum = film.pixels[0].sum;
    for (int k = 0; k < 3; ++k) {
        sum.low[k].x = o.n[2 * k];
        sum.high[k].x = o.n[2 * k + 1];
    }
    sum.base = o.n[6];
    film.pixels[0].samples = o.n[7];
    return film;
}

Measured measure_film(Backend& backend, double samples, Effort) {
    const auto count = static_cast<std::uint64_t>(std::llround(samples));
    constexpr float value = 0.1F;
    const dvec3 truth = true_sum(value, count);
    const char* const names[] = {"constant 0.1", "random", "fireflies of 1e6"};
    Measured m;
    m.evaluations = 3 * count;
    for (uint component = 0; component < 3; ++component) {
        // In portions, so that no device is held for long; their films are merged.
        std::vector<MeasuredInput> portions;
        for (std::uint64_t done = 0; done < count; done += 1U << 18U) {
            MeasuredInput p{};
            p.x[0] = value;
            p.n[0] = static_cast<uint>(done);
            p.n[1] = static_cast<uint>(std::min<std::uint64_t>(count - done, 1U << 18U));
            p.n[2] = component;
            portions.push_back(p);
        }
        Film whole = film_of({});
        for (const MeasuredOutput& o : backend.run(Function::film, portions)) {
            merge_films(film_of(o), whole);
            m.nonfinite += static_cast<std::uint64_t>(o.y[0]);
        }
        worsen(m, relative_error(rounded(whole.pixels[0].sum)[0], truth[static_cast<int>(component)]), names[component]);
    }
    return m;
}

/// Equal weights, of which `candidates` have come by but for the last few, which are measured.
Measured measure_equal_weights(Backend& backend, double candidates, Effort) {
    constexpr uint last = 1U << 14U;
    MeasuredInput p{};
    std::fill_n(p.x, 8, 1.0F);
    const double before = std::max(candidates - last, 0.0);
    p.x[8] = static_cast<float>(before);
    p.n[0] = last;
    p.n[1] = 11;
    const MeasuredOutput o = backend.run(Function::reservoir, {&p, 1}).front();
    Measured m;
    m.evaluations = last;
    worsen(m, relative_error(double{o.y[1]} + double{o.y[2]} - double{p.x[8]}, last), "");
    return m;
}

/// Weights 1 to 4, times `scale`, among others that count for nothing.
Measured measure_odds(Backend& backend, double scale, Effort effort) {
    std::vector<MeasuredInput> inputs(effort == Effort::quick ? 1U << 15U : 1U << 19U);
    const float s = static_cast<float>(scale);
    const float weights[8] = {0, s, 2 * s, 1e-42F, 3 * s, INFINITY, 4 * s, NAN};
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        std::copy_n(weights, 8, inputs[i].x);
        inputs[i].n[0] = 8;
        inputs[i].n[1] = static_cast<uint>(i);
    }
    Measured m;
    m.evaluations = inputs.size();
    double picks[9] = {};
    for (const MeasuredOutput& o : backend.run(Function::reservoir, inputs)) {
        picks[std::min(o.n[0], 8U)] += 1;
        worsen(m, relative_error(double{o.y[0]}, 10.0 / 8 * double{s}) > 1e-6 ? NAN : 0, "W");
    }
    const double shares[9] = {0, 0.1, 0.2, 0, 0.3, 0, 0.4, 0, 0};
    for (std::size_t k = 0; k < 9; ++k) {
        const double n = static_cast<double>(inputs.size());
        const double sigma = std::sqrt(std::max(shares[k] * (1 - shares[k]), 1e-12) / n);
        worsen(m, std::abs(picks[k] / n - shares[k]) / sigma, fmt::format("candidate {}", k));
    }
    return m;
}

/// Two lights of so different powers, by the table that scenes get: how often each is picked.
Measured measure_light_table(Backend& backend, double ratio, Effort effort) {
    const double powers[] = {1 / std::sqrt(ratio), std::sqrt(ratio)};
    const std::vector<double> pmf = pick_probabilities(powers, 0.05);
    const std::vector<shared::AliasEntry> table = build_alias_table(pmf);
    std::vector<MeasuredInput> inputs(effort == Effort::quick ? 1U << 16U : 1U << 20U);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        MeasuredInput& p = inputs[i];
        p.n[0] = table[0].alias | (table[1].alias << 4U);
        p.n[1] = 2;
        p.n[2] = shared::hash_word(static_cast<uint>(2 * i));
        p.n[3] = shared::hash_word(static_cast<uint>(2 * i + 1));
        p.x[0] = table[0].probability;
        p.x[1] = table[1].probability;
    }
    double dim = 0;
    Measured m;
    for (const MeasuredOutput& o : backend.run(Function::alias, inputs)) {
        dim += o.n[0] == 0 ? 1 : 0;
        worsen(m, o.n[0] < 2 ? 0.0 : NAN, "no such light");
    }
    const double n = static_cast<double>(inputs.size());
    m.evaluations = inputs.size();
    worsen(m, std::abs(dim / n - pmf[0]) / std::sqrt(pmf[0] * (1 - pmf[0]) / n), fmt::format("share {:.4f}", dim / n));
    return m;
}

Measured measure_mis(Backend& backend, double pdf, Effort effort) {
    Uniforms u(9);
    std::vector<MeasuredInput> inputs(effort == Effort::quick ? 256 : 4096);
    for (MeasuredInput& p : inputs) {
        p.x[0] = static_cast<float>(pdf);
        p.x[1] = static_cast<float>(std::pow(10.0, 74 * u.next() - 37));
        p.n[0] = u.next() < 0.5 ? shared::MIS_POWER : shared::MIS_BALANCE;
    }
    const std::vector<MeasuredOutput> outputs = backend.run(Function::mis, inputs);
    Measured m;
    m.evaluations = inputs.size();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const double ratio = double{inputs[i].x[1]} / double{inputs[i].x[0]};
        const double truth = 1 / (1 + (inputs[i].n[0] == shared::MIS_POWER ? ratio * ratio : ratio));
        worsen(m, std::abs(double{outputs[i].y[0]} - truth), fmt::format("other pdf {:.3g}", inputs[i].x[1]));
    }
    return m;
}

/// Words at which the 24 bits that count are all 0, the first, the last, and in the middle.
constexpr uint words[] = {0U, 0xffU, 0x100U, 0x7fffffffU, 0x80000000U, 0xfffffeffU, 0xffffff00U, 0xffffffffU};

Measured measure_unit_float(Backend& backend, Effort) {
    std::vector<MeasuredInput> inputs(std::size(words));
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        inputs[i].n[0] = words[i];
    }
    const std::vector<MeasuredOutput> outputs = backend.run(Function::unit_float, inputs);
    Measured m;
    m.evaluations = inputs.size();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const double y = double{outputs[i].y[0]};
        const bool inside = y >= 0 && y < 1;
        worsen(m, inside ? std::abs(y - static_cast<double>(words[i] >> 8U) * 0x1p-24) : 1.0,
               fmt::format("word {:#x}", words[i]));
    }
    return m;
}

constexpr const char* samplers[] = {"disk",
                                    "cosine hemisphere",
                                    "uniform hemisphere",
                                    "sphere",
                                    "triangle",
                                    "spherical triangle",
                                    "GGX normal",
                                    "Blinn-Phong normal",
                                    "GGX surface",
                                    "Blinn-Phong surface",
                                    "alias table",
                                    "alias table, empty column",
                                    "numbers below 1",
                                    "reservoir, first",
                                    "reservoir, weight 0"};

Measured measure_ends(Backend& backend, double alpha, Effort) {
    std::vector<MeasuredInput> inputs;
    for (const uint x : words) {
        for (const uint y : words) {
            for (const uint lobe : words) {
                for (const double cosine : {1e-6, 0.1, 1.0}) {
                    MeasuredInput p{};
                    p.x[0] = static_cast<float>(alpha);
                    take_vec3(p, 1, direction(cosine, 0.6));
                    p.n[0] = x;
                    p.n[1] = y;
                    p.n[2] = lobe;
                    inputs.push_back(p);
                }
            }
        }
    }
    const std::vector<MeasuredOutput> outputs = backend.run(Function::ends_of_u, inputs);
    Measured m;
    m.evaluations = inputs.size() * std::size(samplers);
    std::uint32_t faults = 0;
    for (const MeasuredOutput& o : outputs) {
        faults |= o.n[0];
        m.error += o.n[0] != 0 ? 1 : 0;
    }
    for (std::size_t k = 0; k < std::size(samplers); ++k) {
        m.where += (faults >> k & 1U) != 0 ? (m.where.empty() ? "" : ", ") + std::string(samplers[k]) : "";
    }
    return m;
}

}  // namespace

void add_sum_cases(std::vector<Case>& cases) {
    cases.push_back({"light range",
                     "odds of a dim light beside a bright one",
                     {"ratio of powers", 1, 1e24, true, 3, 13},
                     4.5,
                     "standard errors",
                     measure_light_table});
    cases.push_back({"light range",
                     "MIS weights of any two densities",
                     {"pdf", 1e-37, 1e37, true, 5, 38},
                     1e-6,
                     "absolute",
                     measure_mis});
    cases.push_back({"reservoirs",
                     "odds among weights of 0, a denormal, infinity, NaN",
                     {"scale of the weights", 1e-30, 1e30, true, 5, 31},
                     5,
                     "standard errors",
                     measure_odds});
    cases.push_back({"reservoirs",
                     "sum of equal weights",
                     {"candidates", 16384, 33554432, true, 12, 12},
                     1e-6,
                     "relative",
                     measure_equal_weights});
    cases.push_back({"accumulation",
                     "sums of a pixel against double precision",
                     {"samples", 4096, 67108864, true, 2, 8, 1048576},
                     1e-6,
                     "relative",
                     measure_film});
    cases.push_back(
        {"ends of u", "numbers are multiples of 2^-24 below 1", {""}, 0, "absolute", [](Backend& b, double, Effort e) {
             return measure_unit_float(b, e);
         }});
    cases.push_back(
        {"ends of u", "every sampler at both ends", {"alpha", 1e-4, 1, true, 3, 9}, 0, "count", measure_ends});
}

}  // namespace diptych::core::stability
