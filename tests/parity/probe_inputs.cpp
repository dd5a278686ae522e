#include "probe_inputs.h"

#include <array>
#include <cmath>
#include <random>

namespace diptych::core::tests {
namespace {

using shared::uint;
using shared::vec3;

constexpr std::array edge_words = {0U,          1U,          2U,          0x7fffffffU, 0x80000000U, 0x80000001U,
                                   0xfffffffeU, 0xffffffffU, 0x007fffffU, 0x00800000U, 0x7f7fffffU, 0x7f800000U,
                                   0x7f800001U, 0x7fc00000U, 0xff800000U, 0xffc00001U, 0x3f800000U, 0x3f7fffffU,
                                   0x3f800001U, 0xc2fc0000U, 0x43000000U, 0x42ffffffU};
constexpr std::array edge_units = {0.0F, 0x1p-24F, 0.25F, 0.5F, 0.5F - 0x1p-24F, 0.75F, 1.0F - 0x1p-24F};
constexpr std::array edge_numbers = {1.0F,     -1.0F,       0.5F,       2.0F,  0x1p-60F,
                                     -0x1p60F, 0.99999994F, 1.0000001F, 1e-3F, 126.0F};
constexpr std::array edge_specials = {0.0F,  -0.0F,   INFINITY,   -INFINITY,   NAN,
                                      1.0F,  -1.0F,   128.0F,     -126.0F,     0x1p-126F,
                                      3e37F, -127.5F, 0.0031308F, 0.41421357F, -0.2928932F};
constexpr std::array edge_cosines = {1.0, 0.99999994, 0.5, 1e-3, 1e-5, 1.2e-7};
constexpr std::array edge_alphas = {1e-4F, 1e-3F, 0.01F, 0.010001F, 0.03F, 0.5F, 1.0F};
constexpr std::array edge_angles = {0.0F,        -0.0F,        0.785398163F, 1.57079633F,
                                    3.14159265F, -6.28318531F, 2.35619449F,  16384.0F};
const std::array<vec3, 8> edge_axes = {{{0, 0, 1},
                                        {0, 0, -1},
                                        {1, 0, 0},
                                        {0, -1, 0},
                                        {0.6F, 0, 0.8F},
                                        {0.6F, 0, -0.8F},
                                        {0.998046875F, 0, -0.0625F},
                                        {-0.70710677F, 0.70710677F, 0}}};

class Draws {
public:
    explicit Draws(std::uint32_t seed) : engine_(seed) {}

    uint word() { return static_cast<uint>(engine_()); }
    double unit() { return static_cast<double>(engine_()) * 0x1p-32; }
    float fraction() { return static_cast<float>(word() >> 8U) * 0x1p-24F; }
    bool one_in(uint n) { return word() % n == 0; }

    /// An element of the table on an edge input, as a rule; otherwise `random`.
    template <typename Table, typename Random>
    auto edge_or(const Table& table, const Random& random) -> decltype(random()) {
        return edges && !one_in(4) ? static_cast<decltype(random())>(table[word() % table.size()]) : random();
    }

    /// Of either sign, evenly in its logarithm.
    float sized(double low, double high) {
        const double size = std::exp2(low + (high - low) * unit());
        return static_cast<float>(one_in(2) ? size : -size);
    }

    bool edges = false;

private:
    std::mt19937 engine_;
};

vec3 rounded(const glm::dvec3& v) {
    return vec3(glm::normalize(v));
}

vec3 on_sphere(Draws& draws) {
    const double z = 2.0 * draws.unit() - 1.0;
    const double phi = 2.0 * M_PI * draws.unit();
    const double s = std::sqrt(1.0 - z * z);
    return rounded({s * std::cos(phi), s * std::sin(phi), z});
}

/// Above the plane; one in four grazing.
vec3 above(Draws& draws) {
    const double cosine = draws.edge_or(edge_cosines, [&] {
        return draws.one_in(4) ? std::pow(10.0, -6.9 * draws.unit()) : std::max(draws.unit(), 1.2e-7);
    });
    const double phi = 2.0 * M_PI * draws.unit();
    const double s = std::sqrt(1.0 - cosine * cosine);
    return {static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)), static_cast<float>(cosine)};
}

vec3 facet_normal(Draws& draws, double alpha) {
    const double u = draws.unit();
    const double tangent = alpha * std::sqrt(u / (1.0 - u + 1e-6)) * (draws.one_in(8) ? 10.0 : 1.0);
    const double phi = 2.0 * M_PI * draws.unit();
    return rounded({tangent * std::cos(phi), tangent * std::sin(phi), 1.0});
}

