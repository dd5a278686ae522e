// GGX's D, visible normals, grazing angles, Blinn-Phong.

#include "case_parts.h"
#include "references.h"

namespace diptych::core::stability {

namespace {

constexpr double cosines[] = {1.0, 0.7, 0.3, 0.1, 0.01};

int samples_of(Effort effort) {
    return effort == Effort::quick ? 512 : 8192;
}

/// A facet whose slope is some multiple of alpha, so that peak and tail are both met.
dvec3 facet(double alpha, double multiple, double azimuth) {
    const double slope = alpha * multiple;
    const double c = 1 / std::sqrt(1 + slope * slope);
    return {slope * c * std::cos(azimuth), slope * c * std::sin(azimuth), c};
}

Measured measure_distribution(Backend& backend, Function function, double alpha, double widest, Effort effort,
                              double (*truth)(const dvec3&, double)) {
    Uniforms u(1);
    std::vector<MeasuredInput> inputs(static_cast<std::size_t>(samples_of(effort)));
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const double multiple = i == 0 ? 0 : widest * std::pow(u.next(), 3);
        take_vec3(inputs[i], 0, facet(alpha, multiple, 2 * pi * u.next()));
        inputs[i].x[3] = static_cast<float>(alpha);
    }
    const std::vector<MeasuredOutput> outputs = backend.run(function, inputs);
    Measured m;
    m.evaluations = inputs.size();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const dvec3 h = given_vec3(inputs[i], 0);
        const double expected = truth(h, double{inputs[i].x[3]});
        worsen(m, relative_error(double{outputs[i].y[0]}, expected),
               fmt::format("slope {:.3g} alpha", std::sqrt(h.x * h.x + h.y * h.y) / (h.z * alpha)));
    }
    return m;
}

Measured measure_blinn_phong(Backend& backend, double exponent, Effort effort) {
    // As far out as D falls to e^-10 of its peak.
    const double alpha = std::sqrt(2 / (exponent + 2));
    const double tan2 = std::expm1(20 / std::max(exponent, 1e-3));
    const double widest = std::min(std::sqrt(tan2) / alpha, 50.0);
    return measure_distribution(backend, Function::blinn_phong_d, alpha, widest, effort, blinn_phong_distribution);
}

/// The integral of D cos over facets: the device's values at points that the host spreads.
Measured measure_blinn_phong_integral(Backend& backend, double exponent, Effort) {
    constexpr int points = 4096;
    const double alpha = std::sqrt(2 / (exponent + 2));
    std::vector<MeasuredInput> inputs(points);
    std::vector<double> weights(points);
    for (int i = 0; i < points; ++i) {
        const double v = 1 - (i + 0.5) / points;
        const double tan2 = alpha * alpha * (1 / (v * v) - 1);
        const dvec3 h = facet(1, std::sqrt(tan2), 0.4);
        take_vec3(inputs[static_cast<std::size_t>(i)], 0, h);
        inputs[static_cast<std::size_t>(i)].x[3] = static_cast<float>(alpha);
        weights[static_cast<std::size_t>(i)] = 2 * pi * std::pow(h.z, 4) * alpha * alpha / (v * v * v) / points;
    }
    const std::vector<MeasuredOutput> outputs = backend.run(Function::blinn_phong_d, inputs);
    double sum = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        sum += weights[i] * double{outputs[i].y[0]};
    }
    Measured m;
    m.evaluations = inputs.size();
    worsen(m, std::abs(sum - 1), fmt::format("integral {:.6f}", sum));
    return m;
}

/// Inputs of measure_reflect over a grid of the unit square.
std::vector<MeasuredInput> reflections(double cosine, double alpha, std::uint32_t model, int side) {
    std::vector<MeasuredInput> inputs;
    for (int i = 0; i < side * side; ++i) {
        MeasuredInput p{};
        take_vec3(p, 0, direction(cosine, 0.6));
        p.x[3] = static_cast<float>(alpha);
        p.x[4] = static_cast<float>((i % side + 0.5) / side);
        p.x[5] = static_cast<float>((i / side + 0.5) / side);
        p.n[0] = model;
        inputs.push_back(p);
    }
    return inputs;
}

/// The mean of sampled weights against the quadrature of the reflection.
Measured measure_ggx_albedo(Backend& backend, double alpha, Effort effort) {
    const int side = effort == Effort::quick ? 128 : 512;
    Measured m;
    for (const double cosine : cosines) {
        double sum = 0;
        for (const MeasuredOutput& o :
             backend.run(Function::reflect, reflections(cosine, alpha, shared::BRDF_GGX, side))) {
            sum += o.n[0] != 0 ? double{o.y[6]} / double{o.y[7]} : 0;
        }
        m.evaluations += static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side);
        worsen(m, std::abs(sum / (side * side) - ggx_albedo(cosine, alpha)), fmt::format("cos {:g}", cosine));
    }
    return m;
}

