#include "image/exr_writer.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <numeric>

#include "image/gathering_sink.h"
#include "threads.h"

namespace diptych::core {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

constexpr int zip_rows = 16;  // of a chunk
constexpr int zip_level = 4;  // OpenEXR's own
constexpr std::size_t longest_short_name = 31;

template <class T>
void put_value(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put_text(std::string& bytes, const std::string& text) {
    bytes.append(text).push_back('\0');
}

void put_attribute(std::string& header, const std::string& name, const char* type, const std::string& value) {
    put_text(header, name);
    put_text(header, type);
    put_value(header, static_cast<std::int32_t>(value.size()));
    header += value;
}

template <class... T>
std::string value_bytes(const T&... values) {
    std::string bytes;
    (put_value(bytes, values), ...);
    return bytes;
}

/// Channels lie in the order of their names.
std::vector<std::size_t> channel_order(const std::vector<std::string>& channels) {
    std::vector<std::size_t> order(channels.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return channels[a] < channels[b]; });
    return order;
}

std::string channel_list(const std::vector<std::string>& channels, const std::vector<std::size_t>& order) {
    constexpr std::int32_t float32 = 2;
    std::string list;
    for (const std::size_t channel : order) {
        put_text(list, channels[channel]);
        list += value_bytes(float32, std::int32_t{0}, std::int32_t{1}, std::int32_t{1});  // not linear, every pixel
    }
    list.push_back('\0');
    return list;
}

std::string exr_header(const ExrPicture& picture, const std::vector<std::size_t>& order) {
    bool long_names = false;
    for (const std::string& channel : picture.channels) {
        long_names = long_names || channel.size() > longest_short_name;
    }
    for (const auto& [name, value] : picture.attributes) {
        long_names = long_names || name.size() > longest_short_name;
    }
    std::string header = value_bytes(std::int32_t{20000630}, std::int32_t{long_names ? 0x402 : 2});
    const std::string window = value_bytes(std::array<std::int32_t, 4>{0, 0, picture.width - 1, picture.height - 1});
    const bool zip = picture.compression == ExrCompression::zip;
    put_attribute(header, "channels", "chlist", channel_list(picture.channels, order));
    put_attribute(header, "compression", "compression", value_bytes(static_cast<unsigned char>(zip ? 3 : 0)));
    put_attribute(header, "dataWindow", "box2i", window);
    put_attribute(header, "displayWindow", "box2i", window);
    put_attribute(header, "lineOrder", "lineOrder", value_bytes(static_cast<unsigned char>(0)));
    put_attribute(header, "pixelAspectRatio", "float", value_bytes(1.0F));
    put_attribute(header, "screenWindowCenter", "v2f", value_bytes(0.0F, 0.0F));
    put_attribute(header, "screenWindowWidth", "float", value_bytes(1.0F));
    for (const auto& [name, value] : picture.attributes) {
        put_attribute(header, name, "string", value);
    }
    header.push_back('\0');
    return header;
}

using ChunkBytes = std::vector<unsigned char>;

/// Rows of interleaved channels as a chunk has them: row by row, in each channel by channel.
void lay_out(std::span<const float> values, std::size_t width, const std::vector<std::size_t>& order, ChunkBytes& chunk) {
    chunk.resize(values.size_bytes());
    float* to = reinterpret_cast<float*>(chunk.data());
    const std::size_t stride = order.size();
    for (std::size_t row = 0; row < values.size(); row += width * stride) {
        for (const std::size_t channel : order) {
            for (std::size_t x = 0; x < width; ++x) {
                *to++ = values[row + x * stride + channel];
            }
        }
    }
}

/// Zip of OpenEXR: bytes of even places before those of odd ones, each as its difference from the one before.
void zip(ChunkBytes& chunk, ChunkBytes& scratch) {
    scratch.resize(chunk.size());
    const std::size_t half = (chunk.size() + 1) / 2;
    for (std::size_t i = 0; i < chunk.size(); ++i) {
        scratch[(i % 2) * half + i / 2] = chunk[i];
    }
    for (std::size_t i = scratch.size(); i-- > 1;) {
        scratch[i] = static_cast<unsigned char>(scratch[i] - scratch[i - 1] + 128);
    }
    ChunkBytes packed(compressBound(scratch.size()));
    uLongf size = packed.size();
    if (compress2(packed.data(), &size, scratch.data(), scratch.size(), zip_level) == Z_OK && size < chunk.size()) {
        packed.resize(size);
        chunk = std::move(packed);
    }  // else it stays as it is, which readers see by its size
}

}  // namespace

void write_exr_file(const ExrPicture& picture, ByteSink& sink) {
    const std::vector<std::size_t> order = channel_order(picture.channels);
    const auto width = static_cast<std::size_t>(picture.width);
    const std::size_t row_values = width * picture.channels.size();
    const bool zips = picture.compression == ExrCompression::zip;
    const int chunk_rows = zips ? zip_rows : 1;
    const auto chunk_count = static_cast<std::size_t>((picture.height + chunk_rows - 1) / chunk_rows);

    GatheringSink file(sink);
    const std::string header = exr_header(picture, order);
    file.append(header.data(), header.size());
    std::vector<std::uint64_t> table(chunk_count);
    file.append(table.data(), table.size() * sizeof table[0]);  // a place for it

    std::vector<ChunkBytes> chunks(4 * machine_threads() * (zips ? 1 : zip_rows));
    std::vector<float> band;
    for (std::size_t first = 0; first < chunk_count; first += chunks.size()) {
        const std::size_t count = std::min(chunks.size(), chunk_count - first);
        const int row = static_cast<int>(first) * chunk_rows;
        const int rows = std::min(static_cast<int>(count) * chunk_rows, picture.height - row);
        band.resize(static_cast<std::size_t>(rows) * row_values);
        picture.rows(row, rows, band);
        in_parts(count, [&](std::size_t begin, std::size_t end) {
            ChunkBytes scratch;
            for (std::size_t i = begin; i < end; ++i) {
                const std::size_t from = i * static_cast<std::size_t>(chunk_rows) * row_values;
                const std::size_t values = std::min(static_cast<std::size_t>(chunk_rows) * row_values, band.size() - from);
                lay_out(std::span(band).subspan(from, values), width, order, chunks[i]);
                if (zips) {
                    zip(chunks[i], scratch);
                }
            }
        });
        for (std::size_t i = 0; i < count; ++i) {
            table[first + i] = file.size();
            const std::int32_t head[] = {static_cast<std::int32_t>(first + i) * chunk_rows,
                                         static_cast<std::int32_t>(chunks[i].size())};
            file.append(head, sizeof head);
            file.append(chunks[i].data(), chunks[i].size());
        }
    }
    file.flush();
    sink.write_at(header.size(), {reinterpret_cast<const unsigned char*>(table.data()), table.size() * sizeof table[0]});
}

}  // namespace diptych::core
