#include "measure/converge/picture.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "image/image_file.h"
#include "image/metrics.h"
#include "render/metadata.h"

namespace diptych::core {

bool render_picture(MethodRunner& runner, double seconds, const ReferencePicture& reference, const PictureMaker& maker,
                    ConvergeState& state, const std::atomic<bool>& cancel) {
    const Method& method = runner.method();
    const std::string stem = file_stem(method.name);
    const std::string path = state.path("pictures/" + stem + ".exr");
    const std::optional<MethodPicture> known = state.picture(method.name);
    if (known && known->wanted_seconds == seconds && std::filesystem::exists(path)) {
        return true;
    }
    const ErrorRow* last = nullptr;
    for (const ErrorRow& row : state.rows()) {
        last = row.method == method.name ? &row : last;
    }
    const double sample_seconds = last->device_seconds / last->spp;
    const auto spp =
        static_cast<std::uint32_t>(std::clamp(std::round(seconds / std::max(sample_seconds, 1e-12)), 1.0, 1e9));
    std::filesystem::create_directories(state.path("pictures"));
    return runner.run(method.picture_seed, {spp}, cancel,
                      [&](std::uint32_t, const Film& film, double device_seconds, double) {
                          LayeredImage image = develop(film);
                          const Difference difference = compare_images(image, reference.image);
                          RenderRequest request = method.request;
                          request.output = stem + ".exr";
                          request.settings.sample_count = spp;
                          request.settings.seed = method.picture_seed;
                          RenderOutcome outcome;
                          outcome.maker = maker;
                          outcome.device = runner.device();
                          outcome.spp = spp;
                          outcome.seconds = device_seconds;
                          image.metadata = render_metadata(request, outcome);
                          write_exr(path, image);
                          state.set_picture(method.name, {seconds, spp, device_seconds, difference.relmse,
                                                          maker.command ? maker.command(request, spp) : ""});
                      });
}

}  // namespace diptych::core
