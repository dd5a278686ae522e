#include "image/raster_text.h"

#include <algorithm>
#include <array>

namespace diptych::core {

namespace {

constexpr int columns = 3;
constexpr int rows = 5;

struct Glyph {
    char character;
    std::array<const char*, rows> pattern;
};

constexpr std::array glyphs = {
    Glyph{'0', {"###", "# #", "# #", "# #", "###"}}, Glyph{'1', {" # ", "## ", " # ", " # ", "###"}},
    Glyph{'2', {"###", "  #", "###", "#  ", "###"}}, Glyph{'3', {"###", "  #", "###", "  #", "###"}},
    Glyph{'4', {"# #", "# #", "###", "  #", "  #"}}, Glyph{'5', {"###", "#  ", "###", "  #", "###"}},
    Glyph{'6', {"###", "#  ", "###", "# #", "###"}}, Glyph{'7', {"###", "  #", "  #", " # ", " # "}},
    Glyph{'8', {"###", "# #", "###", "# #", "###"}}, Glyph{'9', {"###", "# #", "###", "  #", "###"}},
    Glyph{'.', {"   ", "   ", "   ", "   ", " # "}}, Glyph{'-', {"   ", "   ", "###", "   ", "   "}},
    Glyph{'/', {"  #", "  #", " # ", "#  ", "#  "}}, Glyph{'%', {"# #", "  #", " # ", "#  ", "# #"}},
    Glyph{'=', {"   ", "###", "   ", "###", "   "}}, Glyph{'a', {"   ", "## ", " ##", "# #", "###"}},
    Glyph{'b', {"#  ", "#  ", "###", "# #", "###"}}, Glyph{'c', {"   ", "   ", "###", "#  ", "###"}},
    Glyph{'d', {"  #", "  #", "###", "# #", "###"}}, Glyph{'e', {"   ", "###", "###", "#  ", "###"}},
    Glyph{'f', {" ##", " # ", "###", " # ", " # "}}, Glyph{'g', {"   ", " ##", "# #", " ##", "## "}},
    Glyph{'h', {"#  ", "#  ", "###", "# #", "# #"}}, Glyph{'i', {" # ", "   ", " # ", " # ", " # "}},
    Glyph{'j', {"  #", "   ", "  #", "  #", "## "}}, Glyph{'k', {"#  ", "# #", "## ", "## ", "# #"}},
    Glyph{'l', {" # ", " # ", " # ", " # ", " ##"}}, Glyph{'m', {"   ", "   ", "###", "###", "# #"}},
    Glyph{'n', {"   ", "   ", "## ", "# #", "# #"}}, Glyph{'o', {"   ", "   ", "###", "# #", "###"}},
    Glyph{'p', {"   ", "###", "# #", "###", "#  "}}, Glyph{'q', {"   ", "###", "# #", "###", "  #"}},
    Glyph{'r', {"   ", "   ", "###", "#  ", "#  "}}, Glyph{'s', {"   ", " ##", "#  ", "  #", "## "}},
    Glyph{'t', {" # ", "###", " # ", " # ", " ##"}}, Glyph{'u', {"   ", "   ", "# #", "# #", "###"}},
    Glyph{'v', {"   ", "   ", "# #", "# #", " # "}}, Glyph{'w', {"   ", "   ", "# #", "###", "###"}},
    Glyph{'x', {"   ", "   ", "# #", " # ", "# #"}}, Glyph{'y', {"   ", "# #", "###", "  #", "## "}},
    Glyph{'z', {"   ", "###", " ##", "## ", "###"}},
};

}  // namespace

int text_width(std::string_view text, int scale) {
    return text.empty() ? 0 : (static_cast<int>(text.size()) * (columns + 1) - 1) * scale;
}

void draw_rectangle(Image& image, int x, int y, int width, int height, float shade) {
    for (int row = std::max(y, 0); row < std::min(y + height, image.height); ++row) {
        for (int column = std::max(x, 0); column < std::min(x + width, image.width); ++column) {
            for (int channel = 0; channel < image.channels; ++channel) {
                image.at(column, row, channel) = shade;
            }
        }
    }
}

void draw_text(Image& image, int x, int y, std::string_view text, int scale, float shade) {
    for (const char character : text) {
        const auto glyph = std::find_if(glyphs.begin(), glyphs.end(),
                                        [&](const Glyph& candidate) { return candidate.character == character; });
        for (int row = 0; glyph != glyphs.end() && row < rows; ++row) {
            for (int column = 0; column < columns; ++column) {
                if (glyph->pattern[static_cast<std::size_t>(row)][column] == '#') {
                    draw_rectangle(image, x + column * scale, y + row * scale, scale, scale, shade);
                }
            }
        }
        x += (columns + 1) * scale;
    }
}

}  // namespace diptych::core
