#include "commands/render/live_view.h"

#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>

#include "clock.h"
#include "error.h"
#include "console/report.h"
#include "commands/render/tev_packets.h"

namespace diptych::core::app {

namespace {

constexpr int patience_seconds = 5;
constexpr double show_seconds = 0.1;
constexpr double least_finish_seconds = 0.25;
constexpr int look_milliseconds = 20;  // at the clock and at a wish to stop, while a viewer takes nothing
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

int band_rows(const Image& image) {
    const std::size_t row_bytes = static_cast<std::size_t>(image.width) * 3 * sizeof(float);
    return static_cast<int>(std::clamp<std::size_t>(band_bytes / row_bytes, 1, static_cast<std::size_t>(image.height)));
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

/// Until when a viewer is waited for.
struct LiveView::Deadline {
    double at = 0;
    const std::atomic<bool>* cancel = nullptr;

    bool passed() const { return now_seconds() >= at || (cancel != nullptr && *cancel); }
};

void LiveView::show(const std::string& name, const Image& image, const std::atomic<bool>& cancel) {
    const Deadline deadline{now_seconds() + show_seconds, &cancel};
    if (!announce(name, image, deadline)) {
        return;
    }
    const int band = band_rows(image);
    for (int done = 0; done < image.height;) {
        const int rows = std::min(band, image.height - next_row_);
        if (!send_rows(name, image, next_row_, rows, deadline)) {
            break;
        }
        next_row_ = (next_row_ + rows) % image.height;
        done += rows;
    }
    flush(deadline);
    if (sent_ < unsent_.size() && now_seconds() - last_progress_ > patience_seconds) {
        hang_up("takes no more data");
    }
}

void LiveView::finish(const std::string& name, const Image& image, double seconds) {
    const double patience = std::max(seconds, least_finish_seconds);
    const Deadline deadline{now_seconds() + patience, nullptr};
    bool whole = announce(name, image, deadline);
    const int band = band_rows(image);
    for (int row = 0; row < image.height && whole; row += band) {
        whole = send_rows(name, image, row, std::min(band, image.height - row), deadline);
    }
    whole = whole && flush(deadline);
    if (!whole && socket_ >= 0 && !warned_) {
        report_warning(fmt::format("--live {}: has not taken the whole picture within {:.1f} s", endpoint_, patience));
        warned_ = true;
    }
}

bool LiveView::announce(const std::string& name, const Image& image, const Deadline& deadline) {
    const std::string picture = fmt::format("{} {}x{}", name, image.width, image.height);
    if (picture == shown_) {
        return socket_ >= 0;
    }
    if (!flush(deadline)) {
        return false;
    }
    queue(tev_create_image(name, image.width, image.height));
    shown_ = picture;
    next_row_ = 0;
    return true;
}

bool LiveView::send_rows(const std::string& name, const Image& image, int first, int count, const Deadline& deadline) {
    if (!flush(deadline)) {
        return false;
    }
    queue(tev_update_image(name, image, first, count));
    return true;
}

void LiveView::queue(std::vector<std::uint8_t> packet) {
    unsent_ = std::move(packet);
    sent_ = 0;
    last_progress_ = now_seconds();
}

bool LiveView::flush(const Deadline& deadline) {
    while (socket_ >= 0 && sent_ < unsent_.size()) {
        if (deadline.passed()) {
            return false;
        }
        const ssize_t sent = ::send(socket_, &unsent_[sent_], unsent_.size() - sent_, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent > 0) {
            sent_ += static_cast<std::size_t>(sent);
            last_progress_ = now_seconds();
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            pollfd space = {socket_, POLLOUT, 0};
            poll(&space, 1, look_milliseconds);
        } else if (errno != EINTR) {
            hang_up(std::strerror(errno));
        }
    }
    return socket_ >= 0;
}

void LiveView::hang_up(const std::string& reason) {
    report_warning(fmt::format("--live {}: {}; the render goes on without it", endpoint_, reason));
    close(socket_);
    socket_ = -1;
}

}  // namespace diptych::core::app
