#include "image/word_channels.h"

#include <fmt/format.h>

#include <numeric>

#include "digest.h"

namespace diptych::core {

std::string words_digest(const WordChannels& words) {
    std::vector<std::uint64_t> hashes;
    for (const std::string& name : words.names) {
        hashes.push_back(digest_of({reinterpret_cast<const unsigned char*>(name.data()), name.size()}));
    }
    for (std::size_t i = 0; i < words.data.size();) {
        for (std::uint64_t& hash : hashes) {
            hash = digest_with_word(hash, words.data[i++]);
        }
    }
    return fmt::format("{:016x}", std::accumulate(hashes.begin(), hashes.end(), std::uint64_t{0}));
}

}  // namespace diptych::core
