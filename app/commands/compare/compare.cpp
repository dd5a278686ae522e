#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "commands/arguments/arguments.h"
#include "commands/command.h"
#include "commands/compare/verdict.h"
#include "error.h"
#include "image/figures.h"
#include "image/image_file.h"
#include "image/metrics.h"
#include "image/picture_name.h"
#include "image/tonemap_image.h"
#include "session/input_files.h"
#include "console/output.h"
#include "console/report.h"

namespace diptych::core::app {

namespace {

constexpr const char* compare_examples = R"(Examples:
  diptych compare picture.exr reference.exr
  diptych compare cpu.exr vulkan.exr -o difference.png
  diptych compare cpu.exr vulkan.exr --max-z 4 --max-relmse 0.01
  diptych compare picture.exr:albedo other.exr:beauty
  diptych compare picture.exr reference.exr --minus picture-0.exr,reference-0.exr
z is the difference of the image means divided by its standard error. EXR files hold the standard errors in a layer.
z has a meaning only if the images were rendered with different seeds.
--minus subtracts one image from A and one from B first. Renders with --max-depth 0 and otherwise equal settings
leave only the scattered light, without the noise of directly visible lamps.
FILE:LAYER selects one layer or part of an EXR. The display windows are compared; of a crop, only the pixels with
data in both files. The PNG shows A, B, and a heatmap of their relative difference.)";

struct CompareOptions {
    std::string a;
    std::string b;
    std::vector<std::string> minus;  // empty, or one for each
    std::string output;
    double exposure = 0;
    std::string tonemap = tonemap_name(default_tonemap);
    std::optional<double> heat_max;
    std::optional<double> max_z;
    std::optional<double> max_relmse;
    std::uint64_t memory_limit = 0;
    bool json = false;
};

/// The value below which 99 % of the finite ones lie, or 1e-6 where that is less.
float automatic_heat(const Image& heat) {
    std::vector<float> values;
    std::copy_if(heat.data.begin(), heat.data.end(), std::back_inserter(values),
                 [](float x) { return std::isfinite(x); });
    if (values.empty()) {
        return 1;
    }
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * 99 / 100);
    std::nth_element(values.begin(), nth, values.end());
    return std::max(*nth, 1e-6F);
}

float write_figure(const CompareOptions& options, const LayeredImage& a, const LayeredImage& b) {
    const ToneMap tonemap = tonemap_from_name(options.tonemap);
    const float exposure = static_cast<float>(options.exposure);
    const Image relative = relative_difference(a.color, b.color);
    const float hot = options.heat_max ? static_cast<float>(*options.heat_max) : automatic_heat(relative);
    write_png(options.output, side_by_side({tonemapped(a.color, tonemap, exposure),
                                            tonemapped(b.color, tonemap, exposure), heatmap(relative, 0, hot)}));
    return hot;
}

/// Why the pictures fail the check that was asked for; empty where they pass.
std::string failure(const CompareOptions& options, const Difference& difference) {
    if ((options.max_z || options.max_relmse) && difference.nonfinite > 0) {
        return fmt::format("{} pixels are not finite", difference.nonfinite);
    }
    const double z = largest_z(difference);
    if (options.max_z && !(z <= *options.max_z)) {
        return std::isnan(z) ? "z is unknown, because some standard errors are unknown"
                             : fmt::format("|z| {:.3g} exceeds {:.3g}", z, *options.max_z);
    }
    if (options.max_relmse && !(difference.relmse <= *options.max_relmse)) {
        return fmt::format("relMSE {:.3g} exceeds {:.3g}", difference.relmse, *options.max_relmse);
    }
    return "";
}

nlohmann::ordered_json to_json(const Difference& difference, const Verdict& verdict, const std::string& why_failed) {
    nlohmann::ordered_json json;
    json["mse"] = difference.mse;
    json["relmse"] = difference.relmse;
    json["relmse_trimmed"] = difference.relmse_trimmed;
    json["trimmed_energy"] = difference.trimmed_energy;
    json["mean_ratio"] = difference.mean_ratio;
    json["z_mean"] = difference.z_mean;
    json["fraction_equal"] = difference.fraction_equal;
    json["nonfinite"] = difference.nonfinite;
    json["noise"] = verdict.noise ? nlohmann::ordered_json(*verdict.noise) : nlohmann::ordered_json();
    json["same_random_numbers"] = verdict.same_random_numbers;
    json["verdict"] = verdict.text;
    json["passed"] = why_failed.empty();
    return json;
}

