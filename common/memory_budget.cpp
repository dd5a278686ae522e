#include "memory_budget.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "memory_groups.h"

namespace diptych::core {
namespace {

constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();

std::uint64_t sum_of(std::uint64_t a, std::uint64_t b) {
    return a > most - b ? most : a + b;
}

}  // namespace

std::uint64_t default_memory_limit() {
    static const std::uint64_t quarter = memory_of_process() / 4;
    return quarter;
}

std::string memory_text(std::uint64_t bytes) {
    constexpr std::array units{"KB", "MB", "GB", "TB", "PB", "EB"};
    if (bytes < 1024) {
        return fmt::format("{} bytes", bytes);
    }
    double value = static_cast<double>(bytes) / 1024;
    std::size_t unit = 0;
    for (; value >= 1024 && unit + 1 < units.size(); ++unit) {
        value /= 1024;
    }
    return fmt::format("{:.1f} {}", value, units[unit]);
}

std::uint64_t memory_from_text(const std::string& text) {
    constexpr std::string_view units = "KMGT";
    std::uint64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, value);
    const std::size_t power = stop == end ? 0 : units.find(*stop) + 1;  // 0 too where it is none of them
    const bool whole = failure == std::errc() && (stop == end || (power > 0 && stop + 1 == end));
    if (!whole || value == 0 || value > (most >> (10 * power))) {
        throw Error(fmt::format("'{}' is no amount of memory; expected 500M, 2G or a number of bytes", text));
    }
    return value << (10 * power);
}

void MemoryBudget::ask(std::uint64_t bytes) {
    std::uint64_t before = asked_;
    while (!asked_.compare_exchange_weak(before, sum_of(before, bytes))) {
    }
    const std::uint64_t in_all = sum_of(before, bytes);
    if (in_all > limit_) {
        throw OverBudget(fmt::format("asks for {}{}, and a file may ask for {} (`memory_limit`)", memory_text(bytes),
                                     before > 0 ? fmt::format(", {} with what was read before", memory_text(in_all)) : "",
                                     memory_text(limit_)));
    }
}

std::uint64_t bytes_of(std::uint64_t count, std::uint64_t each) {
    return each > 0 && count > most / each ? most : count * each;
}

}  // namespace diptych::core
