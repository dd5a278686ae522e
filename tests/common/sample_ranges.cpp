// Ranges of samples: their text, their sums, and what they share.
#include "render/sample_ranges.h"

#include "catch.h"
#include "error.h"

namespace diptych::core {

TEST_CASE("ranges of samples join, whatever order they come in", "[render]") {
    SampleRanges ranges;
    for (const SampleRange range : {SampleRange{64, 128}, {0, 16}, {200, 201}, {16, 64}, {5, 5}}) {
        ranges.add(range);
    }
    CHECK(ranges.text() == "0:128,200:201");
    CHECK(ranges.count() == 129);
    CHECK(ranges.gaps().text() == "128:200");
    CHECK(SampleRanges::parse(ranges.text()) == ranges);
    ranges.add({128, 200});
    CHECK(ranges.text() == "0:201");
    CHECK(ranges.gaps().empty());
    CHECK(SampleRanges().text().empty());
    CHECK(SampleRanges::parse("").empty());
}

TEST_CASE("samples that two have in common are found", "[render]") {
    const SampleRanges ranges = SampleRanges::parse("0:16,32:48");
    CHECK_FALSE(ranges.shared_with(SampleRanges({16, 32})));
    CHECK_FALSE(ranges.shared_with(SampleRanges({48, 4294967295})));
    CHECK(ranges.shared_with(SampleRanges({15, 33})) == SampleRange{15, 16});
    CHECK(ranges.shared_with(SampleRanges({47, 60})) == SampleRange{47, 48});
}

TEST_CASE("what other ranges hold is taken away", "[render]") {
    const SampleRanges ranges = SampleRanges::parse("0:16,32:48,60:61");
    const auto left = [&](const char* taken) { return ranges.without(SampleRanges::parse(taken)).text(); };
    CHECK(left("") == "0:16,32:48,60:61");
    CHECK(left("0:100") == "");
    CHECK(left("16:32,48:60") == "0:16,32:48,60:61");
    CHECK(left("0:4,6:8,12:33,40:41") == "4:6,8:12,33:40,41:48,60:61");
    CHECK(left("15:61") == "0:15");
}

TEST_CASE("text that is no range is refused", "[render]") {
    for (const char* text : {"", "5", "5:", ":5", "5:5", "6:5", "-1:5", "0:4294967296", "0x1:5", "1:2:3", "a:b", " 1:2"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(parse_range(text), Error);
    }
    CHECK_THROWS_AS(SampleRanges::parse("0:4,3:5"), Error);
    CHECK_THROWS_AS(SampleRanges::parse("0:4,,5:6"), Error);
    CHECK(parse_range("0:4294967295") == SampleRange{0, 4294967295});
}

}  // namespace diptych::core
