// From films to the picture in the window: a compute shader that reads up to two films and writes display values.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "renderer/device_film.h"
#include "image/image.h"
#include "image/tonemap_image.h"

namespace diptych::core {

/// The values are those of shaders/display.h.
enum class DisplayLayer : std::uint32_t {
    radiance = 0,
    albedo = 1,
    normal = 2,
    depth = 3,           // metres
    standard_error = 4,  // of the mean's luminance
    samples = 5,
    nonfinite = 6,  // samples dropped
    light_id = 7,   // of the point that the reservoir holds
    reservoir_m = 8,
    reservoir_w = 9,
};

/// Whether a layer is one number a pixel, shown by a colour ramp between `low` and `high`.
bool is_scalar(DisplayLayer layer);

/// What is to be seen. Films may be of any size; each is stretched over the whole picture, pixel by nearest pixel.
struct DisplayRequest {
    DeviceFilm left = {};
    DeviceFilm right = {};
    std::uint32_t divider = ~0U;  // column of the picture from which on `right` is seen
    bool difference = false;      // left - right instead of either: blue below zero, red above; `high` is full colour
    DisplayLayer layer = DisplayLayer::radiance;
    ToneMap tonemap = ToneMap::Aces;  // of radiance, as the exposure
    float exposure_ev = 0;
    float low = 0;             // of a scalar layer's ramp
    float high = 1;            // likewise; above `low`
    bool logarithmic = false;  // the ramp goes by the logarithm; `low` is above 0
};

struct DisplayPass {
    vk::raii::DescriptorSetLayout set = nullptr;
    vk::raii::PipelineLayout layout = nullptr;
    vk::raii::Pipeline pipeline = nullptr;
};

DisplayPass make_display_pass(const Gpu& gpu);

/// R8G8B8A8 of display values (sRGB encoded), from the top; for sampling in a fragment shader, in layout
/// eShaderReadOnlyOptimal.
struct DisplayPicture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    vk::raii::DeviceMemory memory = nullptr;
    vk::raii::Image image = nullptr;
    vk::raii::ImageView view = nullptr;
    Buffer histogram;   // of a scalar layer's numbers, as it is counted
    Buffer histograms;  // counted, for the host, one a slot
    vk::raii::DescriptorPool pool = nullptr;
    vk::DescriptorSet set;  // the pool's, for the pass
};

/// Must outlive the frames in flight that show it. Throws Error where memory runs out.
DisplayPicture make_display_picture(const Gpu& gpu, const DisplayPass& pass, std::uint32_t width, std::uint32_t height);

constexpr std::uint32_t display_slots = 2;  // frames in flight

/// Between barriers of its own, for what renders in earlier submissions and for fragment shaders later on. The
/// request's films must outlive the commands. Frames in flight at the same time have slots of their own.
void record_display(const vk::raii::CommandBuffer& commands, const DisplayPass& pass, const DisplayPicture& picture,
                    const DisplayRequest& request, std::uint32_t slot = 0);

struct DisplayRange {
    float low = 0;
    float high = 0;
};

/// Where the numbers of the scalar layer or of the difference lay that the slot's last frame showed: 1st and 99th
/// percentile of the sizes of those that are not 0, to a quarter octave outwards. None where there were none, or no
/// frame yet. That frame has ended.
std::optional<DisplayRange> shown_range(const DisplayPicture& picture, std::uint32_t slot = 0);

/// Display values in [0, 1], 3 channels, for write_png. The picture has been recorded and submitted.
Image read_display(const Gpu& gpu, const DisplayPicture& picture);

}  // namespace diptych::core
