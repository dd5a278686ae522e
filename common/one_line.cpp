#include "one_line.h"

#include <algorithm>

namespace diptych::core {

std::string one_line(std::string text) {
    constexpr unsigned char erase = 0x7f;
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == erase; }, ' ');
    while (!text.empty() && text.back() == ' ') {
        text.pop_back();
    }
    return text;
}

}  // namespace diptych::core