void print_numbers(const Difference& difference) {
    const auto& ratio = difference.mean_ratio;
    const auto& z = difference.z_mean;
    print_result("MSE {:.4g}  relMSE {:.4g}  mean ratio {:.6f} {:.6f} {:.6f}  z {:.2f} {:.2f} {:.2f}\n", difference.mse,
                 difference.relmse, ratio[0], ratio[1], ratio[2], z[0], z[1], z[2]);
}

LayeredImage read_named(const std::string& text, std::uint64_t memory_limit) {
    const PictureName name = picture_name(text);
    LayeredImage image = read_image(name.file, name.layer, memory_limit);
    if (!image.layer.empty()) {
        report_warning(fmt::format("{}: the colour is its layer '{}'", text, image.layer));
    }
    return image;
}

void require_same_window(const std::string& name, const LayeredImage& image, const std::string& other_name,
                         const LayeredImage& other) {
    const PixelWindow& window = image.display;
    const PixelWindow& wanted = other.display;
    if (window.width != wanted.width || window.height != wanted.height) {
        throw Error(fmt::format("{}: is {}x{}, but {} is {}x{}", name, window.width, window.height, other_name,
                                wanted.width, wanted.height));
    }
    if (window != wanted) {
        throw Error(fmt::format("{}: its display window begins at {},{}, but that of {} at {},{}", name, window.x,
                                window.y, other_name, wanted.x, wanted.y));
    }
}

/// Leaves the pixels of a window in the file's coordinates.
void crop(const PixelWindow& window, LayeredImage& image) {
    const auto cut = [&](Image& layer) {
        Image part = make_image(window.width, window.height, layer.channels);
        const auto row = static_cast<std::ptrdiff_t>(window.width) * layer.channels;
        for (int y = 0; y < window.height; ++y) {
            const float* from = &layer.data[layer.index(window.x - image.display.x, window.y - image.display.y + y, 0)];
            std::copy(from, from + row, &part.data[part.index(0, y, 0)]);
        }
        layer = std::move(part);
    };
    cut(image.color);
    for (std::optional<Image>* layer : {&image.standard_error, &image.albedo, &image.normal, &image.depth}) {
        if (*layer) {
            cut(**layer);
        }
    }
}

/// What the options name, cut to the pixels that all files have data for.
struct Pictures {
    LayeredImage a, b;
    std::vector<LayeredImage> minus;
};

Pictures read_pictures(const CompareOptions& options) {
    Pictures pictures{read_named(options.a, options.memory_limit), read_named(options.b, options.memory_limit), {}};
    require_same_window(options.a, pictures.a, options.b, pictures.b);
    PixelWindow common = intersection(pictures.a.data, pictures.b.data);
    for (const std::string& name : options.minus) {
        pictures.minus.push_back(read_named(name, options.memory_limit));
        require_same_window("--minus " + name, pictures.minus.back(), options.a, pictures.a);
        common = intersection(common, pictures.minus.back().data);
    }
    if (common == pictures.a.display) {
        return pictures;
    }
    if (common.width == 0 || common.height == 0) {
        throw Error(fmt::format("{} and {}: no pixel of their display window has data in both", options.a, options.b));
    }
    report_warning(fmt::format("{} and {}: compared only where both have data: {}x{} pixels from {},{}, of {}x{}",
                               options.a, options.b, common.width, common.height, common.x, common.y,
                               pictures.a.display.width, pictures.a.display.height));
    crop(common, pictures.a);
    crop(common, pictures.b);
    for (LayeredImage& part : pictures.minus) {
        crop(common, part);
    }
    return pictures;
}

