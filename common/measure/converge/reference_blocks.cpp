#include "measure/converge/reference_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "error.h"
#include "image/image_file.h"
#include "measure/converge/checked_file.h"
#include "render/film_statistics.h"
#include "render/metadata.h"

namespace diptych::core {

namespace {

namespace fs = std::filesystem;

/// Sums over the blocks so far.
struct Blocks {
    std::uint32_t count = 0;
    std::vector<double> sum;
    std::vector<double> squares;

    void add(const Film& film) {
        sum.resize(3 * film.pixels.size());
        squares.resize(sum.size());
        for (std::size_t i = 0; i < film.pixels.size(); ++i) {
            const Rgb mean = pixel_mean(film.pixels[i]);
            for (std::size_t channel = 0; channel < 3; ++channel) {
                sum[3 * i + channel] += mean[channel];
                squares[3 * i + channel] += mean[channel] * mean[channel];
            }
        }
        ++count;
    }
};

void save(const std::string& path, const Blocks& blocks) {
    std::string bytes(sizeof(std::uint64_t), '\0');
    const std::uint64_t count = blocks.count;
    std::copy_n(reinterpret_cast<const char*>(&count), sizeof count, bytes.data());
    for (const std::vector<double>* values : {&blocks.sum, &blocks.squares}) {
        bytes.append(reinterpret_cast<const char*>(values->data()), values->size() * sizeof(double));
    }
    write_checked_file(path, bytes);
}

Blocks load(const std::string& path, std::size_t values) {
    Blocks blocks;
    const std::optional<std::string> bytes = read_checked_file(path);
    if (!bytes) {
        return blocks;
    }
    ByteReader file(*bytes);
    std::uint64_t count = 0;
    if (!file.take(count) || count > reference_blocks || !file.take(blocks.sum, values) ||
        !file.take(blocks.squares, values) || file.left() > 0) {
        fail_as_damaged(path);
    }
    blocks.count = static_cast<std::uint32_t>(count);
    return blocks;
}

LayeredImage picture_of(const Blocks& blocks, int width, int height) {
    LayeredImage image;
    image.color = make_image(width, height, 3);
    image.standard_error = make_image(width, height, 3);
    const double n = blocks.count;
    for (std::size_t i = 0; i < blocks.sum.size(); ++i) {
        const double mean = blocks.sum[i] / n;
        const double variance = std::max(0.0, blocks.squares[i] - n * mean * mean) / (n - 1);
        image.color.data[i] = static_cast<float>(mean);
        image.standard_error->data[i] = static_cast<float>(std::sqrt(variance / n));
    }
    return image;
}

}  // namespace

std::optional<ReferencePicture> render_reference(MethodRunner& runner, std::uint32_t spp, const PictureMaker& maker,
                                                 ConvergeState& state, const std::atomic<bool>& cancel,
                                                 const std::function<void(std::uint32_t)>& begin_block) {
    const Method& method = runner.method();
    const RenderSettings& settings = method.request.settings;
    const std::string path = state.path("reference.exr"), partial = state.path("reference.blocks");
    if (state.reference() && fs::exists(path)) {
        return reference_of(read_image(path), method.name);
    }
    Blocks blocks =
        load(partial, 3 * static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height));
    double seconds = 0;
    while (blocks.count < reference_blocks) {
        begin_block(blocks.count);
        const bool whole = runner.run(method.seed_of(blocks.count), {spp}, cancel,
                                      [&](std::uint32_t, const Film& film, double device_seconds, double) {
                                          blocks.add(film);
                                          seconds += device_seconds;
                                      });
        if (!whole) {
            return std::nullopt;
        }
        save(partial, blocks);
    }
    LayeredImage image = picture_of(blocks, settings.width, settings.height);
    RenderRequest request = method.request;
    request.output = "reference.exr";
    RenderOutcome outcome;
    outcome.maker = maker;
    outcome.device = runner.device();
    outcome.spp = spp * reference_blocks;
    outcome.seconds = seconds;
    image.metadata = render_metadata(request, outcome);
    image.metadata["blocks"] = std::to_string(reference_blocks);
    // Each block has its own seed, so no single render has these bits: this one has their expectation and, about, their
    // noise.
    write_exr(path, image);
    state.set_reference({method.name, runner.device(), outcome.spp, reference_blocks, seconds});
    fs::remove(partial);
    return reference_of(std::move(image), method.name);
}

}  // namespace diptych::core
