// Shading normals and normal maps.

#include "case_parts.h"
#include "references.h"

namespace diptych::core::stability {

namespace {

MeasuredInput mapped_input(const dvec3& o, const dvec3& smooth, const dvec3& mapped, double roughness,
                           double metallic) {
    MeasuredInput p{};
    take_vec3(p, 0, o);
    take_vec3(p, 3, smooth);
    take_vec3(p, 6, mapped);
    p.x[9] = static_cast<float>(roughness);
    p.x[10] = static_cast<float>(metallic);
    return p;
}

/// What of a difference counts between two looks at one direction, one before and one after its components were rounded
/// by 2^-24: a cosine c is then known to 2^-23 / c, which passes the bound of 1e-4 below c = 1e-3.
double known_share(double cosine) {
    constexpr double least = 1e-3;
    return std::abs(cosine) / (std::abs(cosine) + least);
}

/// Interpolated normals tilted so far: nothing may leave through the triangle, and sample, eval and pdf must agree.
Measured measure_interpolated(Backend& backend, double degrees, Effort effort, std::uint32_t map) {
    Uniforms u(12);
    std::vector<MeasuredInput> inputs(effort == Effort::quick ? 1024 : 16384);
    const double tilt = degrees / 180 * pi;
    for (MeasuredInput& p : inputs) {
        const dvec3 normal = direction(std::cos(tilt), 2 * pi * u.next());
        const dvec3 o = direction(std::pow(10.0, -6 * u.next()), 2 * pi * u.next());
        const dvec3 smooth = map != shared::NORMAL_MAP_NONE ? dvec3(0, 0, 1) : normal;
        p = mapped_input(o, smooth, normal, 0.3 + 0.7 * u.next(), u.next() < 0.5 ? -1 : 1);
        p.n[0] = map;
        for (std::size_t k = 11; k < 15; ++k) {
            p.x[k] = static_cast<float>(u.next());
        }
    }
    const std::vector<MeasuredOutput> outputs = backend.run(Function::mapped_surface, inputs);
    Measured m;
    m.evaluations = inputs.size();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const MeasuredOutput& o = outputs[i];
        const std::string where = fmt::format("view cos {:.3g}, roughness {:.3f}", inputs[i].x[2], inputs[i].x[9]);
        const double cosine = double{o.y[0]} * double{inputs[i].x[3]} + double{o.y[1]} * double{inputs[i].x[4]} +
                              double{o.y[2]} * double{inputs[i].x[5]};
        const double share = map != shared::NORMAL_MAP_NONE ? 1 : known_share(cosine);
        worsen(m, std::isfinite(o.y[3]) && o.y[3] >= 0 && o.y[4] >= 0 ? 0.0 : NAN, where);
        if (o.y[4] > 0 && o.n[0] == 0) {
            worsen(m, o.y[2] > 0 ? 0.0 : 1.0, "below the triangle");
            worsen(m, share * relative_error(double{o.y[3]} * double{o.y[4]}, double{o.y[5]}, 1e-30), where);
            worsen(m, share * relative_error(double{o.y[6]}, double{o.y[4]}), where);
        }
    }
    return m;
}

/// One surface under a tilted map, drawn from so often.
std::vector<MeasuredInput> mapped_draws(double view, double azimuth, const dvec3& facet, double roughness, double metallic,
                                        std::uint32_t map, int side) {
    Uniforms u(13);
    std::vector<MeasuredInput> inputs;
    for (int k = 0; k < side * side; ++k) {
        MeasuredInput p =
            mapped_input(direction(std::cos(view / 180 * pi), 0.45 + azimuth), {0, 0, 1}, facet, roughness, metallic);
        p.x[11] = static_cast<float>(u.next());
        p.x[12] = static_cast<float>(u.next());
        p.x[13] = static_cast<float>((k % side + 0.5) / side);
        p.x[14] = static_cast<float>((k / side + 0.5) / side);
        p.n[0] = map;
        inputs.push_back(p);
    }
    return inputs;
}

double mean_weight(const std::vector<MeasuredOutput>& outputs) {
    double sum = 0;
    for (const MeasuredOutput& o : outputs) {
        sum += double{o.y[3]};
    }
    return sum / static_cast<double>(outputs.size());
}

/// What a white sky makes of a surface shaded by a tilted map's normal: never more than white, and at grazing views no less than half
/// of what it makes of the flat surface.
Measured measure_map_bounds(Backend& backend, double degrees, Effort effort, double roughness, double metallic) {
    const int side = effort == Effort::quick ? 32 : 128;
    const dvec3 mapped = direction(std::cos(degrees / 180 * pi), 0.45);
    Measured m;
    const auto albedo = [&](double view, double azimuth, const dvec3& normal, std::uint32_t map) {
        const std::vector<MeasuredInput> inputs = mapped_draws(view, azimuth, normal, roughness, metallic, map, side);
        m.evaluations += inputs.size();
        return mean_weight(backend.run(Function::mapped_surface, inputs));
    };
    for (const double view : {0.0, 30.0, 60.0, 80.0, 85.0, 89.0}) {
        const double flat = albedo(view, 0, {0, 0, 1}, shared::NORMAL_MAP_NONE);
        for (const double azimuth : {0.0, pi / 4, pi / 2, 3 * pi / 4, pi}) {
            const double seen = albedo(view, azimuth, mapped, shared::NORMAL_MAP_SHADING);
            const std::string where = fmt::format("view {:g}, azimuth {:.2f}: {:.4f} of {:.4f}", view, azimuth, seen, flat);
            worsen(m, std::max(seen - 1, 0.0), where);
            if (view >= 80 && degrees <= 60) {
                worsen(m, std::max(0.5 * flat - seen, 0.0), where);
            }
        }
    }
    return m;
}

/// What a white sky makes of a tilted microfacet map: the facet's own albedo, whatever the tilt.
Measured measure_map_energy(Backend& backend, double degrees, Effort effort, double roughness, double metallic) {
    const int side = effort == Effort::quick ? 32 : 128;
    const double tilt = degrees / 180 * pi;
    const dvec3 facet = direction(std::cos(tilt), 0.45);
    Measured m;
    for (const double view : {0.0, 30.0, 60.0, 80.0, 89.0}) {
        for (const double azimuth : {0.0, pi / 2, pi}) {
            const std::vector<MeasuredInput> inputs =
                mapped_draws(view, azimuth, facet, roughness, metallic, shared::NORMAL_MAP_MICROFACET, side);
            const double albedo = mean_weight(backend.run(Function::mapped_surface, inputs));
            m.evaluations += inputs.size();
            const dvec3 o = given_vec3(inputs[0], 0);
            // The tangent facet shows the mapped one from its mirror image.
            const dvec3 across = facet - facet.z * dvec3(0, 0, 1);
            const double sine = length(across);
            const dvec3 t = sine > 0 ? -across / sine : dvec3(1, 0, 0);
            const double p = std::max(dot(o, facet), 0.0);
            const double share = p > 0 ? p / (p + std::max(dot(o, t), 0.0) * sine) : 0;
            const dvec3 turned = o - 2 * dot(o, t) * t;
            const auto of_facet = [&](const dvec3& w) {
                return metallic < 0 ? 1.0 : ggx_albedo(std::min(dot(w, facet), 1.0), roughness * roughness);
            };
            const double truth =
                (share > 0 ? share * of_facet(o) : 0) + (share < 1 ? (1 - share) * of_facet(turned) : 0);
            worsen(m, std::abs(albedo - truth),
                   fmt::format("view {:g}, azimuth {:.2f}: {:.4f}", view, azimuth, albedo));
        }
    }
    return m;
}

}  // namespace

