#include "ranks/coordinator.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::core {

Coordinator::Coordinator(RankPlace place, CoordinatorHooks hooks, double now)
    : place_(std::move(place)), hooks_(std::move(hooks)), ledger_({}, place_.size),
      ranks_(static_cast<std::size_t>(place_.size)) {
    for (Rank& rank : ranks_) {
        rank.heard = now;
    }
}

std::string Coordinator::name(int rank) const {
    const Hello& hello = at(rank).hello;
    return hello.host.empty() ? fmt::format("rank {}", rank)
                              : fmt::format("rank {} on {} (process {})", rank, hello.host, hello.process);
}

void Coordinator::order(int rank, const Order& order) {
    hooks_.send(rank, Tell::order, order.words());
}

void Coordinator::start(Work work, double now) {
    work_ = std::move(work);
    ledger_ = Ledger(work_.wanted, place_.size, work_.limits);
    begin_ = end_ = now;
    if (phase_ == Phase::waiting) {
        phase_ = Phase::rendering;
        for (int rank = 0; rank < place_.size; ++rank) {
            check_picture(rank);
            if (!at(rank).excuse.empty()) {
                hooks_.warn(fmt::format("{}{}; the others render without it", name(rank), at(rank).excuse));
            }
        }
    }
    answer(now);
}

/// A rank that reads another file than rank 0 would spoil the picture.
void Coordinator::check_picture(int rank) {
    if (phase_ != Phase::waiting && at(rank).ready && !at(rank).retired && at(rank).ready->picture != work_.picture) {
        hooks_.warn(fmt::format("{} renders another picture: its scene or its program differs from rank 0's; it is left "
                                "out",
                                name(rank)));
        at(rank).retired = true;
    }
}

void Coordinator::handle(const Message& message, double now) {
    Rank& rank = at(message.from);
    rank.heard = now;
    if (rank.gone) {
        // Its work is others' already.
        order(message.from, {.kind = Order::Kind::end, .code = exit_no_rank, .alone = true});
        return;
    }
    WordReader reader(message.words);
    switch (static_cast<Tell>(message.kind)) {
    case Tell::hello:
        rank.hello = Hello::of(message.words);
        break;
    case Tell::ready:
        rank.ready = Ready::of(message.words);
        check_picture(message.from);
        break;
    case Tell::ask:
        if (ledger_.has_block(message.from)) {
            ledger_.finish(message.from, now - begin_);
            end_ = now;
        }
        rank.asks = true;
        break;
    case Tell::merged:
        rank.asks = true;
        if (phase_ == Phase::merging && reader.number() == attempt_) {
            phase_ = Phase::finished;
        }
        break;
    case Tell::lost:
        lose(message.from, ": " + reader.text());
        break;
    case Tell::gave_up:
        rank.retired = true;
        lose(message.from, ": " + reader.text());
        break;
    case Tell::interrupted:
        stop(reader.integer());
        break;
    case Tell::saved:
        rank.saved = true;
        if (const std::uint64_t units = reader.number(); units > 0) {
            saved_.parts_saved += 1;
            saved_.units_saved += units;
        }
        check_saved();
        break;
    case Tell::note:
        hooks_.note(reader.text());
        break;
    default:
        break;
    }
    answer(now);
}

/// What a rank had goes to the others, but for what it has written to the disk.
void Coordinator::lose(int rank, const std::string& how) {
    const bool was_merging = std::count(merging_.begin(), merging_.end(), rank) > 0;
    if (phase_ == Phase::waiting) {  // what ails all ranks, rank 0 says itself
        at(rank).excuse = how;
        return;
    }
    if (phase_ == Phase::finished || phase_ == Phase::stopping) {
        hooks_.warn(name(rank) + how);
        check_saved();
        return;
    }
    const std::uint64_t had = ledger_.finished_by(rank).count();
    const SampleRanges safe = work_.merges ? hooks_.adopt(rank) : ledger_.finished_by(rank);
    // A rank that goes on keeps its block: only what it has finished is lost.
    const bool goes_on = !at(rank).gone && !at(rank).retired;
    if (goes_on) {
        ledger_.drop_finished(rank, safe);
    } else {
        ledger_.drop(rank, safe);
    }
    hooks_.warn(had == 0 && safe.empty()
                    ? fmt::format("{}{}; the others render without it", name(rank), how)
                    : fmt::format("{}{}; {} of its {} {} are on the disk, and the rest is rendered again", name(rank),
                                  how, safe.count(), had, work_.unit));
    if (was_merging && phase_ == Phase::merging) {
        for (const int other : merging_) {
            at(other).merges = false;
            if (other != rank) {
                order(other, {.kind = Order::Kind::abandon, .attempt = attempt_});
            }
        }
        merging_.clear();
        phase_ = Phase::rendering;
    }
    const bool anyone = std::any_of(ranks_.begin(), ranks_.end(), [](const Rank& r) { return !r.gone && !r.retired; });
    if (!anyone && !ledger_.complete()) {
        stop(exit_no_rank);
    }
}