/// Facets and directions are unit vectors, the pdf is a positive number, and nothing weighs more than 1.
Measured measure_reflections(Backend& backend, double cosine, Effort effort, bool weigh) {
    const int side = effort == Effort::quick ? 16 : 64;
    Measured m;
    for (const double alpha : {1e-4, 1e-3, 1e-2, 0.1, 0.5, 1.0}) {
        const auto inputs = reflections(cosine, alpha, shared::BRDF_GGX, side);
        const auto outputs = backend.run(Function::reflect, inputs);
        for (std::size_t i = 0; i < outputs.size(); ++i) {
            const MeasuredOutput& o = outputs[i];
            const std::string where = fmt::format("alpha {:g}, u {:.3f} {:.3f}", alpha, inputs[i].x[4], inputs[i].x[5]);
            if (!weigh) {
                worsen(m, std::abs(length(result_vec3(o, 0)) - 1), where);
                worsen(m, std::abs(length(result_vec3(o, 3)) - 1), where);
            } else if (o.n[0] != 0) {
                const double weight = double{o.y[6]} / double{o.y[7]};
                worsen(m, o.y[7] > 0 ? std::max(weight - 1, 0.0) : NAN, where);
            }
            ++m.evaluations;
        }
    }
    return m;
}

Measured measure_masking(Backend& backend, double cosine, Effort effort) {
    Uniforms u(2);
    std::vector<MeasuredInput> inputs(static_cast<std::size_t>(samples_of(effort)));
    for (MeasuredInput& p : inputs) {
        take_vec3(p, 0, direction(cosine, 2 * pi * u.next()));
        take_vec3(p, 3, direction(std::pow(10.0, -7 * u.next()), 2 * pi * u.next()));
        p.x[6] = static_cast<float>(std::pow(10.0, -4 * u.next()));
    }
    const std::vector<MeasuredOutput> outputs = backend.run(Function::ggx_masking, inputs);
    Measured m;
    m.evaluations = inputs.size();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const dvec3 o = given_vec3(inputs[i], 0);
        const dvec3 w = given_vec3(inputs[i], 3);
        const double alpha = double{inputs[i].x[6]};
        const double g1 = ggx_masking(o, alpha);
        const double g2 = ggx_masking_shadowing(o, w, alpha);
        const std::string where = fmt::format("alpha {:.3g}, other cos {:.3g}", alpha, w.z);
        worsen(m, relative_error(double{outputs[i].y[0]}, g1), where);
        worsen(m, relative_error(double{outputs[i].y[1]}, g2), where);
        worsen(m, relative_error(double{outputs[i].y[2]}, g2 / g1), where);
    }
    return m;
}

/// What fp32 leaves of a narrow lobe: directions are rounded by 2^-24, and the lobe turns that into 1/alpha times as
/// much.
Measured measure_narrow_lobe(Backend& backend, double alpha, Effort effort) {
    Uniforms u(3);
    std::vector<MeasuredInput> inputs(static_cast<std::size_t>(samples_of(effort)));
    for (MeasuredInput& p : inputs) {
        const dvec3 o = direction(0.1 + 0.9 * u.next(), 2 * pi * u.next());
        const dvec3 h = facet(alpha, 4 * u.next(), 2 * pi * u.next());
        dvec3 i = 2 * dot(o, h) * h - o;
        if (i.z < 0.05) {
            i = {-o.x, -o.y, o.z};
        }
        take_vec3(p, 0, o);
        take_vec3(p, 3, normalize(i));
        p.x[6] = static_cast<float>(std::sqrt(alpha));
        p.x[7] = 1;
        p.n[0] = shared::BRDF_GGX;
    }
    const std::vector<MeasuredOutput> outputs = backend.run(Function::bsdf_eval, inputs);
    Measured m;
    m.evaluations = inputs.size();
    for (std::size_t k = 0; k < inputs.size(); ++k) {
        const dvec3 o = given_vec3(inputs[k], 0);
        const dvec3 i = given_vec3(inputs[k], 3);
        const double a = double{inputs[k].x[6]} * double{inputs[k].x[6]};
        const dvec3 h = normalize(o + i);
        const double truth = ggx_distribution(h, a) * ggx_masking_shadowing(o, i, a) / (4 * o.z);
        worsen(m, relative_error(double{outputs[k].y[0]}, truth) * alpha, fmt::format("cos {:.3f} {:.3f}", o.z, i.z));
    }
    return m;
}

