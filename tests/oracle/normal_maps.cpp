// Normal maps by the model `shading`: closed forms of its terms, and by quadrature what it draws and how much light it
// gives back.
#include <cmath>

#include "catch.h"
#include "oracle_fixture.h"

namespace diptych::core::tests {

namespace {

using namespace oracle;

const dvec3 up(0, 0, 1);

double radians(double degrees) {
    return degrees * pi / 180;
}

/// The unit vector at so many degrees from the triangle's normal, and about it.
dvec3 leaning(double degrees, double azimuth = 0) {
    const double sine = std::sin(radians(degrees));
    return {sine * std::cos(radians(azimuth)), sine * std::sin(radians(azimuth)), std::cos(radians(degrees))};
}

Bsdf white_diffuse() {
    Bsdf bsdf;
    bsdf.diffuse = dvec3(1);
    return bsdf;
}

Bsdf white_metal(Distribution model, double alpha) {
    Bsdf bsdf;
    bsdf.model = model;
    bsdf.alpha = alpha;
    bsdf.f0 = dvec3(1);
    bsdf.f90 = 1;
    return bsdf;
}

Bsdf plastic(Distribution model, double alpha) {
    Bsdf bsdf = white_metal(model, alpha);
    bsdf.diffuse = dvec3(0.7, 0.5, 0.2);
    bsdf.f0 = dvec3(0.04);
    return bsdf;
}

const char* name_of(Distribution model) {
    return model == Distribution::ggx ? "ggx" : "blinn-phong";
}

/// The midpoint rule over the whole sphere, of value(i).
template <typename Value>
auto over_sphere(Value value) {
    constexpr int rings = 600;
    constexpr int sectors = 600;
    decltype(value(up)) sum(0);
    for (int i = 0; i < rings; ++i) {
        const double cosine = 2 * (i + 0.5) / rings - 1;
        for (int j = 0; j < sectors; ++j) {
            sum += value(with_cosine(leaning(90, 360 * (j + 0.5) / sectors), up, cosine));
        }
    }
    return sum * (4 * pi / (rings * sectors));
}

/// All that the point scatters of a uniform sky, by a grid of the numbers that `sample` draws with.
double albedo(const Mapped& mapped, const Bsdf& bsdf, const dvec3& o) {
    constexpr int n = 96;
    const double share = specular_share(bsdf, mapped.q, o);
    double sum = 0;
    const auto add = [&](double chance, const dvec3& i) {
        const double p = density(mapped, bsdf, o, i);
        sum += p > 0 ? chance * evaluate(mapped, bsdf, o, i).x / p : 0;
    };
    for (int k = 0; k < n * n; ++k) {
        const double u = (k / n + 0.5) / n;
        const double angle = 2 * pi * (k % n + 0.5) / n;
        if (share < 1) {
            add(1 - share, around(mapped.p, std::sqrt(1 - u), angle));
        }
        const dvec3 h = around(mapped.q, sample_ndf_cosine(bsdf.model, bsdf.alpha, u), angle);
        const dvec3 i = -flip_across(o, h);
        if (share > 0 && dot(o, h) > 0 && dot(i, mapped.q) > 0) {
            add(share, i.z < 0 ? flip_across(i, up) : i);
        }
    }
    return sum / (n * n);
}

template <typename Check>
void over_tilts_and_views(Check check) {
    for (const double tilt : {5.0, 30.0, 60.0, 85.0}) {
        for (const double view : {0.0, 40.0, 75.0, 88.0, 89.9}) {
            for (const double azimuth : {0.0, 100.0, 180.0}) {
                INFO("tilt " << tilt << " view " << view << " azimuth " << azimuth);
                check(leaning(tilt), leaning(view, azimuth));
            }
        }
    }
}

}  // namespace

TEST_CASE("the specular normal is turned just so far that the mirror direction leaves the surface", "[oracle]") {
    int turned = 0;
    int kept = 0;
    over_tilts_and_views([&](const dvec3& p, const dvec3& o) {
        const Mapped mapped = make_mapped(up, p, o);
        const double least = std::fmin(0.9 * o.z, 0.1);
        const double rises = 2 * dot(o, mapped.q) * mapped.q.z - o.z;
        CHECK(length(mapped.q) == Approx(1).epsilon(1e-12));
        CHECK(dot(o, mapped.q) > 0);
        if (mapped.q == p) {
            CHECK(rises >= least);
            ++kept;
        } else {
            CHECK(rises == Approx(least).epsilon(1e-9));
            CHECK(std::abs(dot(mapped.q, normalize(cross(up, p)))) < 1e-12);
            CHECK(mapped.q.z > p.z);
            CHECK(dot(mapped.q, p) > p.z);
            ++turned;
        }
    });
    CHECK(turned > 10);
    CHECK(kept > 10);
}

TEST_CASE("a mapped diffuse surface that is seen head-on shows n l", "[oracle]") {
    for (const double tilt : {1.0, 20.0, 45.0}) {
        const dvec3 p = leaning(tilt, 50);
        const Mapped mapped = make_mapped(up, p, up);
        for (const double light : {0.0, 30.0, 60.0, 75.0}) {
            for (const double azimuth : {0.0, 50.0, 140.0, 230.0}) {
                INFO("tilt " << tilt << " light " << light << " azimuth " << azimuth);
                const dvec3 i = leaning(light, azimuth);
                CHECK(evaluate(mapped, white_diffuse(), up, i).x * pi ==
                      Approx(std::fmax(dot(i, p), 0)).epsilon(0.03).margin(1e-15));
            }
        }
    }
}

TEST_CASE("a light that sinks below the surface fades under a normal that leans toward it", "[oracle]") {
    const double range = 0.25 * std::cos(radians(28));
    const double x = std::cos(radians(88)) / range;
    REQUIRE(x < 0.2);
    const Mapped mapped = make_mapped(up, leaning(60), leaning(20, 90));
    CHECK(evaluate(mapped, white_diffuse(), leaning(20, 90), leaning(88)).x * pi ==
          Approx((x + x * x - x * x * x) * std::cos(radians(28))).epsilon(1e-9));
    CHECK(evaluate(mapped, white_diffuse(), leaning(20, 90), leaning(90.1)) == dvec3(0));
    // The viewer leaves the diffuse term alone, even behind p.
    const dvec3 behind = leaning(80, 180);
    REQUIRE(dot(behind, leaning(60)) < 0);
    CHECK(evaluate(make_mapped(up, leaning(60), behind), white_diffuse(), behind, leaning(30)).x * pi ==
          Approx(std::cos(radians(30))).epsilon(1e-12));

    // Of a specular term, alpha narrows the range.
    const Bsdf metal = white_metal(Distribution::ggx, 0.5);
    const dvec3 o = leaning(10);
    const dvec3 i = leaning(89);
    const Mapped kept = make_mapped(up, leaning(40), o);
    REQUIRE(kept.q == kept.p);
    const double y = std::cos(radians(89)) / (0.25 * 0.5 * std::cos(radians(49)));
    const double both = evaluate(metal, kept.q, o, i).x + evaluate(metal, kept.q, o, leaning(91)).x;
    CHECK(evaluate(kept, metal, o, i).x == Approx((y + y * y - y * y * y) * both).epsilon(1e-9));
}

TEST_CASE("the densities of a mapped surface add up to the draws that do not fail", "[oracle]") {
    std::uint64_t stream = 0;
    for (const Distribution model : {Distribution::ggx, Distribution::blinn_phong}) {
        for (const Bsdf& bsdf : {white_diffuse(), white_metal(model, 0.3), plastic(model, 0.2), plastic(model, 0.9)}) {
            for (const double tilt : {30.0, 80.0}) {
                for (const double view : {20.0, 80.0}) {
                    INFO(name_of(model) << " alpha " << bsdf.alpha << " diffuse " << bsdf.diffuse.x << " tilt " << tilt
                                        << " view " << view);
                    const dvec3 o = leaning(view, 130);
                    const Mapped mapped = make_mapped(up, leaning(tilt), o);
                    Random random(8, ++stream, 0);
                    constexpr int draws = 40000;
                    double drawn_at_all = 0;
                    dvec3 sum(0);  // of weights times what weighs one side of the sky more than the other
                    dvec3 squares(0);
                    const auto sky = [](const dvec3& i) { return dvec3(1, 1 + i.x, 1 + i.y); };
                    for (int k = 0; k < draws; ++k) {
                        const Scattered drawn = sample(mapped, bsdf, o, false, random);
                        drawn_at_all += drawn.weight != dvec3(0) ? 1.0 / draws : 0;
                        sum += drawn.weight * sky(drawn.i) / double(draws);
                        squares += pow(drawn.weight * sky(drawn.i), dvec3(2)) / double(draws);
                    }
                    const double stated = over_sphere([&](const dvec3& i) { return density(mapped, bsdf, o, i); });
                    CHECK(stated <= 1 + 1e-3);
                    CHECK(std::abs(stated - drawn_at_all) <=
                          z_limit * std::sqrt(drawn_at_all * (1 - drawn_at_all) / draws) + 1e-3);
                    const dvec3 truth =
                        over_sphere([&](const dvec3& i) { return evaluate(mapped, bsdf, o, i) * sky(i); });
                    const dvec3 error = sqrt(max(squares - sum * sum, dvec3(0)) / double(draws));
                    for (int k = 0; k < 3; ++k) {
                        INFO("sky " << k << ": " << sum[k] << " +- " << error[k] << ", quadrature " << truth[k]);
                        CHECK(std::abs(sum[k] - truth[k]) <= z_limit * error[k] + 1e-3 * truth[k]);
                        CHECK(error[k] < 0.02 * truth[k]);
                    }
                }
            }
        }
    }
}

TEST_CASE("a map makes no light, and takes of a smooth metal's next to nothing", "[oracle]") {
    over_tilts_and_views([](const dvec3& p, const dvec3& o) {
        const Mapped mapped = make_mapped(up, p, o);
        const double diffuse = albedo(mapped, white_diffuse(), o);
        CHECK(diffuse <= 1 + 1e-3);
        CHECK(diffuse >= 0.5 * (1 + p.z) * 0.85);  // the half of the sky that p sees, less what S takes
        for (const Distribution model : {Distribution::ggx, Distribution::blinn_phong}) {
            for (const double alpha : {0.002, 0.05, 0.3, 1.0}) {
                INFO(name_of(model) << " alpha " << alpha);
                const double metal = albedo(mapped, white_metal(model, alpha), o);
                CHECK(metal <= 1 + 1e-3);
                if (alpha == 0.002 && o.z > 0.1) {
                    CHECK(metal >= 0.98);
                }
            }
            Random random(9, 0, 0);
            const Scattered mirrored = sample(mapped, white_metal(model, 0), o, false, random);
            CHECK(mirrored.mirrored);
            CHECK(mirrored.weight == dvec3(1));
            CHECK(mirrored.i.z > 0);
        }
    });
}

}  // namespace diptych::core::tests
