// Level 1 on the device: draws made by a compute shader follow the densities that C++ states for them.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "../shared/direction_chi_square.h"
#include "catch.h"
#include "pipelines/compute_shader.h"
#include "draws.h"
#include "memory/readback.h"
#include "test_shader_binaries.h"
#include "memory/upload.h"
#include "vulkan_device.h"

namespace diptych::core::tests {
namespace {

using shared::Drawn;
using shared::DrawSetup;
using shared::uint;

constexpr uint all_features = ~0U;
constexpr int rows = 65;
constexpr int columns = 130;
const vec3 up(0, 0, 1);

/// DIPTYCH_DRAWS, for a device on which 2^26 are soon made, else `usual`.
std::int64_t draw_count(std::int64_t usual) {
    const char* given = std::getenv("DIPTYCH_DRAWS");
    return given != nullptr ? std::atoll(given) : usual;
}

/// The device's draws one after another.
class DrawStream {
public:
    DrawStream(const Gpu& gpu, ComputeShader& shader, const DrawSetup& setup) : gpu_(gpu), shader_(shader) {
        Uploader uploader(gpu);
        setup_ = upload_array(gpu, uploader, Purpose::other, std::span(&setup, 1),
                              vk::BufferUsageFlagBits::eStorageBuffer);
        uploader.finish();
        results_ = make_storage(gpu, batch * sizeof(Drawn));
    }

