// From linear radiance to what a display shows, over the shared tone maps.
#pragma once

#include <cstdint>
#include <string_view>

#include "image/image.h"

namespace diptych::core {

/// The values are those of the shared header.
enum class ToneMap : uint32_t { None = 0, Exponential = 1, Uncharted2 = 2, Aces = 3, PbrNeutral = 4 };

/// Of every picture and view that asks for no other. It keeps the colours of what is no brighter than white paper.
inline constexpr ToneMap default_tonemap = ToneMap::PbrNeutral;

/// none, exponential, uncharted2, aces or pbr-neutral; anything else is an Error that lists them.
ToneMap tonemap_from_name(std::string_view name);
const char* tonemap_name(ToneMap op);

/// Linear RGB times 2^exposure_ev, tone mapped, sRGB encoded: display values, for write_png. Same shape.
Image tonemapped(const Image& linear_rgb, ToneMap op, float exposure_ev);

}  // namespace diptych::core
