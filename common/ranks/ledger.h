// Which rank renders what.
#pragma once

#include <optional>
#include <vector>

#include "render/sample_ranges.h"

namespace diptych::core {

struct LedgerLimits {
    double least_seconds = 0.03;  // of a block; shorter ones would cost more than they even out
    double most_seconds = 1;
    std::uint64_t most_units = 0xffffffffU;  // of a block
    double seconds = 0;                      // no unit is begun that would end later; 0 is no limit
};

/// Deals out units, which are samples or frames, in blocks. A block is half of the rank's share of what is left, by its
/// speed so far, so that all ranks end within about a block of the least length.
class Ledger {
public:
    Ledger(SampleRanges wanted, int ranks, LedgerLimits limits = {});

    /// A block for a rank that has none; none where there is nothing left to deal out. `now` counts seconds from the
    /// start.
    std::optional<SampleRange> deal(int rank, double now);

    /// A rank has rendered its block.
    void finish(int rank, double now);

    /// A rank has lost all that it has finished, but for `safe`. Any rank may get it.
    void drop_finished(int rank, const SampleRanges& safe = {});

    /// The same, and the rank does not finish the block that it has, which may be safe too.
    void drop(int rank, const SampleRanges& safe = {});

    /// Nothing is left to deal out, and no rank has a block.
    bool complete() const;

    const SampleRanges& finished_by(int rank) const { return share(rank).finished; }
    bool has_block(int rank) const { return share(rank).block.has_value(); }
    SampleRanges finished() const;
    /// Units that are left, blocks under way among them; all up to 2^32 where only the time is limited.
    std::uint64_t left() const;

private:
    struct Share {
        std::optional<SampleRange> block;
        double begun = 0;
        double speed = 0;  // units a second; 0 is not known
        std::uint64_t last_block = 0;
        SampleRanges finished;
    };

    const Share& share(int rank) const { return shares_[static_cast<std::size_t>(rank)]; }
    std::uint64_t block_size(const Share& share, double now) const;
    double total_speed() const;

    LedgerLimits limits_;
    SampleRanges free_;
    SampleRanges safe_;  // finished, and not by a rank that has it still
    std::vector<Share> shares_;
};

}  // namespace diptych::core
