// Values as the words of a message.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/sample_ranges.h"

namespace diptych::core {

class WordWriter {
public:
    WordWriter& put(std::uint64_t value) {
        words_.push_back(static_cast<std::uint32_t>(value));
        words_.push_back(static_cast<std::uint32_t>(value >> 32U));
        return *this;
    }
    WordWriter& put(double value) { return put(std::bit_cast<std::uint64_t>(value)); }
    WordWriter& put(const SampleRange& range) { return put(range.first).put(range.end); }
    WordWriter& put(const std::string& text) {
        put(std::uint64_t{text.size()});
        for (const char c : text) {
            words_.push_back(static_cast<unsigned char>(c));
        }
        return *this;
    }
    template <class Struct>
    WordWriter& put_structs(std::span<const Struct> structs) {
        static_assert(sizeof(Struct) % sizeof(std::uint32_t) == 0);
        const auto* const first = reinterpret_cast<const std::uint32_t*>(structs.data());
        words_.insert(words_.end(), first, first + structs.size_bytes() / sizeof(std::uint32_t));
        return *this;
    }
    std::vector<std::uint32_t> take() { return std::move(words_); }

private:
    std::vector<std::uint32_t> words_;
};

/// Reads in the same order. Throws std::runtime_error where the message is too short.
class WordReader {
public:
    explicit WordReader(std::span<const std::uint32_t> words) : words_(words) {}

    std::uint64_t number() {
        const auto two = take(2);
        return two[0] | std::uint64_t{two[1]} << 32U;
    }
    int integer() { return static_cast<int>(number()); }
    double real() { return std::bit_cast<double>(number()); }
    SampleRange range() {
        const std::uint64_t first = number();
        return {first, number()};
    }
    std::string text() {
        std::string text;
        for (const std::uint32_t c : take(number())) {
            text += static_cast<char>(c);
        }
        return text;
    }
    template <class Struct>
    void read_structs(std::span<Struct> structs) {
        const auto from = take(structs.size_bytes() / sizeof(std::uint32_t));
        std::copy(from.begin(), from.end(), reinterpret_cast<std::uint32_t*>(structs.data()));
    }

private:
    std::span<const std::uint32_t> take(std::uint64_t count) {
        if (count > words_.size()) {
            throw std::runtime_error("a message between ranks is too short");
        }
        const auto taken = words_.first(static_cast<std::size_t>(count));
        words_ = words_.subspan(static_cast<std::size_t>(count));
        return taken;
    }

    std::span<const std::uint32_t> words_;
};

}  // namespace diptych::core
