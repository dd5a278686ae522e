// A name for bytes: equal bytes have equal names, and different ones almost never.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace diptych::core {

/// FNV-1a, 64 bits (Fowler, Noll, Vo); `hash` is that of the bytes before.
inline std::uint64_t digest_of(std::span<const unsigned char> bytes, std::uint64_t hash = 0xcbf29ce484222325U) {
    for (const unsigned char byte : bytes) {
        hash = (hash ^ byte) * 0x100000001b3U;
    }
    return hash;
}

/// The same step for a word at a time, which gives another digest.
inline std::uint64_t digest_with_word(std::uint64_t hash, std::uint32_t word) {
    return (hash ^ word) * 0x100000001b3U;
}

/// A quick one for gigabytes: four digests of every fourth word of 64 bits, and the digest of these. The rotation lets
/// the highest bit of a word reach the others, which a product alone does not.
inline std::uint64_t digest_of_many(std::span<const unsigned char> bytes) {
    constexpr std::size_t lanes = 4, word = sizeof(std::uint64_t);
    std::uint64_t hashes[lanes] = {1, 2, 3, 4};
    std::size_t at = 0;
    for (; at + lanes * word <= bytes.size(); at += lanes * word) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            std::uint64_t value = 0;
            std::memcpy(&value, &bytes[at + lane * word], word);
            hashes[lane] = std::rotl(hashes[lane] ^ value, 29) * 0x100000001b3U;
        }
    }
    const std::uint64_t rest = digest_of(bytes.subspan(at));
    return digest_of({reinterpret_cast<const unsigned char*>(hashes), sizeof hashes}, rest);
}

}  // namespace diptych::core
