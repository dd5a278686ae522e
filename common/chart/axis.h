// Axes of charts: where a value lies on one, and which values get a tick.
#pragma once

#include <string>
#include <vector>

namespace diptych::core::chart {

/// `decimal` and `binary` are logarithmic. Ticks stand at 1, 2 and 5 times powers of ten, or at powers of two.
enum class Scale { linear, decimal, binary };

/// How the ticks' values are written: as numbers, or as seconds with a unit each.
enum class TickText { number, seconds };

struct Range {
    double low = 0;
    double high = 1;
};

struct Tick {
    double value = 0;
    std::string text;  // empty: a grid line without a label
};

bool is_logarithmic(Scale scale);

/// Whether an axis has a place for the value: it is finite and, where the axis is logarithmic, above zero.
bool can_show(Scale scale, double value);

/// 0 at range.low, 1 at range.high. Values beyond the range lie on its ends; on a logarithmic axis zero and less lie on
/// the low end.
double share_of(Scale scale, const Range& range, double value);

/// The ticks within the range in ascending order, at most `most` (2 or more) of them with a text. Needs low < high, and
/// low > 0 on a logarithmic axis.
std::vector<Tick> axis_ticks(Scale scale, const Range& range, int most, TickText text = TickText::number);

}  // namespace diptych::core::chart
