// The window's picture against what the host makes of the same films.
#include "display/display_pass.h"

#include <atomic>
#include <cmath>
#include <cstring>
#include <functional>

#include "../../shaders/display_colors.h"
#include "commands/commands.h"
#include "gpu_fixture.h"
#include "renderer/path_renderer.h"
#include "render/film.h"
#include "render/film_statistics.h"
#include "generate/generate.h"
#include "film/tonemap.h"

namespace diptych::core::tests {
namespace {

using shared::vec3;

constexpr int width = 40;
constexpr int height = 28;
constexpr float code = 1.0F / 255.0F;

/// A device, the pass, and pictures of one size.
class Display {
public:
    Display(int columns, int rows)
        : gpu(open_test_gpu()), pass_(make_display_pass(*gpu)),
          picture_(make_display_picture(*gpu, pass_, static_cast<std::uint32_t>(columns),
                                        static_cast<std::uint32_t>(rows))) {}

    /// Of what was shown last.
    std::optional<DisplayRange> range() const { return shown_range(picture_); }

    Image show(const DisplayRequest& request) {
        run_commands(
            *gpu, [&](const vk::raii::CommandBuffer& commands) { record_display(commands, pass_, picture_, request); });
        return read_display(*gpu, picture_);
    }

    const std::shared_ptr<Gpu> gpu;

private:
    DisplayPass pass_;
    DisplayPicture picture_;
};

RenderSettings layered_settings(Integrator integrator) {
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    settings.integrator = integrator;
    settings.max_depth = 2;
    settings.standard_error = settings.first_hit_layers = true;
    return settings;
}

void add_samples(Renderer& renderer, std::uint32_t count) {
    const std::atomic<bool> cancel = false;
    renderer.render(0, count, cancel);
}

using ColorAt = std::function<vec3(int x, int y)>;

/// The largest difference of any channel from what is expected, in codes of 8 bits.
float worst(const Image& shown, const ColorAt& expected) {
    float found = 0;
    for (int y = 0; y < shown.height; ++y) {
        for (int x = 0; x < shown.width; ++x) {
            const vec3 wanted = expected(x, y);
            for (int channel = 0; channel < 3; ++channel) {
                const float clamped = std::clamp(wanted[channel], 0.0F, 1.0F);
                found = std::max(found, std::abs(shown.at(x, y, channel) - clamped) / code);
            }
        }
    }
    return found;
}

vec3 color_at(const Image& image, int x, int y) {
    return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
}

/// A film of one colour.
Film plain_film(int columns, int rows, const vec3& radiance) {
    Film film;
    film.width = columns;
    film.height = rows;
    film.pixels.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (shared::FilmPixel& pixel : film.pixels) {
        for (int sample = 0; sample < 4; ++sample) {
            shared::film_add(pixel, radiance, 0);
        }
    }
    return film;
}

vec3 checkerboard_at(int x, int y) {
    return shared::checkerboard({static_cast<shared::uint>(x), static_cast<shared::uint>(y)});
}

}  // namespace

TEST_CASE("Radiance is shown as tonemap_image has it, by every tone map") {
    NEED_VULKAN();
    Display display(width, height);
    PathRenderer renderer(display.gpu, generated_scene("cornell", layered_settings(Integrator::path)));
    add_samples(renderer, 4);
    const LayeredImage layers = develop(renderer.film());
    for (const ToneMap op :
         {ToneMap::None, ToneMap::Exponential, ToneMap::Uncharted2, ToneMap::Aces, ToneMap::PbrNeutral}) {
        for (const float exposure : {0.0F, 2.5F}) {
            CAPTURE(tonemap_name(op), exposure);
            const Image expected = tonemapped(layers.color, op, exposure);
            const Image shown = display.show({.left = renderer.device_film(), .tonemap = op, .exposure_ev = exposure});
            CHECK(worst(shown, [&](int x, int y) { return color_at(expected, x, y); }) < 1);
        }
    }
    check_no_validation_messages();
}

TEST_CASE("Layers of a film are shown in their colours") {
    NEED_VULKAN();
    Display display(width, height);
    PathRenderer renderer(display.gpu, generated_scene("cornell", layered_settings(Integrator::path)));
    add_samples(renderer, 3);
    const Film film = renderer.film();
    const LayeredImage layers = develop(film);
    const auto layer_color = [](const Image& image, std::size_t i) {
        return vec3(image.data[3 * i], image.data[3 * i + 1], image.data[3 * i + 2]);
    };
    DisplayRequest request{.left = renderer.device_film(), .low = 0.0F, .high = 1.0F};
    const auto check = [&](DisplayLayer layer, float low, float high, const std::function<vec3(std::size_t)>& color) {
        CAPTURE(static_cast<int>(layer));
        request.layer = layer;
        request.low = low;
        request.high = high;
        const Image shown = display.show(request);
        CHECK(worst(shown, [&](int x, int y) { return color(static_cast<std::size_t>(y * width + x)); }) < 1.5F);
    };
    check(DisplayLayer::albedo, 0, 1, [&](std::size_t i) { return shared::srgb_encode(layer_color(*layers.albedo, i)); });
    check(DisplayLayer::normal, 0, 1, [&](std::size_t i) { return 0.5F * layer_color(*layers.normal, i) + 0.5F; });
    check(DisplayLayer::depth, 2, 4,
          [&](std::size_t i) { return shared::ramp_color((layers.depth->data[i] - 2) / 2); });
    check(DisplayLayer::samples, 0, 4,
          [&](std::size_t i) { return shared::ramp_color(static_cast<float>(film.pixels[i].samples) / 4); });
    check(DisplayLayer::nonfinite, 0, 1,
          [&](std::size_t i) { return shared::ramp_color(static_cast<float>(film.pixels[i].nonfinite)); });
    const auto error_of = [&](std::size_t i) {
        const Rgb error = pixel_standard_error(film.pixels[i], film.moments[i]);
        return shared::luminance(
            {static_cast<float>(error[0]), static_cast<float>(error[1]), static_cast<float>(error[2])});
    };
    check(DisplayLayer::standard_error, 0, 0.5F, [&](std::size_t i) { return shared::ramp_color(2 * error_of(i)); });
    request.logarithmic = true;
    check(DisplayLayer::standard_error, 1e-3F, 1,
          [&](std::size_t i) { return shared::ramp_color(1 + std::log10(std::max(error_of(i), 1e-3F)) / 3); });
    check_no_validation_messages();
}

TEST_CASE("Reservoirs are shown as the last frame left them") {
    NEED_VULKAN();
    Display display(width, height);
    RenderSettings settings = layered_settings(Integrator::restir);
    settings.resampling.spatial_passes = GENERATE(1U, 2U);
    PathRenderer renderer(display.gpu, generated_scene("cornell", settings));
    std::vector<shared::Reservoir> last;
    renderer.watch_reservoirs(
        [&](const ResamplingStep&, std::span<const shared::Reservoir> all) { last.assign(all.begin(), all.end()); });
    DisplayRequest request{.low = 0, .high = 20};
    for (std::uint32_t frames = 1; frames < 4; ++frames) {
        CAPTURE(settings.resampling.spatial_passes, frames);
        renderer.restart(frames);
        add_samples(renderer, frames);
        request.left = renderer.device_film();
        const auto at = [&](int x, int y) { return last[static_cast<std::size_t>(y * width + x)]; };
        request.layer = DisplayLayer::light_id;
        CHECK(worst(display.show(request), [&](int x, int y) {
                  return at(x, y).point.light == shared::NONE ? vec3(0) : shared::id_color(at(x, y).point.light);
              }) < 1);
        request.layer = DisplayLayer::reservoir_m;
        CHECK(worst(display.show(request), [&](int x, int y) { return shared::ramp_color(at(x, y).confidence / 20); }) <
              1);
        request.layer = DisplayLayer::reservoir_w;
        CHECK(worst(display.show(request), [&](int x, int y) { return shared::ramp_color(at(x, y).weight / 20); }) < 1);
    }
    check_no_validation_messages();
}

TEST_CASE("A split shows one film on either side of its divider, whatever their sizes") {
    NEED_VULKAN();
    Display display(width, height);
    FilmUploader left(display.gpu);
    FilmUploader right(display.gpu);
    Film columns = plain_film(4, 2, vec3(0));  // each pixel of its own red
    for (std::size_t i = 0; i < columns.pixels.size(); ++i) {
        for (int sample = 0; sample < 4; ++sample) {
            shared::exact_add(columns.pixels[i].sum, vec3(0.1F * static_cast<float>(i), 0, 0));
        }
    }
    DisplayRequest request{.left = left.upload(columns),
                           .right = right.upload(plain_film(width, height, {0, 0.5F, 0})),
                           .tonemap = ToneMap::None};
    for (const std::uint32_t divider : {0U, 1U, 13U, 39U, 40U, ~0U}) {
        CAPTURE(divider);
        request.divider = divider;
        CHECK(worst(display.show(request), [&](int x, int y) {
                  const vec3 shown = x < static_cast<int>(std::min<std::uint32_t>(divider, width))
                                         ? vec3(0.1F * static_cast<float>(x / 10 + 4 * (y / 14)), 0, 0)
                                         : vec3(0, 0.5F, 0);
                  return shared::srgb_encode(shown);
              }) < 1);
    }
    check_no_validation_messages();
}

TEST_CASE("A difference is signed, black where the films agree, and unknown where one is missing") {
    NEED_VULKAN();
    Display display(width, height);
    FilmUploader one(display.gpu);
    FilmUploader other(display.gpu);
    DisplayRequest request{.left = one.upload(plain_film(width, height, vec3(0.5F))),
                           .right = other.upload(plain_film(width, height, vec3(0.2F))),
                           .difference = true,
                           .high = 0.5F};
    CHECK(worst(display.show(request), [](int, int) { return shared::signed_color(0.6F); }) < 1);
    std::swap(request.left, request.right);
    CHECK(worst(display.show(request), [](int, int) { return shared::signed_color(-0.6F); }) < 1);
    request.right = request.left;
    CHECK(worst(display.show(request), [](int, int) { return vec3(0); }) < 1);
    request.right = {};
    CHECK(worst(display.show(request), checkerboard_at) < 1);
    check_no_validation_messages();
}

TEST_CASE("The range of the numbers shown leaves out zeros and the rarest on either side") {
    NEED_VULKAN();
    Display display(width, height);
    FilmUploader uploader(display.gpu);
    Film film = plain_film(width, height, vec3(0));
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        film.pixels[i].samples = i % 4 == 0 ? 0 : i == 1 ? 1 : i == 2 ? 1000000 : i % 2 == 0 ? 20 : 33;
    }
    DisplayRequest request{.left = uploader.upload(film), .layer = DisplayLayer::samples};
    display.show(request);
    REQUIRE(display.range());
    CHECK(display.range()->low == 20);
    CHECK(display.range()->high == 40);
    request.layer = DisplayLayer::nonfinite;  // nothing but zeros
    display.show(request);
    CHECK_FALSE(display.range());
    request.layer = DisplayLayer::radiance;  // no numbers
    display.show(request);
    CHECK_FALSE(display.range());
    request.right = FilmUploader(display.gpu).upload(plain_film(width, height, vec3(1e-3F)));
    request.difference = true;
    display.show(request);
    REQUIRE(display.range());
    CHECK(display.range()->low <= 1e-3F);
    CHECK(display.range()->high > 1e-3F);
    CHECK(display.range()->high <= 1.25F * display.range()->low);
    check_no_validation_messages();
}

