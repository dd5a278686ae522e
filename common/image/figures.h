// Pictures about pictures: heatmaps and panels, in display values for write_png.
#pragma once

#include <vector>

#include "image/image.h"

namespace diptych::core {

/// One channel: per pixel sqrt(mean over the channels of (a-b)^2 / (b^2 + 1e-2)), the root of the pixel's share of
/// relMSE. Not finite where a or b is not. Throws an Error for different shapes.
Image relative_difference(const Image& a, const Image& b);

/// Display RGB of a one-channel image: black at `lo` and below, through magenta to pale yellow at `hi` and above (the
/// map 'magma' of matplotlib; S. van der Walt, N. Smith, github.com/BIDS/colormap, CC0); cyan where not finite.
Image heatmap(const Image& scalar, float lo, float hi);

/// The panels from left to right, with `gap` white columns between them. Throws an Error unless they share height and
/// channels.
Image side_by_side(const std::vector<Image>& panels, int gap = 4);

}  // namespace diptych::core