/// A unit vector near another, by an angle evenly spread in its logarithm or up to `most`.
vec3 tilted(Draws& draws, const vec3& axis, double most) {
    const double angle = draws.one_in(4) ? most * std::pow(10.0, -5.0 * draws.unit()) : most * draws.unit();
    const glm::dvec3 a(axis);
    const glm::dvec3 across =
        glm::normalize(glm::cross(a, std::abs(a.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const double phi = 2.0 * M_PI * draws.unit();
    const glm::dvec3 side = std::cos(phi) * across + std::sin(phi) * glm::cross(a, across);
    return rounded(std::cos(angle) * a + std::sin(angle) * side);
}

vec3 box(Draws& draws) {
    const double x = 2.0 * draws.unit() - 1.0;
    const double y = 2.0 * draws.unit() - 1.0;
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(2.0 * draws.unit() - 1.0)};
}

/// Any triangle: near, far, sliver, degenerate.
void put_triangle(Draws& draws, shared::ProbeInput& p) {
    const float size = std::exp2(static_cast<float>(-14.0 * draws.unit() + 2.0));
    p.vertex = box(draws) + vec3(0, 0, draws.one_in(2) ? 2.0F : 0.0F);
    p.edge_1 = size * box(draws);
    p.edge_2 = size * box(draws);
    if (draws.one_in(16)) {
        p.edge_2 = p.edge_1 + 1e-4F * p.edge_2;
    }
    if (draws.edges) {
        p.edge_2 = draws.one_in(4) ? vec3(0, 0, 0) : (draws.one_in(3) ? p.edge_1 : p.edge_2);
        p.edge_1 = draws.one_in(8) ? vec3(0, 0, 0) : p.edge_1;
        p.vertex = draws.one_in(8) ? vec3(0, 0, 0) : p.vertex;
    }
}

vec3 color(Draws& draws) {
    const auto part = [&] {
        return draws.edge_or(std::array{0.0F, 1.0F, 0.0031308F, 0.5F}, [&] { return draws.fraction(); });
    };
    const float r = part();
    const float g = part();
    return {r, g, part()};
}

shared::ProbeInput make_input(Draws& draws) {
    shared::ProbeInput p{};
    for (int i = 0; i < 4; ++i) {
        p.words[i] = draws.edge_or(edge_words, [&] { return draws.word(); });
        p.u[i] = draws.edge_or(edge_units, [&] { return draws.fraction(); });
    }
    p.set.y = draws.one_in(2) ? 1 + draws.word() % shared::HAMMERSLEY_MAX_COUNT : 1 + draws.word() % 64;
    p.set.x = draws.edges && draws.one_in(2) ? p.set.y - 1 : draws.word() % p.set.y;
    p.angle = draws.edge_or(edge_angles, [&] {
        return static_cast<float>((2.0 * draws.unit() - 1.0) * (draws.one_in(2) ? 7.0 : double{shared::SIN_COS_MAX}));
    });
    p.number = draws.edge_or(edge_numbers, [&] { return draws.sized(-60, 60); });
    p.other = draws.edge_or(edge_numbers,
                            [&] { return draws.one_in(2) ? draws.sized(-60, 60) : p.number * draws.sized(-3, 3); });
    p.special = draws.edge_or(edge_specials, [&] { return draws.sized(-30, 12); });
    p.alpha = draws.edge_or(edge_alphas, [&] { return static_cast<float>(std::pow(10.0, -4.0 * draws.unit())); });
    p.alpha = std::max(p.alpha, shared::ALPHA_MIRROR);
    p.wo = above(draws);
    p.wi = above(draws);
    p.facet = facet_normal(draws, double{p.alpha});
    p.axis = draws.edge_or(edge_axes, [&] { return on_sphere(draws); });
    p.axis_2 = draws.edge_or(edge_axes, [&] { return on_sphere(draws); });
    p.shading = tilted(draws, p.axis, draws.one_in(4) ? 1.4 : 0.3);
    p.mapped = tilted(draws, p.shading, draws.one_in(4) ? 2.0 : 1.2);
    p.view = tilted(draws, p.axis, 1.58);
    p.light = tilted(draws, draws.one_in(4) ? p.mapped : p.axis, 1.58);
    put_triangle(draws, p);
    p.color = color(draws);
    p.color_2 = color(draws);
    for (int i = 0; i < 3; ++i) {
        p.radiance[i] = draws.one_in(16) ? p.special : std::abs(draws.sized(-20, 30));
    }
    return p;
}

}  // namespace

std::vector<shared::ProbeInput> make_probe_inputs(std::uint32_t seed, std::uint32_t count) {
    Draws draws(seed);
    std::vector<shared::ProbeInput> inputs;
    inputs.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        draws.edges = i % 8 == 0;
        inputs.push_back(make_input(draws));
    }
    return inputs;
}

}  // namespace diptych::core::tests
