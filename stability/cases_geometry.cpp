// Frames, solid angles, needles.
#include <algorithm>

#include "case_parts.h"
#include "references.h"

namespace diptych::core::stability {

namespace {

Measured measure_frames(Backend& backend, double from_pole, Effort effort) {
    Uniforms u(5);
    std::vector<MeasuredInput> inputs;
    const int count = effort == Effort::quick ? 256 : 4096;
    for (int i = 0; i < count; ++i) {
        for (const double side : {-1.0, 1.0}) {
            MeasuredInput p{};
            const double azimuth = i < 8 ? i * pi / 4 : 2 * pi * u.next();
            const double sine = std::sqrt(from_pole * (2 - from_pole));
            take_vec3(p, 0, {sine * std::cos(azimuth), sine * std::sin(azimuth), side * (1 - from_pole)});
            inputs.push_back(p);
        }
    }
    const std::vector<MeasuredOutput> outputs = backend.run(Function::frame, inputs);
    Measured m;
    m.evaluations = inputs.size();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const dvec3 n = given_vec3(inputs[i], 0);
        const dvec3 t = result_vec3(outputs[i], 0);
        const dvec3 b = result_vec3(outputs[i], 3);
        const std::string where = fmt::format("({:.3g}, {:.3g}, {:.9g})", n.x, n.y, n.z);
        for (const double error : {dot(t, b), dot(t, n), dot(b, n), length(t) - 1, length(b) - 1}) {
            worsen(m, std::abs(error), where);
        }
    }
    return m;
}

enum class TriangleError { solid_angle, pdf, triple };

struct Corners {
    dvec3 a, b, c;
};

Corners corners_of(const MeasuredInput& p) {
    const dvec3 a = given_vec3(p, 3);
    return {a, a + given_vec3(p, 6), a + given_vec3(p, 9)};
}

/// The density that the sampler's own rule has at a point of the triangle: by solid angle, or by area and r^2/cos.
double true_pdf(const Corners& t, double b_1, double b_2, double omega) {
    if (omega >= double{shared::SPHERICAL_TRIANGLE_MIN} && omega <= double{shared::SPHERICAL_TRIANGLE_MAX}) {
        return 1 / omega;
    }
    const dvec3 n = cross(t.b - t.a, t.c - t.a);
    const dvec3 p = (1 - b_1 - b_2) * t.a + b_1 * t.b + b_2 * t.c;
    return 2 * std::pow(length(p), 3) / std::abs(dot(n, p));
}

/// Of the rounded edges and in double, as the host packs emitters.
void put_normal(MeasuredInput& p) {
    const dvec3 n = cross(given_vec3(p, 6), given_vec3(p, 9));
    const double double_area = length(n);
    take_vec3(p, 0, double_area > 0 ? n / double_area : n);
    p.x[14] = static_cast<float>(double_area);
}

Measured judge_triangles(Backend& backend, std::vector<MeasuredInput> inputs, TriangleError kind) {
    std::for_each(inputs.begin(), inputs.end(), put_normal);
    const std::vector<MeasuredOutput> outputs = backend.run(Function::triangle, inputs);
    Measured m;
    m.evaluations = inputs.size();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const MeasuredOutput& o = outputs[i];
        const Corners t = corners_of(inputs[i]);
        const double omega = solid_angle(t.a, t.b, t.c);
        const std::string where = fmt::format("{:.3g} sr", omega);
        if (kind == TriangleError::solid_angle) {
            worsen(m, relative_error(double{o.y[0]}, omega), where);
        } else if (kind == TriangleError::triple) {
            worsen(m, relative_error(double{o.y[4]}, double{o.y[3]}), where);
        } else if (o.y[3] > 0) {
            // At the bounds of the spherical branch rounding may take either, which are then alike.
            const double both = true_pdf(t, double{o.y[1]}, double{o.y[2]}, omega);
            worsen(m, relative_error(double{o.y[3]}, both), where);
        }
    }
    return m;
}

void put_triangle(MeasuredInput& p, const dvec3& a, const dvec3& b, const dvec3& c, Uniforms& u) {
    take_vec3(p, 3, a);
    take_vec3(p, 6, b - a);
    take_vec3(p, 9, c - a);
    p.x[12] = static_cast<float>(u.next());
    p.x[13] = static_cast<float>(u.next());
}