/// Standard errors are of the whole, and mean nothing of the rest.
void subtract(const LayeredImage& part, LayeredImage& image) {
    std::transform(image.color.data.begin(), image.color.data.end(), part.color.data.begin(), image.color.data.begin(),
                   std::minus<>());
    image.standard_error.reset();
}

int run_compare(const CompareOptions& options) {
    if (!options.output.empty()) {
        check_writable(options.output);
        if (image_format(options.output) != ImageFormat::Png) {
            throw Error(fmt::format("{}: the figure must be a .png file", options.output));
        }
        std::vector<std::filesystem::path> inputs{picture_name(options.a).file, picture_name(options.b).file};
        for (const std::string& name : options.minus) {
            inputs.push_back(picture_name(name).file);
        }
        refuse_inputs({options.output}, inputs);
    }
    tonemap_from_name(options.tonemap);
    Pictures pictures = read_pictures(options);
    LayeredImage& a = pictures.a;
    LayeredImage& b = pictures.b;
    if (!pictures.minus.empty()) {
        subtract(pictures.minus[0], a);
        subtract(pictures.minus[1], b);
    }
    const Difference difference = compare_images(a, b);
    const Verdict verdict = judge(difference, a, b);
    if (options.max_z && verdict.correlated) {
        throw Error(
            fmt::format("{} and {}: --max-z needs independent pixels, and those of restir are correlated; use verify, "
                        "whose runs are independent",
                        options.a, options.b));
    }
    if (options.max_z && !(a.standard_error && b.standard_error)) {
        throw Error(fmt::format("{}: --max-z needs a layer of standard errors, and there is none",
                                a.standard_error ? options.b : options.a));
    }
    if (verdict.same_random_numbers) {
        report_warning(fmt::format("{} and {}: rendered with the same seed, so their noise is correlated; ignore z",
                                   options.a, options.b));
    }
    if (difference.nonfinite > 0) {
        report_warning(fmt::format("{} and {}: {} pixels that are not finite were left out", options.a, options.b,
                                   difference.nonfinite));
    }
    const std::string why_failed = failure(options, difference);
    const float hot = options.output.empty() ? 0 : write_figure(options, a, b);
    if (options.json) {
        nlohmann::ordered_json json = to_json(difference, verdict, why_failed);
        if (!options.output.empty()) {
            json["output"] = options.output;
            json["heat_max"] = hot;
        }
        print_json(json);
    } else {
        print_numbers(difference);
        print_result("{}\n", verdict.text);
        if (!options.output.empty()) {
            print_result("{}: A, B and their relative difference from 0 (black) to {:.3g} (yellow)\n", options.output,
                         hot);
        }
    }
    if (!why_failed.empty()) {
        report_error(fmt::format("{} against {}: {}", options.a, options.b, why_failed));
        return exit_check_failed;
    }
    return exit_done;
}

}  // namespace

void add_compare(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("compare", "Measure how much two images differ, and whether that is noise");
    auto options = std::make_shared<CompareOptions>();
    command->add_option("a", options->a, "First image")->required();
    command->add_option("b", options->b, "Second image, the reference")->required();
    command->add_option("--minus", options->minus,
                        "Two images to subtract before the comparison, one from A and one from B")
        ->delimiter(',')
        ->expected(2);
    command->add_option("-o,--output", options->output,
                        "Figure to write (.png): A, B and a heatmap of their relative difference");
    add_display_options(*command, options->exposure, options->tonemap, "for the figure");
    command->add_option("--heat-max", options->heat_max,
                        "Relative difference at the hot end of the heatmap; default: its 99th percentile")
        ->check(positive_number());
    command->add_option("--max-z", options->max_z, "Exit code 1 if |z| of a channel exceeds this value")
        ->check(non_negative_number());
    command->add_option("--max-relmse", options->max_relmse, "Exit code 1 if the relMSE exceeds this value")
        ->check(non_negative_number());
    add_memory_option(*command, options->memory_limit);
    command->add_flag("--json", options->json, "Print the results as JSON");
    command->footer(compare_examples);
    command->callback([options, &run] { run = [options] { return run_compare(*options); }; });
}

}  // namespace diptych::core::app