void Coordinator::stop(int code) {
    if (phase_ == Phase::finished || phase_ == Phase::stopping) {
        return;
    }
    phase_ = Phase::stopping;
    stop_code_ = code;
    for (int rank = 0; rank < place_.size; ++rank) {
        if (!at(rank).gone) {
            order(rank, {.kind = Order::Kind::stop, .code = code});
        }
    }
}

void Coordinator::check_saved() {
    const bool all =
        std::all_of(ranks_.begin(), ranks_.end(), [](const Rank& r) { return r.saved || r.gone || r.retired; });
    if (phase_ == Phase::stopping && all) {
        order(0, {.kind = Order::Kind::finished, .code = stop_code_});
    }
}

void Coordinator::begin_merge() {
    phase_ = Phase::merging;
    attempt_ += 1;
    merging_ = {0};
    for (int rank = 1; rank < place_.size; ++rank) {
        if (!at(rank).gone && !ledger_.finished_by(rank).empty()) {
            merging_.push_back(rank);
        }
    }
}

void Coordinator::answer_rank(int rank, double now) {
    Rank& asking = at(rank);
    if (phase_ == Phase::rendering && !asking.retired && asking.ready) {
        if (const std::optional<SampleRange> block = ledger_.deal(rank, now - begin_)) {
            asking.asks = false;
            order(rank, {.kind = Order::Kind::render, .block = *block});
        }
    } else if (phase_ == Phase::merging && !asking.merges &&
               std::count(merging_.begin(), merging_.end(), rank) > 0) {
        asking.asks = false;
        asking.merges = true;
        order(rank, {.kind = Order::Kind::merge, .attempt = attempt_, .ranks = merging_});
    } else if (phase_ == Phase::finished && rank == 0) {
        asking.asks = false;
        order(0, {.kind = Order::Kind::finished});
    }
}

void Coordinator::answer(double now) {
    for (int rank = 0; rank < place_.size; ++rank) {
        if (at(rank).asks && !at(rank).gone) {
            answer_rank(rank, now);
        }
    }
    // Dealing may find that time is up, so whether all is done is known after it.
    if (phase_ == Phase::rendering && ledger_.complete()) {
        if (work_.merges) {
            begin_merge();
        } else {
            phase_ = Phase::finished;
        }
        answer(now);
    }
}

void Coordinator::tick(double now) {
    for (int rank = 1; rank < place_.size; ++rank) {
        Rank& other = at(rank);
        if (other.gone) {
            continue;
        }
        const bool ended = other.hello.process > 0 && other.hello.process_space == at(0).hello.process_space &&
                           hooks_.has_ended(other.hello.process);
        if (ended || now - other.heard > longest_silence) {
            other.gone = true;
            other.asks = false;
            saved_.anyone_died = true;
            lose(rank, ended ? " has died" : fmt::format(" has not answered for {:.0f} s", now - other.heard));
        } else {
            hooks_.send(rank, Tell::alive, {});
        }
    }
    answer(now);
}

void Coordinator::end(int code) {
    for (int rank = 1; rank < place_.size; ++rank) {
        order(rank, {.kind = Order::Kind::end, .code = code, .alone = saved_.anyone_died});
    }
}

Coordinator::State Coordinator::state(double now) const {
    State state = saved_;
    state.samples = ledger_.finished();
    state.finished = state.samples.count();
    state.ranks = place_.size;
    state.left = ledger_.left();
    state.seconds = phase_ == Phase::rendering ? now - begin_ : end_ - begin_;
    for (int rank = 0; rank < place_.size; ++rank) {
        if (!ledger_.finished_by(rank).empty()) {
            state.devices[at(rank).ready->device] += 1;
        }
    }
    return state;
}

}  // namespace diptych::core