/// A metal's weights and directions on both sides of the least roughness that still spreads light.
Measured measure_switch(Backend& backend, double roughness, Effort effort) {
    const int side = effort == Effort::quick ? 32 : 128;
    Measured m;
    for (const double cosine : {1.0, 0.5, 0.1}) {
        std::vector<MeasuredInput> inputs;
        for (int i = 0; i < side * side; ++i) {
            MeasuredInput p{};
            take_vec3(p, 0, direction(cosine, 0.6));
            p.x[3] = static_cast<float>(roughness);
            p.x[4] = 1;
            p.x[6] = static_cast<float>((i % side + 0.5) / side);
            p.x[7] = static_cast<float>((i / side + 0.5) / side);
            inputs.push_back(p);
        }
        const dvec3 o = given_vec3(inputs[0], 0);
        double weights = 0;
        double astray = 0;
        for (const MeasuredOutput& r : backend.run(Function::bsdf_sample, inputs)) {
            weights += double{r.y[3]};
            astray += length(result_vec3(r, 0) - dvec3(-o.x, -o.y, o.z)) > 0.05 ? 1 : 0;
        }
        const double n = static_cast<double>(inputs.size());
        m.evaluations += inputs.size();
        worsen(m, std::max(std::abs(weights / n - 1), astray / n), fmt::format("cos {:g}", cosine));
    }
    return m;
}

/// weight = value / pdf, by three functions that must agree.
Measured measure_triple(Backend& backend, double cosine, Effort effort) {
    Uniforms u(4);
    std::vector<MeasuredInput> inputs(static_cast<std::size_t>(samples_of(effort)));
    for (MeasuredInput& p : inputs) {
        take_vec3(p, 0, direction(cosine, 2 * pi * u.next()));
        p.x[3] = static_cast<float>(0.01 + 0.99 * u.next());
        p.x[4] = u.next() < 0.5 ? 0.0F : 1.0F;
        for (std::size_t k = 5; k < 8; ++k) {
            p.x[k] = static_cast<float>(u.next());
        }
        p.n[0] = u.next() < 0.5 ? shared::BRDF_GGX : shared::BRDF_BLINN_PHONG;
    }
    const std::vector<MeasuredOutput> outputs = backend.run(Function::bsdf_sample, inputs);
    Measured m;
    m.evaluations = inputs.size();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const MeasuredOutput& o = outputs[i];
        const std::string where = fmt::format("roughness {:.3f}, {}", inputs[i].x[3],
                                              inputs[i].n[0] == shared::BRDF_GGX ? "ggx" : "blinn-phong");
        worsen(m, std::isfinite(o.y[3]) && o.y[3] >= 0 ? 0.0 : NAN, where);
        if (o.y[4] > 0 && o.n[0] == 0) {
            worsen(m, relative_error(double{o.y[3]} * double{o.y[4]}, double{o.y[5]}, 1e-30), where);
            worsen(m, relative_error(double{o.y[6]}, double{o.y[4]}), where);
        }
    }
    return m;
}

}  // namespace

void add_microfacet_cases(std::vector<Case>& cases) {
    const Range alphas{"alpha", 1e-4, 1, true, 5, 33};
    const Range grazing{"cos", 1e-7, 1, true, 5, 29};
    cases.push_back(
        {"GGX D", "D against double precision", alphas, 1.5e-6, "relative", [](Backend& b, double alpha, Effort e) {
             return measure_distribution(b, Function::ggx_d, alpha, 20, e, ggx_distribution);
         }});
    cases.push_back({"GGX D",
                     "reflection of given directions",
                     {"alpha", 1e-4, 1, true, 3, 33},
                     1e-6,
                     "relative, times alpha",
                     measure_narrow_lobe});
    cases.push_back({"GGX D",
                     "a metal across the switch to a perfect mirror",
                     {"roughness", 0.0098, 0.0102, false, 3, 9},
                     2e-3,
                     "absolute",
                     measure_switch});
    cases.push_back({"VNDF",
                     "mean of sampled weights against quadrature",
                     {"alpha", 1e-4, 1, true, 3, 17},
                     2e-3,
                     "absolute",
                     measure_ggx_albedo});
    cases.push_back({"VNDF", "facets and directions are unit vectors", grazing, 1e-6, "absolute",
                     [](Backend& b, double c, Effort e) { return measure_reflections(b, c, e, false); }});
    cases.push_back({"grazing", "masking against double precision", grazing, 2e-6, "relative", measure_masking});
    cases.push_back({"grazing", "no weight above 1", grazing, 2e-5, "absolute",
                     [](Backend& b, double c, Effort e) { return measure_reflections(b, c, e, true); }});
    cases.push_back({"grazing", "sample, eval and pdf agree", grazing, 1e-5, "relative", measure_triple});
    const Range exponents{"exponent", 1e-2, 2e8, true, 6, 41};
    cases.push_back({"Blinn-Phong", "D against double precision", exponents, 1e-5, "relative", measure_blinn_phong});
    cases.push_back({"Blinn-Phong",
                     "the integral of D cos is 1",
                     {"exponent", 1e-2, 1e6, true, 4, 25},
                     2e-4,
                     "absolute",
                     measure_blinn_phong_integral});
}

}  // namespace diptych::core::stability
