// A rectangle of pixels.
#pragma once

#include <algorithm>
#include <cstdint>

namespace diptych::core {

/// Columns x to x + width - 1, rows y to y + height - 1; x grows to the right, y downwards.
struct PixelWindow {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;

    bool operator==(const PixelWindow&) const = default;
};

/// The pixels of both windows; width or height is 0 where they share none.
inline PixelWindow intersection(const PixelWindow& a, const PixelWindow& b) {
    const auto overlap = [](int begin_a, int size_a, int begin_b, int size_b, int& begin, int& size) {
        const std::int64_t end = std::min(std::int64_t{begin_a} + size_a, std::int64_t{begin_b} + size_b);
        begin = std::max(begin_a, begin_b);
        size = static_cast<int>(std::max(std::int64_t{0}, end - begin));
    };
    PixelWindow both;
    overlap(a.x, a.width, b.x, b.width, both.x, both.width);
    overlap(a.y, a.height, b.y, b.height, both.y, both.height);
    return both;
}

}  // namespace diptych::core
