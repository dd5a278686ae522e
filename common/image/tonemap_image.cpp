#include "image/tonemap_image.h"

#include <cmath>
#include <string>

#include "error.h"
#include "threads.h"
#include "film/tonemap.h"

namespace diptych::core {
namespace {

struct Name {
    const char* text;
    ToneMap op;
};

constexpr Name names[] = {
    {"none", ToneMap::None}, {"exponential", ToneMap::Exponential}, {"uncharted2", ToneMap::Uncharted2},
    {"aces", ToneMap::Aces}, {"pbr-neutral", ToneMap::PbrNeutral},
};

static_assert(static_cast<uint32_t>(ToneMap::None) == shared::TONEMAP_NONE);
static_assert(static_cast<uint32_t>(ToneMap::Exponential) == shared::TONEMAP_EXPONENTIAL);
static_assert(static_cast<uint32_t>(ToneMap::Uncharted2) == shared::TONEMAP_UNCHARTED2);
static_assert(static_cast<uint32_t>(ToneMap::Aces) == shared::TONEMAP_ACES);
static_assert(static_cast<uint32_t>(ToneMap::PbrNeutral) == shared::TONEMAP_PBR_NEUTRAL);

}  // namespace

ToneMap tonemap_from_name(std::string_view name) {
    std::string known;
    for (const Name& candidate : names) {
        if (name == candidate.text) {
            return candidate.op;
        }
        known += (known.empty() ? "" : ", ") + std::string(candidate.text);
    }
    throw Error("unknown tone map '" + std::string(name) + "' (known: " + known + ")");
}

const char* tonemap_name(ToneMap op) {
    for (const Name& candidate : names) {
        if (op == candidate.op) {
            return candidate.text;
        }
    }
    return "unknown";
}

Image tonemapped(const Image& linear_rgb, ToneMap op, float exposure_ev) {
    if (linear_rgb.channels != 3) {
        throw Error("a tone map needs 3 channels, the image has " + std::to_string(linear_rgb.channels));
    }
    const float exposure = std::exp2(exposure_ev);
    Image display = linear_rgb;
    in_parts(display.pixel_count(), [&](size_t begin, size_t end) {
        for (size_t i = 3 * begin; i < 3 * end; i += 3) {
            const shared::vec3 radiance(display.data[i] * exposure, display.data[i + 1] * exposure,
                                        display.data[i + 2] * exposure);
            const shared::vec3 mapped = shared::tonemap(static_cast<uint32_t>(op), radiance);
            const shared::vec3 encoded = shared::srgb_encode(mapped);
            display.data[i] = encoded.x;
            display.data[i + 1] = encoded.y;
            display.data[i + 2] = encoded.z;
        }
    });
    return display;
}

}  // namespace diptych::core