void add_surface_cases(std::vector<Case>& cases) {
    const Range tilts{"degrees", 0, 89, false, 4, 90};
    cases.push_back({"shading normals", "sample, eval and pdf agree under interpolated normals", tilts, 1e-4,
                     "relative, less below cos 1e-3",
                     [](Backend& b, double tilt, Effort e) { return measure_interpolated(b, tilt, e, shared::NORMAL_MAP_NONE); }});
    cases.push_back({"shading normals",
                     "energy of a white diffuse surface under a microfacet map",
                     {"degrees", 0, 85, false, 3, 18},
                     1e-4,
                     "absolute",
                     [](Backend& b, double tilt, Effort e) { return measure_map_energy(b, tilt, e, 1, -1); }});
    cases.push_back({"shading normals",
                     "energy of a rough metal under a microfacet map",
                     {"degrees", 0, 85, false, 2, 18},
                     0.02,
                     "absolute",
                     [](Backend& b, double tilt, Effort e) { return measure_map_energy(b, tilt, e, 0.5, 1); }});
    cases.push_back({"shading normals", "sample, eval and pdf agree under normal maps", tilts, 1e-3, "relative",
                     [](Backend& b, double tilt, Effort e) {
                         return measure_interpolated(b, tilt, e, shared::NORMAL_MAP_SHADING);
                     }});
    cases.push_back({"shading normals", "sample, eval and pdf agree under microfacet maps", tilts, 1e-3, "relative",
                     [](Backend& b, double tilt, Effort e) {
                         return measure_interpolated(b, tilt, e, shared::NORMAL_MAP_MICROFACET);
                     }});
    cases.push_back({"shading normals",
                     "a mapped diffuse surface gains nothing and does not go black",
                     {"degrees", 0, 85, false, 3, 18},
                     1e-3,
                     "albedo out of bounds",
                     [](Backend& b, double tilt, Effort e) { return measure_map_bounds(b, tilt, e, 1, -1); }});
    cases.push_back({"shading normals",
                     "a mapped metal gains nothing and does not go black",
                     {"degrees", 0, 85, false, 3, 18},
                     1e-3,
                     "albedo out of bounds",
                     [](Backend& b, double tilt, Effort e) { return measure_map_bounds(b, tilt, e, 0.5, 1); }});
}

}  // namespace diptych::core::stability