TEST_CASE("What no film holds is shown as a checkerboard, and no number as cyan") {
    NEED_VULKAN();
    Display display(width, height);
    FilmUploader uploader(display.gpu);
    DisplayRequest request{.left = {}};
    CHECK(worst(display.show(request), checkerboard_at) < 1);
    request.left = uploader.upload(plain_film(width, height, vec3(0.5F)));
    for (const DisplayLayer layer : {DisplayLayer::albedo, DisplayLayer::normal, DisplayLayer::depth,
                                     DisplayLayer::standard_error, DisplayLayer::light_id, DisplayLayer::reservoir_m}) {
        CAPTURE(static_cast<int>(layer));
        request.layer = layer;
        CHECK(worst(display.show(request), checkerboard_at) < 1);
    }
    Film single = plain_film(width, height, vec3(0.5F));
    single.moments.resize(single.pixels.size());
    for (shared::FilmPixel& pixel : single.pixels) {
        pixel.samples = 1;
    }
    request.left = uploader.upload(single);
    request.layer = DisplayLayer::standard_error;
    CHECK(worst(display.show(request), [](int, int) { return shared::nonfinite_color(); }) < 1);
    check_no_validation_messages();
}

TEST_CASE("A host's film looks as the device's own, and takes the place of the one before it") {
    NEED_VULKAN();
    Display display(width, height);
    PathRenderer renderer(display.gpu, generated_scene("cornell", layered_settings(Integrator::path)));
    FilmUploader uploader(display.gpu);
    std::shared_ptr<const FilmMemory> memory;
    for (std::uint32_t round = 0; round < 2; ++round) {
        renderer.restart(round);
        add_samples(renderer, 2);
        const DeviceFilm copy = uploader.upload(renderer.film());
        CHECK((memory == nullptr || memory == copy.film));
        memory = copy.film;
        for (const DisplayLayer layer : {DisplayLayer::radiance, DisplayLayer::normal, DisplayLayer::standard_error}) {
            const Image own = display.show({.left = renderer.device_film(), .layer = layer});
            const Image copied = display.show({.left = copy, .layer = layer});
            CHECK(own.data == copied.data);
        }
    }
    CHECK(uploader.upload(plain_film(width, height, vec3(1))).film != memory);
    check_no_validation_messages();
}

TEST_CASE("A film in view stays what it was when its renderer goes on to another size") {
    NEED_VULKAN();
    Display display(width, height);
    const Scene scene = generate_scene("cornell").scene;
    RenderSettings settings = layered_settings(Integrator::restir);
    PathRenderer renderer(display.gpu, pack_scene(scene, settings));
    add_samples(renderer, 2);
    const DeviceFilm seen = renderer.device_film();
    const auto show = [&](DisplayLayer layer) { return display.show({.left = seen, .layer = layer}); };
    const Image radiance = show(DisplayLayer::radiance);
    const Image weights = show(DisplayLayer::reservoir_w);
    settings.width = 2 * width;
    renderer.reconfigure(pack_scene(scene, settings));
    add_samples(renderer, 2);
    CHECK(show(DisplayLayer::radiance).data == radiance.data);
    CHECK(show(DisplayLayer::reservoir_w).data == weights.data);
    CHECK(renderer.device_film().film->width == 2 * width);
    check_no_validation_messages();
}

}  // namespace diptych::core::tests
