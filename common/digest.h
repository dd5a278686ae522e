// A name for bytes: equal bytes have equal names, and different ones almost never.
#pragma once

#include <cstdint>
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

}  // namespace diptych::core
