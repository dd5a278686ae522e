// Which samples of a picture a film holds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace diptych::core {

/// Samples first .. end-1 of every pixel.
struct SampleRange {
    std::uint64_t first = 0;
    std::uint64_t end = 0;

    bool operator==(const SampleRange&) const = default;
};

/// "first:end"
std::string range_text(const SampleRange& range);

/// Reads what range_text wrote. Throws Error where the text is no range, or an empty one.
SampleRange parse_range(const std::string& text);

/// Ranges in ascending order, which neither overlap nor touch.
class SampleRanges {
public:
    SampleRanges() = default;
    explicit SampleRanges(const SampleRange& range) { add(range); }

    /// "0:64,128:192"; "" where there are none.
    std::string text() const;
    static SampleRanges parse(const std::string& text);

    const std::vector<SampleRange>& ranges() const { return ranges_; }
    bool empty() const { return ranges_.empty(); }
    std::uint64_t count() const;

    /// The first samples that both have.
    std::optional<SampleRange> shared_with(const SampleRanges& other) const;

    /// The samples between the first and the last that are not there.
    SampleRanges gaps() const;

    /// The samples that `other` does not have.
    SampleRanges without(const SampleRanges& other) const;

    /// Adds samples that are not there yet; an empty range adds nothing.
    void add(const SampleRange& range);
    void add(const SampleRanges& other);

    bool operator==(const SampleRanges&) const = default;

private:
    std::vector<SampleRange> ranges_;
};

}  // namespace diptych::core
