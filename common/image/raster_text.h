// Small print on figures.
#pragma once

#include <string_view>

#include "image/image.h"

namespace diptych::core {

/// Width in pixels of a text at that scale; its height is 5 * scale.
int text_width(std::string_view text, int scale);

/// Draws digits, small letters, space and . - / % = in cells of 3 x 5 squares of `scale` pixels with their top left
/// corner at x, y, in grey `shade` on all channels. What lies outside the image is cut off; other characters are left
/// blank.
void draw_text(Image& image, int x, int y, std::string_view text, int scale, float shade);

/// A filled rectangle, cut off at the image's edges.
void draw_rectangle(Image& image, int x, int y, int width, int height, float shade);

}  // namespace diptych::core
