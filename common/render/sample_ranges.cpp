#include "render/sample_ranges.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "error.h"

namespace diptych::core {

namespace {

[[noreturn]] void fail(const std::string& text) {
    throw Error(fmt::format("'{}' is no range of samples; write FIRST:END with END up to 4294967295, as 0:64 for the first 64", text));
}

/// The whole text as a number.
std::uint64_t number_of(const std::string& text, std::size_t begin, std::size_t end) {
    std::uint64_t number = 0;
    const char* const last = text.data() + end;
    const auto [stop, error] = std::from_chars(text.data() + begin, last, number);
    if (begin == end || stop != last || error != std::errc() || number > 0xffffffffU) {
        fail(text);
    }
    return number;
}

}  // namespace

std::string range_text(const SampleRange& range) {
    return fmt::format("{}:{}", range.first, range.end);
}

SampleRange parse_range(const std::string& text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos) {
        fail(text);
    }
    const SampleRange range{number_of(text, 0, colon), number_of(text, colon + 1, text.size())};
    if (range.first >= range.end) {
        fail(text);
    }
    return range;
}

std::string SampleRanges::text() const {
    std::string text;
    for (const SampleRange& range : ranges_) {
        text += (text.empty() ? "" : ",") + range_text(range);
    }
    return text;
}

SampleRanges SampleRanges::parse(const std::string& text) {
    SampleRanges ranges;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const SampleRanges next(parse_range(text.substr(begin, end - begin)));
        if (ranges.shared_with(next)) {
            fail(text);
        }
        ranges.add(next);
        begin = end + 1;
    }
    return ranges;
}

std::uint64_t SampleRanges::count() const {
    std::uint64_t count = 0;
    for (const SampleRange& range : ranges_) {
        count += range.end - range.first;
    }
    return count;
}

std::optional<SampleRange> SampleRanges::shared_with(const SampleRanges& other) const {
    for (const SampleRange& a : ranges_) {
        for (const SampleRange& b : other.ranges_) {
            const SampleRange both{std::max(a.first, b.first), std::min(a.end, b.end)};
            if (both.first < both.end) {
                return both;
            }
        }
    }
    return std::nullopt;
}

SampleRanges SampleRanges::gaps() const {
    SampleRanges gaps;
    for (std::size_t i = 1; i < ranges_.size(); ++i) {
        gaps.add({ranges_[i - 1].end, ranges_[i].first});
    }
    return gaps;
}

SampleRanges SampleRanges::without(const SampleRanges& other) const {
    SampleRanges left;
    for (SampleRange range : ranges_) {
        for (const SampleRange& taken : other.ranges_) {
            if (taken.end <= range.first || taken.first >= range.end) {
                continue;
            }
            left.add({range.first, std::max(range.first, taken.first)});
            range.first = std::min(range.end, taken.end);
        }
        left.add(range);
    }
    return left;
}

void SampleRanges::add(const SampleRange& range) {
    if (range.first >= range.end) {
        return;
    }
    const auto place = std::find_if(ranges_.begin(), ranges_.end(),
                                    [&](const SampleRange& other) { return other.first >= range.first; });
    auto here = ranges_.insert(place, range);
    if (const auto next = here + 1; next != ranges_.end() && next->first == here->end) {
        here->end = next->end;
        ranges_.erase(next);
    }
    if (here != ranges_.begin() && (here - 1)->end == here->first) {
        (here - 1)->end = here->end;
        ranges_.erase(here);
    }
}

void SampleRanges::add(const SampleRanges& other) {
    for (const SampleRange& range : other.ranges_) {
        add(range);
    }
}

}  // namespace diptych::core
