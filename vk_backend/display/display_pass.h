// From films to the picture in the window: a compute shader that reads up to two films and writes display values.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "renderer/device_film.h"
#include "image/image.h"
#include "image/tonemap_image.h"

namespace diptych::core {

/// Values as in shaders/display.h.
enum class DisplayLayer : std::uint32_t {
    radiance = 0,
    albedo = 1,
    normal = 2,
    depth = 3,           // metres
    standard_error = 4,  // of the mean's luminance
    samples = 5,
    nonfinite = 6,  // number of dropped samples
    light_id = 7,   // of the light of the reservoir's light point
    reservoir_m = 8,
    reservoir_w = 9,
};

/// Whether a layer is one number per pixel, shown by a colour ramp from `low` to `high`.
bool is_scalar(DisplayLayer layer);

/// The request of one picture. Films may have any size; each is stretched over the whole picture, by nearest pixel.
struct DisplayRequest {
    DeviceFilm left = {};
    DeviceFilm right = {};
    std::uint32_t divider = ~0U;  // first column of the picture that shows `right`
    bool difference = false;      // left - right: blue below zero, red above; `high` is full colour
    DisplayLayer layer = DisplayLayer::radiance;
    ToneMap tonemap = ToneMap::Aces;  // for radiance, as is the exposure
    float exposure_ev = 0;
    float low = 0;             // lower end of a scalar layer's colour ramp
    float high = 1;            // upper end; above `low`
    bool logarithmic = false;  // the ramp is logarithmic; `low` must be positive
};

struct DisplayPass {
    vk::raii::DescriptorSetLayout set = nullptr;
    vk::raii::PipelineLayout layout = nullptr;
    vk::raii::Pipeline pipeline = nullptr;
};

DisplayPass make_display_pass(const Gpu& gpu);

/// R8G8B8A8 display values (sRGB encoded), top row first, for a fragment shader to sample in layout
/// eShaderReadOnlyOptimal.
struct DisplayPicture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    Allocation memory;
    vk::raii::Image image = nullptr;
    vk::raii::ImageView view = nullptr;
    Buffer histogram;   // of a scalar layer's values; the pass counts in it
    Buffer histograms;  // host copies of finished histograms, one per slot
    vk::raii::DescriptorPool pool = nullptr;
    vk::DescriptorSet set;  // of the pass; owned by the pool
};

/// The picture must outlive the frames in flight that show it. Throws Error if memory runs out.
DisplayPicture make_display_picture(const Gpu& gpu, const DisplayPass& pass, std::uint32_t width, std::uint32_t height);

constexpr std::uint32_t display_slots = 2;  // frames in flight

/// Records the display pass between barriers of its own: after rendering in earlier submissions, before fragment
/// shaders. The films of the request must outlive the commands. Frames in flight at the same time use different slots.
void record_display(const vk::raii::CommandBuffer& commands, const DisplayPass& pass, const DisplayPicture& picture,
                    const DisplayRequest& request, std::uint32_t slot = 0);

struct DisplayRange {
    float low = 0;
    float high = 0;
};

/// The range of the values that the slot's last frame showed, for a scalar layer or a difference: 1st and 99th
/// percentile of the magnitudes that are not 0, rounded outward to a quarter octave. Nothing if there were no such
/// values or no frame yet. That frame must have ended.
std::optional<DisplayRange> shown_range(const DisplayPicture& picture, std::uint32_t slot = 0);

/// Display values in [0, 1], 3 channels, for write_png. The picture must have been recorded and submitted.
Image read_display(const Gpu& gpu, const DisplayPicture& picture);

}  // namespace diptych::core
