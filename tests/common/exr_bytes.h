// OpenEXR files byte by byte, uncompressed, after 'OpenEXR File Layout'. So tests can place windows, name parts and set
// chromaticities without the library that is tested.
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "image/pixel_window.h"

namespace diptych::core::image_tests {

struct ExrPart {
    std::string name;                                    // of a part in a file of several
    PixelWindow data;                                    // where the channels have values
    PixelWindow display;                                 // of width 0: `data`
    std::map<std::string, std::vector<float>> channels;  // by name, row by row
    std::vector<float> chromaticities;                   // none, or eight
};

inline void put(std::string& bytes, const void* from, size_t size) {
    bytes.append(static_cast<const char*>(from), size);
}

template <typename T>
void put(std::string& bytes, T value) {
    put(bytes, &value, sizeof(T));
}

inline void put_attribute(std::string& bytes, const char* name, const char* type, const std::string& value) {
    bytes.append(name).push_back('\0');
    bytes.append(type).push_back('\0');
    put(bytes, static_cast<std::int32_t>(value.size()));
    bytes += value;
}

inline std::string box_bytes(const PixelWindow& window) {
    std::string bytes;
    for (const int value : {window.x, window.y, window.x + window.width - 1, window.y + window.height - 1}) {
        put(bytes, static_cast<std::int32_t>(value));
    }
    return bytes;
}

inline void put_header(std::string& bytes, const ExrPart& part, bool one_of_several) {
    constexpr std::int32_t float_pixels = 2, sampling = 1;
    std::string channels;
    for (const auto& [name, values] : part.channels) {
        channels.append(name).push_back('\0');
        for (const std::int32_t value : {float_pixels, std::int32_t{0}, sampling, sampling}) {
            put(channels, value);
        }
    }
    channels.push_back('\0');
    std::string one, zeros(8, '\0'), chromaticities;
    put(one, 1.0f);
    put_attribute(bytes, "channels", "chlist", channels);
    put_attribute(bytes, "compression", "compression", std::string(1, '\0'));
    put_attribute(bytes, "dataWindow", "box2i", box_bytes(part.data));
    put_attribute(bytes, "displayWindow", "box2i", box_bytes(part.display.width > 0 ? part.display : part.data));
    put_attribute(bytes, "lineOrder", "lineOrder", std::string(1, '\0'));
    put_attribute(bytes, "pixelAspectRatio", "float", one);
    put_attribute(bytes, "screenWindowCenter", "v2f", zeros);
    put_attribute(bytes, "screenWindowWidth", "float", one);
    if (!part.chromaticities.empty()) {
        put(chromaticities, part.chromaticities.data(), part.chromaticities.size() * sizeof(float));
        put_attribute(bytes, "chromaticities", "chromaticities", chromaticities);
    }
    if (one_of_several) {
        std::string chunks;
        put(chunks, static_cast<std::int32_t>(part.data.height));
        put_attribute(bytes, "name", "string", part.name);
        put_attribute(bytes, "type", "string", "scanlineimage");
        put_attribute(bytes, "chunkCount", "int", chunks);
    }
    bytes.push_back('\0');
}

inline std::string exr_bytes(const std::vector<ExrPart>& parts) {
    const bool several = parts.size() > 1;
    std::string bytes = "\x76\x2f\x31\x01";
    put(bytes, std::uint32_t{several ? 0x1002u : 2u});
    for (const ExrPart& part : parts) {
        put_header(bytes, part, several);
    }
    if (several) {
        bytes.push_back('\0');
    }
    size_t table_rows = 0;
    for (const ExrPart& part : parts) {
        table_rows += static_cast<size_t>(part.data.height);
    }
    std::string table, chunks;
    const size_t first_chunk = bytes.size() + table_rows * sizeof(std::uint64_t);
    for (size_t number = 0; number < parts.size(); ++number) {
        const ExrPart& part = parts[number];
        const size_t width = static_cast<size_t>(part.data.width);
        for (int row = 0; row < part.data.height; ++row) {
            put(table, static_cast<std::uint64_t>(first_chunk + chunks.size()));
            if (several) {
                put(chunks, static_cast<std::int32_t>(number));
            }
            put(chunks, static_cast<std::int32_t>(part.data.y + row));
            put(chunks, static_cast<std::int32_t>(part.channels.size() * width * sizeof(float)));
            for (const auto& [name, values] : part.channels) {
                put(chunks, values.data() + static_cast<size_t>(row) * width, width * sizeof(float));
            }
        }
    }
    return bytes + table + chunks;
}

/// One part with channels of one value each.
inline ExrPart constant_part(const PixelWindow& data, const std::map<std::string, float>& channels) {
    ExrPart part;
    part.data = data;
    for (const auto& [name, value] : channels) {
        part.channels[name].assign(static_cast<size_t>(data.width) * static_cast<size_t>(data.height), value);
    }
    return part;
}

}  // namespace diptych::core::image_tests
