// Channels of an EXR file that hold words of 32 bits beside the picture. Earlier versions wrote the sums of films so.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace diptych::core {

/// What the names of such channels begin with.
inline constexpr const char* word_prefix = "sums.";

/// The string attribute of the file that holds words_digest.
inline constexpr const char* word_digest_attribute = "diptych:sums_digest";

/// One uint channel for each name; `data` is row-major from the top, channels interleaved.
struct WordChannels {
    int width = 0;
    int height = 0;
    std::vector<std::string> names;  // without word_prefix
    std::vector<std::uint32_t> data;
};

/// In hexadecimal. Files have an order of channels of their own, which makes no difference.
std::string words_digest(const WordChannels& words);

}  // namespace diptych::core
