#include "commands/render/live_view.h"

#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>

#include "error.h"
#include "console/report.h"
#include "commands/render/tev_packets.h"

namespace diptych::core::app {

namespace {

constexpr int patience_seconds = 5;
constexpr std::size_t band_bytes = std::size_t{1} << 20U;  // of a packet: the viewer shows each as it comes

struct Endpoint {
    std::string host;
    std::string port;
};

Endpoint parse_endpoint(const std::string& text) {
    const std::size_t colon = text.find_last_of(':');
    Endpoint endpoint;
    if (colon != std::string::npos) {
        endpoint = {text.substr(0, colon), text.substr(colon + 1)};
    }
    const bool bracketed = endpoint.host.size() > 2 && endpoint.host.front() == '[' && endpoint.host.back() == ']';
    if (bracketed) {
        endpoint.host = endpoint.host.substr(1, endpoint.host.size() - 2);
    }
    int port = 0;
    const char* const end = endpoint.port.data() + endpoint.port.size();
    const auto parsed = std::from_chars(endpoint.port.data(), end, port);
    const bool number = parsed.ec == std::errc() && parsed.ptr == end && port >= 1 && port <= 65535;
    if (endpoint.host.empty() || !number || (!bracketed && endpoint.host.find(':') != std::string::npos)) {
        throw Error(fmt::format("--live {}: expected HOST:PORT, such as localhost:14158 or [::1]:14158", text));
    }
    return endpoint;
}

/// A socket that is connected, or -1 with errno.
int connect_to(const addrinfo& address) {
    const int opened = socket(address.ai_family, address.ai_socktype | SOCK_CLOEXEC, address.ai_protocol);
    if (opened < 0) {
        return -1;
    }
    timeval patience = {};
    patience.tv_sec = patience_seconds;
    // On Linux it bounds connect as well.
    setsockopt(opened, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    if (connect(opened, address.ai_addr, address.ai_addrlen) == 0) {
        return opened;
    }
    const int reason = errno == EINPROGRESS ? ETIMEDOUT : errno;
    close(opened);
    errno = reason;
    return -1;
}

}  // namespace

LiveView::LiveView(const std::string& endpoint) : endpoint_(endpoint) {
    const Endpoint parts = parse_endpoint(endpoint);
    addrinfo hints = {};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const int status = getaddrinfo(parts.host.c_str(), parts.port.c_str(), &hints, &found);
    if (status != 0) {
        throw Error(fmt::format("--live {}: {}", endpoint, gai_strerror(status)));
    }
    const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> addresses(found, &freeaddrinfo);
    for (const addrinfo* address = found; address != nullptr && socket_ < 0; address = address->ai_next) {
        socket_ = connect_to(*address);
    }
    if (socket_ < 0) {
        throw Error(fmt::format("--live {}: {}: is tev running there, and does it listen on that port?", endpoint,
                                std::strerror(errno)));
    }
}

LiveView::~LiveView() {
    if (socket_ >= 0) {
        close(socket_);
    }
}

void LiveView::show(const std::string& name, const Image& image) {
    if (socket_ < 0) {
        return;
    }
    const std::string picture = fmt::format("{} {}x{}", name, image.width, image.height);
    if (picture != shown_) {
        const TevPacket packet = tev_create_image(name, image.width, image.height);
        send(packet.data(), packet.size());
        shown_ = picture;
    }
    const std::size_t row_bytes = static_cast<std::size_t>(image.width) * 3 * sizeof(float);
    const int band =
        static_cast<int>(std::clamp<std::size_t>(band_bytes / row_bytes, 1, static_cast<std::size_t>(image.height)));
    for (int row = 0; row < image.height && socket_ >= 0; row += band) {
        const TevPacket packet = tev_update_image(name, image, row, std::min(band, image.height - row));
        send(packet.data(), packet.size());
    }
}

void LiveView::send(const void* data, std::size_t size) {
    const auto* next = static_cast<const std::uint8_t*>(data);
    while (size > 0 && socket_ >= 0) {
        const ssize_t sent = ::send(socket_, next, size, MSG_NOSIGNAL);
        if (sent > 0) {
            next += sent;
            size -= static_cast<std::size_t>(sent);
        } else if (errno != EINTR) {
            const bool stalled = errno == EAGAIN || errno == EWOULDBLOCK;
            report_warning(fmt::format("--live {}: {}; the render goes on without it", endpoint_,
                                       stalled ? "takes no more data" : std::strerror(errno)));
            close(socket_);
            socket_ = -1;
        }
    }
}

}  // namespace diptych::core::app
