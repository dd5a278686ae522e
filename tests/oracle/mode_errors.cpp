// Which mode knows the picture best after a given time of all threads, so that other load on the machine matters less.
#include <cmath>
#include <cstdio>
#include <ctime>

#include "catch.h"
#include "oracle_fixture.h"

namespace diptych::core::tests {

namespace {

using namespace oracle;

struct Errors {
    double image;  // standard error of the image's mean over that mean; mean of the channels
    double pixel;  // root of the mean over pixels of the same, squared, a hundredth of the image's mean added to each
    std::uint64_t spp;
};

double mean_of(const dvec3& v) {
    return (v.x + v.y + v.z) / 3;
}

Errors errors_of(const OracleImage& image) {
    const double count = double(image.pixels.size());
    double mean = 0;
    double variance = 0;
    for (const OraclePixel& pixel : image.pixels) {
        mean += mean_of(pixel.mean()) / count;
    }
    double relative = 0;
    for (const OraclePixel& pixel : image.pixels) {
        const double square = mean_of(pixel.variance_of_mean());  // channels that err together
        const double own = mean_of(pixel.mean());
        variance += square / count / count;
        relative += square / (own * own + 1e-4 * mean * mean) / count;
    }
    return {std::sqrt(variance) / mean, std::sqrt(relative), image.pixels[0].samples};
}

Errors render_for(const Scene& scene, Mode mode, double seconds) {
    OracleSettings settings = small_settings(32, 32, 8);
    settings.mode = mode;
    Oracle oracle(scene, settings);
    const std::atomic<bool> never = false;
    const std::clock_t start = std::clock();
    std::uint64_t spp = 0;
    while (double(std::clock() - start) < seconds * CLOCKS_PER_SEC) {
        oracle.render(spp, 16, never);
        spp += 16;
    }
    return errors_of(oracle.image());
}

}  // namespace

TEST_CASE("mis is the mode of least error where near mirrors see small lamps", "[oracle][nightly]") {
    std::printf("| scene | mode | spp | error of the image's mean | root mean square error of a pixel |\n");
    for (const char* name : {"veach-mis", "brdf-grid", "cornell", "courtyard"}) {
        Scene scene = generate_scene(name).scene;
        if (std::string(name) == "courtyard") {
            scene.environment = constant_sky({1.8F, 2.1F, 2.6F});
        }
        Errors errors[3];
        const Mode modes[] = {Mode::area, Mode::bsdf, Mode::mis};
        for (int i = 0; i < 3; ++i) {
            errors[i] = render_for(scene, modes[i], 6);
            std::printf("| %s | %s | %u | %.3f %% | %.3f %% |\n", name, name_of(modes[i]), unsigned(errors[i].spp),
                        100 * errors[i].image, 100 * errors[i].pixel);
        }
        INFO(name);
        if (std::string(name) == "veach-mis" || std::string(name) == "brdf-grid") {
            CHECK(errors[2].pixel < errors[0].pixel);
            CHECK(errors[2].pixel < errors[1].pixel);
        }
    }
}

}  // namespace diptych::core::tests
