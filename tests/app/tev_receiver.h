// What tev does with its network protocol, as far as the tests need it: written from the protocol's description, not
// from our sender.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace diptych::core::tests {

struct ReceivedImage {
    int width = 0;
    int height = 0;
    std::vector<std::string> channels;
    std::vector<float> data;  // interleaved; NaN where nothing came
    int updates = 0;
};

class TevReceiver {
public:
    /// Listens on a free port of the loopback. Hangs up after so many packets; 0 is never.
    explicit TevReceiver(int packets_until_hang_up = 0);
    ~TevReceiver();
    TevReceiver(const TevReceiver&) = delete;
    TevReceiver& operator=(const TevReceiver&) = delete;

    std::string endpoint() const { return "127.0.0.1:" + std::to_string(port_); }

    /// Waits for the end of the first connection. Throws std::runtime_error for bytes that are no such protocol.
    const std::map<std::string, ReceivedImage>& finish();

private:
    void listen();
    void take(const std::vector<char>& packet);

    int packets_until_hang_up_;
    int listener_ = -1;
    int port_ = 0;
    std::map<std::string, ReceivedImage> images_;
    std::string fault_;
    std::thread thread_;
};

}  // namespace diptych::core::tests