/// Triangles at distance 1 that subtend about `omega`, tilted up to 75 degrees; large ones surround the point.
Measured measure_triangles(Backend& backend, double omega, Effort effort, TriangleError kind) {
    Uniforms u(6);
    std::vector<MeasuredInput> inputs(effort == Effort::quick ? 512 : 4096);
    for (MeasuredInput& p : inputs) {
        dvec3 corners[3];
        const double turn = 2 * pi * u.next();
        const double tilt = omega < 1 ? std::tan(75.0 / 180 * pi * u.next()) : 0;
        for (int k = 0; k < 3; ++k) {
            const double azimuth = turn + k * 2 * pi / 3 + 0.5 * u.next();
            // Of a cone of that solid angle, whose cosine is 1 - omega / 2 pi.
            const double cosine = 1 - omega / (2 * pi);
            const double radius = std::sqrt(omega / pi * (1 - omega / (4 * pi))) / cosine * (omega < 1 ? 1.5 : 1.0);
            const dvec3 across(radius * std::cos(azimuth), radius * std::sin(azimuth), 0);
            corners[k] = across + dvec3(0, 0, 1 + tilt * across.x);
        }
        const dvec3 axis = direction(2 * u.next() - 1, 2 * pi * u.next());
        const dvec3 side = normalize(cross(axis, std::abs(axis.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
        for (dvec3& corner : corners) {
            corner = corner.x * side + corner.y * cross(axis, side) + corner.z * axis;
        }
        put_triangle(p, corners[0], corners[1], corners[2], u);
    }
    return judge_triangles(backend, inputs, kind);
}

/// Needles of unit length, as wide as one over the aspect, across the line of sight and along it.
Measured measure_needles(Backend& backend, double aspect, Effort effort, TriangleError kind) {
    Uniforms u(7);
    std::vector<MeasuredInput> inputs(effort == Effort::quick ? 256 : 4096);
    for (MeasuredInput& p : inputs) {
        const dvec3 along = direction(2 * u.next() - 1, 2 * pi * u.next());
        const dvec3 any = direction(2 * u.next() - 1, 2 * pi * u.next());
        const dvec3 across = normalize(cross(along, any));
        const dvec3 start = 1.5 * normalize(cross(along, across)) + 0.3 * along;
        put_triangle(p, start, start + along, start + u.next() * along + across / aspect, u);
    }
    return judge_triangles(backend, inputs, kind);
}

/// Triangles without area: no direction may come of them, and no number that is none.
Measured measure_flat_triangles(Backend& backend, Effort) {
    Uniforms u(8);
    std::vector<MeasuredInput> inputs(64);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const dvec3 a(0.5, 0.25, 1);
        const dvec3 b = i % 3 == 0 ? a : a + dvec3(1, 0, 0);
        const dvec3 c = i % 3 == 1 ? b : a + (i % 2 == 0 ? 2.0 : 0.0) * (b - a);
        put_triangle(inputs[i], a, b, c, u);
        put_normal(inputs[i]);
    }
    Measured m;
    for (const MeasuredOutput& o : backend.run(Function::triangle, inputs)) {
        ++m.evaluations;
        worsen(m, o.y[0] == 0 && o.y[3] == 0 && o.y[4] == 0 ? m.error : m.error + 1, "");
        for (const float y : {o.y[0], o.y[1], o.y[2], o.y[3], o.y[4]}) {
            worsen(m, std::isfinite(y) ? 0.0 : NAN, "");
        }
    }
    return m;
}

}  // namespace

void add_geometry_cases(std::vector<Case>& cases) {
    cases.push_back({"degenerate triangles",
                     "solid angle of needles",
                     {"aspect", 1, 1e6, true, 4, 25},
                     2e-5,
                     "relative",
                     [](Backend& b, double aspect, Effort e) {
                         return measure_needles(b, aspect, e, TriangleError::solid_angle);
                     }});
    cases.push_back(
        {"degenerate triangles",
         "pdf of points on needles",
         {"aspect", 1, 1e6, true, 4, 25},
         2e-5,
         "relative",
         [](Backend& b, double aspect, Effort e) { return measure_needles(b, aspect, e, TriangleError::pdf); }});
    cases.push_back({"degenerate triangles",
                     "triangles without area are never sampled",
                     {""},
                     0,
                     "count",
                     [](Backend& b, double, Effort e) { return measure_flat_triangles(b, e); }});
    cases.push_back({"frames",
                     "orthonormal about any normal",
                     {"distance to a pole", 1e-12, 1, true, 7, 49},
                     1e-6,
                     "absolute",
                     measure_frames});
    const Range angles{"steradians", 1e-10, 6.25, true, 7, 44};
    cases.push_back(
        {"solid angle", "against double precision", angles, 1e-5, "relative", [](Backend& b, double omega, Effort e) {
             return measure_triangles(b, omega, e, TriangleError::solid_angle);
         }});
    cases.push_back(
        {"solid angle", "pdf of sampled points", angles, 1e-4, "relative",
         [](Backend& b, double omega, Effort e) { return measure_triangles(b, omega, e, TriangleError::pdf); }});
    cases.push_back(
        {"solid angle", "pdf when sampled and when hit", angles, 1e-4, "relative",
         [](Backend& b, double omega, Effort e) { return measure_triangles(b, omega, e, TriangleError::triple); }});
}

}  // namespace diptych::core::stability
