#include "tev_receiver.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <limits>
#include <stdexcept>

namespace diptych::core::tests {

namespace {

/// Fields of a packet, one after the other.
class Reader {
public:
    explicit Reader(const std::vector<char>& bytes) : bytes_(bytes) {}

    template <typename T>
    T take() {
        T value;
        need(sizeof value);
        std::memcpy(&value, &bytes_[at_], sizeof value);
        at_ += sizeof value;
        return value;
    }
    std::string text() {
        std::string result;
        for (char c = take<char>(); c != '\0'; c = take<char>()) {
            result += c;
        }
        return result;
    }
    std::vector<std::string> texts(int count) {
        std::vector<std::string> result;
        for (int i = 0; i < count; ++i) {
            result.push_back(text());
        }
        return result;
    }
    std::size_t left() const { return bytes_.size() - at_; }

private:
    void need(std::size_t size) const {
        if (left() < size) {
            throw std::runtime_error("a packet ends within a field");
        }
    }

    const std::vector<char>& bytes_;
    std::size_t at_ = 0;
};

bool receive(int connection, void* data, std::size_t size) {
    return size == 0 || recv(connection, data, size, MSG_WAITALL) == static_cast<ssize_t>(size);
}

void create(Reader& packet, std::map<std::string, ReceivedImage>& images) {
    packet.take<char>();  // whether the viewer turns to it
    ReceivedImage& image = images[packet.text()];
    image = {};
    image.width = packet.take<std::int32_t>();
    image.height = packet.take<std::int32_t>();
    image.channels = packet.texts(packet.take<std::int32_t>());
    image.data.assign(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                          image.channels.size(),
                      std::numeric_limits<float>::quiet_NaN());
}

void update(Reader& packet, std::map<std::string, ReceivedImage>& images) {
    packet.take<char>();
    ReceivedImage& image = images.at(packet.text());
    const int count = packet.take<std::int32_t>();
    if (packet.texts(count) != image.channels) {
        throw std::runtime_error("an update of other channels");
    }
    const int x = packet.take<std::int32_t>();
    const int y = packet.take<std::int32_t>();
    const int width = packet.take<std::int32_t>();
    const int height = packet.take<std::int32_t>();
    if (x < 0 || y < 0 || x + width > image.width || y + height > image.height) {
        throw std::runtime_error("an update beyond the picture");
    }
    std::vector<std::int64_t> offsets;
    std::vector<std::int64_t> strides;
    for (int i = 0; i < 2 * count; ++i) {
        (i < count ? offsets : strides).push_back(packet.take<std::int64_t>());
    }
    std::vector<float> values(packet.left() / sizeof(float));
    for (float& value : values) {
        value = packet.take<float>();
    }
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            for (std::size_t c = 0; c < offsets.size(); ++c) {
                const std::int64_t from = offsets[c] + strides[c] * (std::int64_t{row} * width + column);
                const std::size_t to =
                    static_cast<std::size_t>((y + row) * image.width + x + column) * offsets.size() + c;
                image.data[to] = values.at(static_cast<std::size_t>(from));
            }
        }
    }
    ++image.updates;
}

}  // namespace

TevReceiver::TevReceiver(int packets_until_hang_up) : packets_until_hang_up_(packets_until_hang_up) {
    listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const generic = reinterpret_cast<sockaddr*>(&address);
    if (bind(listener_, generic, size) != 0 || ::listen(listener_, 1) != 0 ||
        getsockname(listener_, generic, &size) != 0) {
        throw std::runtime_error("no socket on the loopback");
    }
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { listen(); });
}

TevReceiver::~TevReceiver() {
    if (thread_.joinable()) {
        shutdown(listener_, SHUT_RDWR);  // ends an accept that nobody answered
        thread_.join();
    }
    close(listener_);
}

const std::map<std::string, ReceivedImage>& TevReceiver::finish() {
    thread_.join();
    if (!fault_.empty()) {
        throw std::runtime_error(fault_);
    }
    return images_;
}

void TevReceiver::listen() {
    const int connection = accept(listener_, nullptr, nullptr);
    if (connection < 0) {
        return;
    }
    std::uint32_t length = 0;
    try {
        for (int count = 1; receive(connection, &length, sizeof length); ++count) {
            std::vector<char> packet(length - sizeof length);  // the length counts its own bytes
            if (!receive(connection, packet.data(), packet.size())) {
                throw std::runtime_error("the connection ends within a packet");
            }
            take(packet);
            if (count == packets_until_hang_up_) {
                break;
            }
        }
    } catch (const std::exception& error) {
        fault_ = error.what();
    }
    close(connection);
}

void TevReceiver::take(const std::vector<char>& packet) {
    Reader reader(packet);
    switch (reader.take<char>()) {
    case 4:
        return create(reader, images_);
    case 6:
        return update(reader, images_);
    default:
        throw std::runtime_error("a packet of a kind that a render has no use for");
    }
}

}  // namespace diptych::core::tests
