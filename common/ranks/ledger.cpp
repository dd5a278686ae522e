#include "ranks/ledger.h"

#include <algorithm>
#include <cmath>

namespace diptych::core {

namespace {

constexpr std::uint64_t largest_growth = 4;  // from block to block: the first ones are too short to measure well

}  // namespace

Ledger::Ledger(SampleRanges wanted, int ranks, LedgerLimits limits)
    : limits_(limits), free_(std::move(wanted)), shares_(static_cast<std::size_t>(ranks)) {}

/// A rank whose speed is not known is taken to be as fast as the others.
double Ledger::total_speed() const {
    double known = 0;
    std::size_t count = 0;
    for (const Share& share : shares_) {
        known += share.speed;
        count += share.speed > 0 ? 1 : 0;
    }
    return count == 0 ? 0 : known * static_cast<double>(shares_.size()) / static_cast<double>(count);
}

std::uint64_t Ledger::block_size(const Share& share, double now) const {
    if (share.speed <= 0) {
        return 1;
    }
    double seconds = static_cast<double>(free_.count()) / total_speed() / 2;
    seconds = std::clamp(seconds, limits_.least_seconds, limits_.most_seconds);
    double units = std::max(1.0, std::floor(share.speed * seconds));
    if (limits_.seconds > 0) {
        units = std::min(units, std::round(share.speed * std::max(0.0, limits_.seconds - now)));
    }
    return std::min(static_cast<std::uint64_t>(units), share.last_block * largest_growth);
}

std::optional<SampleRange> Ledger::deal(int rank, double now) {
    Share& share = shares_[static_cast<std::size_t>(rank)];
    if (limits_.seconds > 0 && now >= limits_.seconds) {
        limits_.seconds = 0;  // what is dropped from now on is rendered all the same, or samples would be missing
        free_ = {};
    }
    const std::uint64_t size = free_.empty() ? 0 : std::min(block_size(share, now), limits_.most_units);
    if (size == 0) {
        return std::nullopt;
    }
    const SampleRange front = free_.ranges().front();
    const SampleRange block{front.first, std::min(front.first + size, front.end)};
    free_ = free_.without(SampleRanges(block));
    share.block = block;
    share.begun = now;
    return block;
}

void Ledger::finish(int rank, double now) {
    Share& share = shares_[static_cast<std::size_t>(rank)];
    if (!share.block) {
        return;
    }
    share.last_block = share.block->end - share.block->first;
    share.speed = static_cast<double>(share.last_block) / std::max(now - share.begun, 1e-9);
    share.finished.add(*share.block);
    share.block.reset();
}

void Ledger::drop_finished(int rank, const SampleRanges& safe) {
    Share& share = shares_[static_cast<std::size_t>(rank)];
    const SampleRanges lost = share.finished.without(safe);
    safe_.add(share.finished.without(lost));
    free_.add(lost);
    share.finished = {};
}

void Ledger::drop(int rank, const SampleRanges& safe) {
    Share& share = shares_[static_cast<std::size_t>(rank)];
    drop_finished(rank, safe);
    if (share.block) {  // which may be on the disk although the rank did not live to say so
        const SampleRanges block(*share.block);
        const SampleRanges lost = block.without(safe);
        safe_.add(block.without(lost));
        free_.add(lost);
    }
    share = {};
}

bool Ledger::complete() const {
    return free_.empty() &&
           std::none_of(shares_.begin(), shares_.end(), [](const Share& share) { return share.block.has_value(); });
}

SampleRanges Ledger::finished() const {
    SampleRanges all = safe_;
    for (const Share& share : shares_) {
        all.add(share.finished);
    }
    return all;
}

std::uint64_t Ledger::left() const {
    std::uint64_t left = free_.count();
    for (const Share& share : shares_) {
        left += share.block ? share.block->end - share.block->first : 0;
    }
    return left;
}

}  // namespace diptych::core
