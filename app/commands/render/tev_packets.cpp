#include "commands/render/tev_packets.h"

#include <array>
#include <bit>
#include <cassert>
#include <cstring>

namespace diptych::core::app {

namespace {

static_assert(std::endian::native == std::endian::little,
              "the protocol is little-endian, and values go out as they lie in memory");

constexpr std::uint8_t create_image = 4;
constexpr std::uint8_t update_image_v3 = 6;
constexpr std::array<const char*, 3> channels = {"R", "G", "B"};

class Writer {
public:
    explicit Writer(std::uint8_t kind) : bytes_(sizeof(std::uint32_t)) { put(kind); }

    template <typename T>
    void put(T value) {
        append(&value, sizeof value);
    }
    void put(const std::string& text) { append(text.c_str(), text.size() + 1); }
    void put_channels() {
        put(static_cast<std::int32_t>(channels.size()));
        for (const char* name : channels) {
            put(std::string(name));
        }
    }
    void append(const void* data, std::size_t size) {
        const auto* begin = static_cast<const std::uint8_t*>(data);
        bytes_.insert(bytes_.end(), begin, begin + size);
    }
    TevPacket finish() {
        const auto length = static_cast<std::uint32_t>(bytes_.size());
        std::memcpy(bytes_.data(), &length, sizeof length);
        return std::move(bytes_);
    }

private:
    TevPacket bytes_;
};

constexpr std::uint8_t keep_focus = 0;  // of the viewer's other pictures
constexpr std::uint8_t take_focus = 1;

}  // namespace

TevPacket tev_create_image(const std::string& name, int width, int height) {
    Writer packet(create_image);
    packet.put(take_focus);
    packet.put(name);
    packet.put(std::int32_t{width});
    packet.put(std::int32_t{height});
    packet.put_channels();
    return packet.finish();
}

TevPacket tev_update_image(const std::string& name, const Image& image, int first_row, int rows) {
    assert(image.channels == static_cast<int>(channels.size()) && first_row >= 0 && first_row + rows <= image.height);
    Writer packet(update_image_v3);
    packet.put(keep_focus);
    packet.put(name);
    packet.put_channels();
    for (const std::int32_t field : {0, first_row, image.width, rows}) {
        packet.put(field);
    }
    for (std::int64_t offset = 0; offset < image.channels; ++offset) {
        packet.put(offset);
    }
    for (int channel = 0; channel < image.channels; ++channel) {
        packet.put(std::int64_t{image.channels});  // stride
    }
    packet.append(&image.data[image.index(0, first_row, 0)],
                  static_cast<std::size_t>(rows) * static_cast<std::size_t>(image.width * image.channels) *
                      sizeof(float));
    return packet.finish();
}

}  // namespace diptych::core::app
