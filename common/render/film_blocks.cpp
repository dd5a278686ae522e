#include "render/film_blocks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <stdexcept>

namespace diptych::core {

namespace {

using Word = std::uint32_t;

/// How a block stores one word of its pixels: `count` bytes of each pixel's, from byte `first` on. The others are those
/// of `base`, which is 0 or the first pixel's word. In a file it is one byte.
struct StoredWord {
    unsigned first = 0;
    unsigned count = 0;
    bool has_base = false;

    std::size_t bytes(std::size_t pixels) const { return count * pixels + (has_base ? sizeof(Word) : 0); }
    unsigned char code() const { return static_cast<unsigned char>(first | count << 2U | (has_base ? 32U : 0U)); }
};

StoredWord stored_word(unsigned char code) {
    const StoredWord word{code & 3U, (code >> 2U) & 7U, (code & 32U) != 0};
    if (code > 63 || word.first + word.count > sizeof(Word)) {
        throw std::runtime_error("a block of its film is damaged");
    }
    return word;
}

/// The bytes in which any bit of `bits` is set.
StoredWord varying_bytes(Word bits, bool has_base) {
    if (bits == 0) {
        return {0, 0, has_base};
    }
    const auto first = static_cast<unsigned>(std::countr_zero(bits)) / 8;
    const auto last = static_cast<unsigned>(31 - std::countl_zero(bits)) / 8;
    return {first, last - first + 1, has_base};
}

template <std::size_t words>
unsigned char* pack_block(const Word* from, std::size_t pixels, unsigned char* to) {
    std::array<Word, words> set{};
    std::array<Word, words> varying{};
    for (std::size_t i = 0; i < pixels; ++i) {
        for (std::size_t k = 0; k < words; ++k) {
            set[k] |= from[i * words + k];
            varying[k] |= from[i * words + k] ^ from[k];
        }
    }
    unsigned char* codes = to;
    to += words;
    for (std::size_t k = 0; k < words; ++k) {
        const StoredWord plain = varying_bytes(set[k], false);
        const StoredWord based = varying_bytes(varying[k], true);
        const StoredWord& stored = based.bytes(pixels) < plain.bytes(pixels) ? based : plain;
        *codes++ = stored.code();
        const Word base = stored.has_base ? from[k] : 0;
        if (stored.has_base) {
            std::memcpy(to, &base, sizeof base);
            to += sizeof base;
        }
        if (stored.count == 0) {
            continue;
        }
        std::array<Word, block_pixels> column;
        for (std::size_t i = 0; i < pixels; ++i) {
            column[i] = (from[i * words + k] ^ base) >> (8 * stored.first);
        }
        for (unsigned byte = 0; byte < stored.count; ++byte, to += pixels) {
            for (std::size_t i = 0; i < pixels; ++i) {
                to[i] = static_cast<unsigned char>(column[i] >> (8 * byte));
            }
        }
    }
    return to;
}

template <std::size_t words>
std::span<const unsigned char> unpack_block(std::span<const unsigned char> from, std::size_t pixels, Word* to) {
    const auto take = [&](std::size_t count) {
        if (from.size() < count) {
            throw std::runtime_error("a block of its film ends early");
        }
        const std::span<const unsigned char> taken = from.first(count);
        from = from.subspan(count);
        return taken;
    };
    const std::span<const unsigned char> codes = take(words);
    for (std::size_t k = 0; k < words; ++k) {
        const StoredWord stored = stored_word(codes[k]);
        Word base = 0;
        if (stored.has_base) {
            std::memcpy(&base, take(sizeof base).data(), sizeof base);
        }
        const std::span<const unsigned char> bytes = take(stored.count * pixels);
        for (std::size_t i = 0; i < pixels; ++i) {
            Word word = 0;
            for (unsigned byte = 0; byte < stored.count; ++byte) {
                word |= Word{bytes[byte * pixels + i]} << (8 * (stored.first + byte));
            }
            to[i * words + k] = word ^ base;
        }
    }
    return from;
}

template <class Struct>
inline constexpr std::size_t words_in = sizeof(Struct) / sizeof(Word);

/// Calls `each` with the array of each kind of struct that the film has; a struct is words alone.
template <class AnyFilm, class Each>
void for_arrays(AnyFilm& film, const Each& each) {
    each(film.pixels);
    if (!film.moments.empty()) {
        each(film.moments);
    }
    if (!film.first_hits.empty()) {
        each(film.first_hits);
    }
}

template <class Array>
inline constexpr std::size_t words_of_array = words_in<typename std::remove_cvref_t<Array>::value_type>;

}  // namespace

std::size_t most_packed_bytes(const Film& film, std::size_t pixels) {
    std::size_t bytes = least_packed_bytes(film, pixels);
    for_arrays(film, [&](const auto& array) { bytes += words_of_array<decltype(array)> * sizeof(Word) * pixels; });
    return bytes;  // a base is stored only where it takes fewer bytes
}

std::size_t least_packed_bytes(const Film& film, std::size_t pixels) {
    std::size_t words = 0;
    for_arrays(film, [&](const auto& array) { words += words_of_array<decltype(array)>; });
    return words * ((pixels + block_pixels - 1) / block_pixels);
}

std::size_t pack_pixels(const Film& film, std::size_t first, std::size_t count, std::span<unsigned char> bytes) {
    unsigned char* to = bytes.data();
    for (std::size_t done = 0; done < count; done += block_pixels) {
        const std::size_t pixels = std::min(block_pixels, count - done);
        for_arrays(film, [&](const auto& array) {
            to = pack_block<words_of_array<decltype(array)>>(reinterpret_cast<const Word*>(&array[first + done]), pixels, to);
        });
    }
    return static_cast<std::size_t>(to - bytes.data());
}

void unpack_pixels(std::span<const unsigned char> bytes, std::size_t first, std::size_t count, Film& film) {
    for (std::size_t done = 0; done < count; done += block_pixels) {
        const std::size_t pixels = std::min(block_pixels, count - done);
        for_arrays(film, [&](auto& array) {
            bytes = unpack_block<words_of_array<decltype(array)>>(bytes, pixels,
                                                                  reinterpret_cast<Word*>(&array[first + done]));
        });
    }
    if (!bytes.empty()) {
        throw std::runtime_error("a block of its film is too long");
    }
}

}  // namespace diptych::core
