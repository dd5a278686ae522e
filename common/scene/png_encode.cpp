#include "scene/png_encode.h"

#include "error.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>
#include <string_view>

namespace diptych {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::array<std::uint32_t, 256> crc_table() {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t n = 0; n < 256; ++n) {
        std::uint32_t c = n;
        for (int k = 0; k < 8; ++k)
            c = (c & 1U) != 0 ? 0xedb88320U ^ (c >> 1U) : c >> 1U;
        table[n] = c;
    }
    return table;
}

void append_big_endian(Bytes& out, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        out.push_back(static_cast<std::uint8_t>(value >> unsigned(shift)));
}

void append_chunk(Bytes& out, std::string_view type, std::span<const std::uint8_t> data) {
    static const auto table = crc_table();
    append_big_endian(out, static_cast<std::uint32_t>(data.size()));
    const std::size_t start = out.size();
    out.insert(out.end(), type.begin(), type.end());
    out.insert(out.end(), data.begin(), data.end());
    std::uint32_t crc = 0xffffffffU;
    for (std::size_t i = start; i < out.size(); ++i)
        crc = table[(crc ^ out[i]) & 0xffU] ^ (crc >> 8U);
    append_big_endian(out, ~crc);
}

struct BitWriter {
    Bytes bytes;
    std::uint32_t pending = 0;
    int filled = 0;

    void put(std::uint32_t value, int count) {  // least significant bit first
        pending |= value << unsigned(filled);
        for (filled += count; filled >= 8; filled -= 8) {
            bytes.push_back(static_cast<std::uint8_t>(pending));
            pending >>= 8U;
        }
    }
    void put_code(std::uint32_t code, int count) {  // Huffman codes: most significant bit first
        for (int bit = count - 1; bit >= 0; --bit)
            put((code >> unsigned(bit)) & 1U, 1);
    }
};

/// A symbol of DEFLATE's fixed literal and length code (RFC 1951, 3.2.6).
void put_symbol(BitWriter& out, std::uint32_t symbol) {
    if (symbol < 144)
        out.put_code(0x30 + symbol, 8);
    else if (symbol < 256)
        out.put_code(0x190 + symbol - 144, 9);
    else if (symbol < 280)
        out.put_code(symbol - 256, 7);
    else
        out.put_code(0xc0 + symbol - 280, 8);
}

/// Length or distance as base symbol and extra bits (RFC 1951, 3.2.5); both codes double their step every `group`
/// symbols.
struct Code {
    std::uint32_t symbol, extra;
    int extra_bits;
};
Code split_code(std::uint32_t offset, std::uint32_t group) {
    if (offset < 2 * group)
        return {offset, 0, 0};
    int bits = 1;
    while ((offset >> unsigned(bits)) >= 2 * group)
        ++bits;
    return {group * std::uint32_t(bits) + (offset >> unsigned(bits)), offset & ((1U << unsigned(bits)) - 1), bits};
}

void put_match(BitWriter& out, std::uint32_t length, std::uint32_t distance) {
    if (length == 258) {
        put_symbol(out, 285);
    } else {
        const Code code = split_code(length - 3, 4);
        put_symbol(out, 257 + code.symbol);
        out.put(code.extra, code.extra_bits);
    }
    const Code code = split_code(distance - 1, 2);
    out.put_code(code.symbol, 5);
    out.put(code.extra, code.extra_bits);
}

/// A zlib stream (RFC 1950): one block of fixed codes, greedy matches from one candidate a hash.
Bytes compress(std::span<const std::uint8_t> data) {
    BitWriter out;
    out.bytes = {0x78, 0x01};
    out.put(1, 1);
    out.put(1, 2);
    std::vector<std::int64_t> last(1U << 15U, -1);
    for (std::size_t i = 0; i < data.size();) {
        std::size_t length = 0, distance = 0;
        if (i + 3 <= data.size()) {
            const std::uint32_t key = data[i] | data[i + 1] << 8U | data[i + 2] << 16U;
            auto& slot = last[(key * 0x9e3779b1U) >> 17U];
            if (slot >= 0 && i - std::size_t(slot) <= 32768) {
                const std::size_t limit = std::min<std::size_t>(258, data.size() - i);
                while (length < limit && data[std::size_t(slot) + length] == data[i + length])
                    ++length;
                distance = i - std::size_t(slot);
            }
            slot = std::int64_t(i);
        }
        if (length >= 3) {
            put_match(out, std::uint32_t(length), std::uint32_t(distance));
            i += length;
        } else {
            put_symbol(out, data[i++]);
        }
    }
    put_symbol(out, 256);
    out.put(0, 7);
    std::uint32_t a = 1, b = 0;
    for (const std::uint8_t byte : data) {
        a = (a + byte) % 65521;
        b = (b + a) % 65521;
    }
    append_big_endian(out.bytes, b << 16U | a);
    return std::move(out.bytes);
}

std::uint8_t paeth(int left, int up, int corner) {
    const int guess = left + up - corner;
    const int to_left = std::abs(guess - left), to_up = std::abs(guess - up), to_corner = std::abs(guess - corner);
    if (to_left <= to_up && to_left <= to_corner)
        return std::uint8_t(left);
    return std::uint8_t(to_up <= to_corner ? up : corner);
}

}  // namespace

std::vector<std::uint8_t> encode_png(const TextureImage& image) {
    const std::size_t texels = std::size_t(std::max(image.width, 0)) * std::size_t(std::max(image.height, 0));
    if (texels == 0 || image.rgba.size() != 4 * texels)
        throw Error("image '" + image.name + "': the number of texels does not fit its size");
    bool has_alpha = false;
    for (std::size_t i = 0; i < texels; ++i)
        has_alpha = has_alpha || image.rgba[4 * i + 3] != 255;
    const std::size_t channels = has_alpha ? 4 : 3;

    Bytes filtered;
    filtered.reserve(texels * channels + std::size_t(image.height));
    for (int y = 0; y < image.height; ++y) {
        const auto at = [&](int x, int row, std::size_t channel) -> int {
            if (x < 0 || row < 0)
                return 0;
            return image.rgba[4 * (std::size_t(row) * std::size_t(image.width) + std::size_t(x)) + channel];
        };
        filtered.push_back(4);
        for (int x = 0; x < image.width; ++x)
            for (std::size_t c = 0; c < channels; ++c)
                filtered.push_back(
                    std::uint8_t(at(x, y, c) - paeth(at(x - 1, y, c), at(x, y - 1, c), at(x - 1, y - 1, c))));
    }

    Bytes png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    Bytes header;
    append_big_endian(header, std::uint32_t(image.width));
    append_big_endian(header, std::uint32_t(image.height));
    for (const int value : {8, has_alpha ? 6 : 2, 0, 0, 0})
        header.push_back(std::uint8_t(value));
    append_chunk(png, "IHDR", header);
    append_chunk(png, "IDAT", compress(filtered));
    append_chunk(png, "IEND", {});
    return png;
}

}  // namespace diptych