    const Drawn& next() {
        if (at_ == drawn_.size()) {
            const Buffer* const buffers[] = {&setup_, &results_};
            shader_.run(buffers, batch, first_);
            drawn_ = read_array<Drawn>(gpu_, results_);
            first_ += batch;
            at_ = 0;
        }
        return drawn_[at_++];
    }

private:
    static constexpr std::uint32_t batch = 1U << 17U;
    const Gpu& gpu_;
    ComputeShader& shader_;
    Buffer setup_;
    Buffer results_;
    std::vector<Drawn> drawn_;
    std::size_t at_ = 0;
    std::uint32_t first_ = 0;
};

struct Bench {
    std::shared_ptr<Gpu> gpu = open_gpu({.device = "", .validation = has_validation_layer()});
    ComputeShader shader{*gpu, test_shader_binary("draws.comp"), 2};
    std::int64_t draws = 0;
};

DrawSetup make_setup(uint kind, uint seed) {
    DrawSetup s{};
    s.kind = kind;
    s.seed = seed;
    s.wo = s.surface.geometric_normal = s.surface.shading_normal = s.surface.mapped_normal = up;
    return s;
}

/// Chi-square over directions; `moved` is how far the device's pdf may be from that of C++ at the device's direction.
template <class Pdf>
void check_directions(Bench& bench, const DrawSetup& setup, const Chart& chart, const Pdf& pdf, int tests,
                      double moved) {
    DrawStream stream(*bench.gpu, bench.shader, setup);
    std::int64_t apart = 0;
    std::int64_t deltas = 0;
    const auto draw = [&](vec3& w) {
        const Drawn& d = stream.next();
        w = d.point;
        deltas += d.pdf < 0 ? 1 : 0;
        if (!(d.pdf > 0)) {
            return false;
        }
        apart += close(d.pdf, pdf(w), moved) ? 0 : 1;
        return true;
    };
    const ChiSquareResult r = chi_square(chart, bench.draws, draw, pdf);
    INFO("kind " << setup.kind << " alpha " << setup.surface.parameters.alpha << " cos " << setup.wo.z << " null "
                 << r.null_fraction << " integral " << r.pdf_integral << " deltas " << deltas);
    CHECK(r.impossible == 0);
    CHECK(apart == 0);
    CHECK(r.quadrature < quadrature_limit);
    CHECK(r.p > sidak_threshold(tests));
    CHECK(std::abs(1.0 - r.null_fraction - r.pdf_integral) < 1e-3 + 4.5 * std::sqrt(0.25 / bench.draws));
}

std::size_t cell(double x, double y) {
    const auto i = static_cast<std::size_t>(std::clamp(x * rows, 0.0, rows - 1.0));
    const auto j = static_cast<std::size_t>(std::clamp(y * columns, 0.0, columns - 1.0));
    return i * columns + j;
}

double turn(const vec3& p) {
    return 0.5 + std::atan2(static_cast<double>(p.y), static_cast<double>(p.x)) / (2.0 * M_PI);
}

/// Draws whose map to the unit square is uniform there.
template <class ToSquare>
void check_uniform(Bench& bench, const DrawSetup& setup, const ToSquare& to_square) {
    DrawStream stream(*bench.gpu, bench.shader, setup);
    std::vector<double> cells(rows * columns);
    for (std::int64_t k = 0; k < bench.draws; ++k) {
        cells[to_square(stream.next().point)] += 1;
    }
    INFO("kind " << setup.kind);
    CHECK(std::abs(uniform_deviate(cells)) < deviate_limit);
}

void check_warps(Bench& bench) {
    const auto cosine = [](vec3 w) { return shared::pdf_cosine_hemisphere_solid_angle(w.z); };
    const auto flat = [](vec3) { return shared::pdf_uniform_hemisphere_solid_angle(); };
    check_directions(bench, make_setup(shared::DRAW_COSINE, 1), hemisphere_chart(), cosine, 2, 1e-6);
    check_directions(bench, make_setup(shared::DRAW_HEMISPHERE, 2), hemisphere_chart(), flat, 2, 1e-6);
    check_uniform(bench, make_setup(shared::DRAW_SPHERE, 3),
                  [](vec3 p) { return cell(0.5 + 0.5 * static_cast<double>(p.z), turn(p)); });
    check_uniform(bench, make_setup(shared::DRAW_DISK, 4), [](vec3 p) {
        return cell(static_cast<double>(p.x) * p.x + static_cast<double>(p.y) * p.y, turn(p));
    });
}

void check_facets(Bench& bench) {
    uint seed = 100;
    for (const double alpha : {1.0, 0.3, 0.1, 0.03, 0.01, 1e-3}) {
        for (const double cosine : {1.0, 0.7, 0.1, 0.01}) {
            for (const uint kind : {shared::DRAW_GGX, shared::DRAW_BLINN_PHONG}) {
                DrawSetup s = make_setup(kind, seed++);
                s.wo = direction_at(cosine, 0.45);
                const float a = s.surface.parameters.alpha = static_cast<float>(alpha);
                const auto pdf = [&](vec3 wi) {
                    const vec3 h = normalize(s.wo + wi);
                    return kind == shared::DRAW_GGX ? shared::pdf_ggx_solid_angle(s.wo, h, a)
                                                    : shared::pdf_blinn_phong_solid_angle(dot(s.wo, h), h, a);
                };
                // h is half of a sum that may be as short as 2 cos: its rounding, over alpha, moves the density.
                check_directions(bench, s, half_vector_chart(s.wo, alpha), pdf, 48, 1e-5 + 2e-6 / alpha / cosine);
            }
        }
    }
}

shared::BsdfParameters material(float metallic, float roughness, uint model) {
    return shared::bsdf_parameters(vec3(0.8F, 0.5F, 0.2F), metallic, roughness, 0.04F, 1.0F, vec3(1, 1, 1), model);
}

void check_surfaces(Bench& bench, uint normal_maps) {
    uint seed = 200 + 50 * normal_maps;
    for (const uint model : {shared::BRDF_GGX, shared::BRDF_BLINN_PHONG}) {
        for (const float roughness : {0.0F, 0.5F, 1.0F}) {
            for (const double cosine : {0.9, 0.1}) {
                for (const double tilt : {-1.0, 0.4, 1.2}) {  // of the normal map; below 0: bsdf.h alone
                    const bool mapped = tilt >= 0;
                    DrawSetup s = make_setup(mapped ? shared::DRAW_SURFACE : shared::DRAW_BSDF, seed++);
                    s.wo = direction_at(cosine, 0.45);
                    s.surface.parameters = material(0.0F, roughness, model);
                    s.surface.mapped = mapped ? normal_maps : shared::NORMAL_MAP_NONE;
                    s.surface.mapped_normal = mapped ? direction_at(std::cos(tilt), 2.3) : up;
                    const auto pdf = [&](vec3 wi) {
                        return mapped ? shared::surface_bsdf_pdf(s.surface, s.wo, wi, all_features)
                                      : shared::bsdf_pdf_local(s.surface.parameters, s.wo, wi, all_features);
                    };
                    check_directions(bench, s, hemisphere_chart(), pdf, 72, 1e-3);
                }
            }
        }
    }
}

struct Lamp {
    vec3 v0, e1, e2;
    bool spherical;
};

/// Cells of equal area on the triangle, with the share of solid angle or of area that the stated sampling gives each.
void check_triangle(Bench& bench, const Lamp& lamp, uint seed) {
    DrawSetup setup = make_setup(shared::DRAW_TRIANGLE, seed);
    setup.vertex = lamp.v0;
    setup.edge_1 = lamp.e1;
    setup.edge_2 = lamp.e2;
    constexpr int fine = 6;
    std::vector<double> expected(rows * columns), observed(rows * columns);
    double total = 0;
    const glm::dvec3 n = glm::normalize(glm::cross(glm::dvec3(lamp.e1), glm::dvec3(lamp.e2)));
    const auto point_at = [&](double b1, double b2) {
        return glm::dvec3(lamp.v0) + b1 * glm::dvec3(lamp.e1) + b2 * glm::dvec3(lamp.e2);
    };
    for (int i = 0; i < rows * fine; ++i) {
        for (int j = 0; j < columns * fine; ++j) {
            const double x = (i + 0.5) / (rows * fine);
            const double y = (j + 0.5) / (columns * fine);
            const glm::dvec3 p = point_at(1 - std::sqrt(x), y * std::sqrt(x));
            const double r2 = glm::dot(p, p);
            const double weight = lamp.spherical ? std::abs(glm::dot(p, n)) / (r2 * std::sqrt(r2)) : 1.0;
            expected[cell(x, y)] += weight;
            total += weight;
        }
    }
    DrawStream stream(*bench.gpu, bench.shader, setup);
    std::int64_t wrong_pdfs = 0;
    for (std::int64_t k = 0; k < bench.draws; ++k) {
        const Drawn& d = stream.next();
        const double root = 1 - static_cast<double>(d.point.x);
        observed[cell(root * root, root > 0 ? d.point.y / root : 0)] += 1;
        const glm::dvec3 p = point_at(d.point.x, d.point.y);
        const float pdf = shared::pdf_triangle_solid_angle(vec3(0, 0, 0), lamp.v0, lamp.e1, lamp.e2, vec3(p));
        wrong_pdfs += close(d.pdf, pdf, 1e-3) && d.pdf > 0 ? 0 : 1;
    }
    for (double& e : expected) {
        e *= static_cast<double>(bench.draws) / total;
    }
    INFO("triangle " << seed);
    CHECK(wrong_pdfs == 0);
    CHECK(std::abs(chi_square_deviate(observed, expected)) < deviate_limit);
}

void check_triangles(Bench& bench) {
    const Lamp lamps[] = {{{-0.5F, -0.4F, 1}, {1.1F, 0.1F, 0.2F}, {0.2F, 0.9F, -0.3F}, true},
                          {{-1, -0.2F, 0.1F}, {2, 0, 0.3F}, {0.3F, 0.2F, 1.5F}, true},
                          {{-1, 0.5F, 1}, {2, 0, 0}, {2, 2e-3F, 0}, true},
                          {{-0.5F, -0.4F, 100}, {1.1F, 0.1F, 0.2F}, {0.2F, 0.9F, -0.3F}, false},
                          {{-1, 0.5F, 1}, {2, 0, 0}, {2, 1e-5F, 0}, false}};
    uint seed = 300;
    for (const Lamp& lamp : lamps) {
        check_triangle(bench, lamp, seed++);
    }
}

void check_alias_table(Bench& bench) {
    DrawSetup setup = make_setup(shared::DRAW_ALIAS, 400);
    std::vector<double> expected(shared::DRAW_COLUMNS), observed(shared::DRAW_COLUMNS);
    for (uint i = 0; i < shared::DRAW_COLUMNS; ++i) {
        shared::AliasEntry& e = setup.table[i];
        e.probability = i % 8 == 0 ? 0.0F : (i % 8 == 1 ? 1.0F : static_cast<float>(i) / 64.0F);
        e.alias = (i * 37 + 5) % shared::DRAW_COLUMNS;
        expected[i] += static_cast<double>(e.probability) * bench.draws / shared::DRAW_COLUMNS;
        expected[e.alias] += (1.0 - static_cast<double>(e.probability)) * bench.draws / shared::DRAW_COLUMNS;
    }
    DrawStream stream(*bench.gpu, bench.shader, setup);
    for (std::int64_t k = 0; k < bench.draws; ++k) {
        observed[static_cast<std::size_t>(stream.next().point.x)] += 1;
    }
    CHECK(std::abs(chi_square_deviate(observed, expected)) < deviate_limit);
}

void check_samplers(std::int64_t draws) {
    Bench bench;
    bench.draws = draws;
    check_warps(bench);
    check_facets(bench);
    check_surfaces(bench, shared::NORMAL_MAP_SHADING);
    check_surfaces(bench, shared::NORMAL_MAP_MICROFACET);
    check_triangles(bench);
    check_alias_table(bench);
}

}  // namespace

TEST_CASE("The device's draws follow their densities") {
    NEED_VULKAN();
    check_samplers(draw_count(1 << 16));
    check_no_validation_messages();
}

TEST_CASE("Millions of the device's draws follow their densities", "[nightly]") {
    NEED_VULKAN();
    check_samplers(draw_count(1 << 21));
    check_no_validation_messages();
}

}  // namespace diptych::core::tests
