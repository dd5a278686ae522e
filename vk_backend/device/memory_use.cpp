#include "device/memory_use.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace diptych::core {

const char* name_of(Purpose purpose) {
    constexpr std::array<const char*, purpose_count> names = {
        "the film", "reservoirs", "paths in flight", "acceleration structures", "building acceleration structures",
        "textures", "vertices",   "scene tables",    "staging",                 "reading results",
        "recorded paths", "pipelines", "the display", "other buffers"};
    return names[static_cast<std::size_t>(purpose)];
}

std::uint64_t total(const BytesByPurpose& bytes) {
    return std::accumulate(bytes.begin(), bytes.end(), std::uint64_t{0});
}

std::string text_of(const BytesByPurpose& bytes) {
    std::array<std::size_t, purpose_count> order;
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return bytes[a] > bytes[b]; });
    std::string text;
    for (const std::size_t i : order) {
        if (bytes[i] > 0) {
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name_of(static_cast<Purpose>(i)),
                                size_text(bytes[i]));
        }
    }
    return text.empty() ? "nothing" : text;
}

std::string size_text(std::uint64_t bytes) {
    constexpr std::array units = {"B", "kB", "MB", "GB", "TB", "PB", "EB"};
    double value = static_cast<double>(bytes);
    std::size_t unit = 0;
    for (; value >= 1000 && unit + 1 < units.size(); ++unit) {
        value /= 1024;
    }
    const int digits = value < 10 ? 2 : value < 100 ? 1 : 0;
    return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.{}f} {}", value, digits, units[unit]);
}

BytesByPurpose MemoryUse::bytes() const {
    BytesByPurpose all;
    std::transform(counts_.begin(), counts_.end(), all.begin(), [](const auto& count) { return count.load(); });
    return all;
}

MemoryCharge::MemoryCharge(std::shared_ptr<MemoryUse> use, Purpose purpose, std::uint64_t bytes)
    : use_(std::move(use)), purpose_(purpose), bytes_(bytes) {
    use_->add(purpose_, bytes_);
}

MemoryCharge::~MemoryCharge() {
    if (use_) {
        use_->remove(purpose_, bytes_);
    }
}

void MemoryCharge::swap(MemoryCharge& other) noexcept {
    std::swap(use_, other.use_);
    std::swap(purpose_, other.purpose_);
    std::swap(bytes_, other.bytes_);
}

}  // namespace diptych::core
