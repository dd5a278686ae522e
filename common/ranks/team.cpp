#include "ranks/team.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <filesystem>

#include "clock.h"

namespace diptych::core {

namespace {

constexpr std::size_t most_pending_words = 16U << 20U;  // of a film, on their way to one rank
constexpr auto waiting_interval = std::chrono::milliseconds(200);

Hello hello_of(const RankPlace& place) {
    std::error_code unknown;
    const std::string space = std::filesystem::read_symlink("/proc/self/ns/pid", unknown).string();
    return {place.host, place.host + " " + space, static_cast<std::uint64_t>(getpid())};
}

bool has_ended(std::uint64_t process) {
    return kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
}

}  // namespace

Team::Team(std::unique_ptr<RankChannel> channel, TeamHooks hooks)
    : hooks_(std::move(hooks)), coordinator_(channel->place().rank == 0 ? make_coordinator(channel->place()) : nullptr),
      heard_(now_seconds()), post_(std::move(channel), post_hooks()) {
    tell(0, Tell::hello, hello_of(place()).words());
}

std::unique_ptr<Coordinator> Team::make_coordinator(const RankPlace& place) {
    CoordinatorHooks head;
    head.send = [this](int to, Tell kind, std::vector<std::uint32_t> words) { tell(to, kind, std::move(words)); };
    head.warn = hooks_.warn;
    head.note = hooks_.note;
    head.adopt = [this](int rank) { return adopt_ ? adopt_(rank) : SampleRanges(); };
    head.has_ended = has_ended;
    return std::make_unique<Coordinator>(place, std::move(head), now_seconds());
}

PostHooks Team::post_hooks() {
    PostHooks hooks;
    hooks.message = [this](const Message& message) { on_message(message); };
    hooks.tick = [this] { tick(); };
    hooks.broken = [this](const std::string& reason) {
        const std::lock_guard lock(mutex_);
        hooks_.warn(fmt::format("the other ranks cannot be reached: {}", reason));
        on_order({.kind = Order::Kind::cut_off, .code = exit_no_rank, .alone = true});
    };
    return hooks;
}

void Team::tell(int to, Tell kind, std::vector<std::uint32_t> words) {
    post_.send(to, static_cast<std::uint32_t>(kind), std::move(words));
}

void Team::on_order(const Order& order) {
    const bool leaves = order.kind == Order::Kind::cut_off || order.kind == Order::Kind::end;
    cancel_ = cancel_ || order.kind == Order::Kind::stop || leaves;
    if (leaves) {
        end_ = order;
    }
    orders_.push_back(order);
    changed_.notify_all();
}

void Team::on_message(const Message& message) {
    const std::lock_guard lock(mutex_);
    if (message.from == 0) {
        heard_ = now_seconds();
    }
    switch (static_cast<Tell>(message.kind)) {
    case Tell::order:
        on_order(Order::of(message.words));
        break;
    case Tell::film:
        films_.push_back(message);
        changed_.notify_all();
        break;
    default:
        if (coordinator_) {
            coordinator_->handle(message, now_seconds());
        }
    }
}

void Team::tick() {
    const std::lock_guard lock(mutex_);
    if (hooks_.interrupted() && !told_interrupt_) {
        told_interrupt_ = true;
        tell(0, Tell::interrupted, WordWriter().put(static_cast<std::uint64_t>(hooks_.interrupt_code())).take());
    }
    if (coordinator_) {
        coordinator_->tick(now_seconds());
        return;
    }
    tell(0, Tell::alive);
    if (now_seconds() - heard_ > Coordinator::longest_silence) {
        heard_ = HUGE_VAL;  // once
        hooks_.warn(fmt::format("rank {} on {}: rank 0 has not answered for {:.0f} s; what this rank has is saved",
                                place().rank, place().host, Coordinator::longest_silence));
        on_order({.kind = Order::Kind::cut_off, .code = exit_no_rank, .alone = true});
    }
}

void Team::start(Work work, std::function<SampleRanges(int rank)> adopt) {
    const std::lock_guard lock(mutex_);
    adopt_ = std::move(adopt);
    coordinator_->start(std::move(work), now_seconds());
}

Coordinator::State Team::state() const {
    const std::lock_guard lock(mutex_);
    return coordinator_->state(now_seconds());
}

void Team::end(int code) {
    const std::lock_guard lock(mutex_);
    adopt_ = {};
    coordinator_->end(code);
}

void Team::ready(const Ready& ready) {
    tell(0, Tell::ready, ready.words());
}

Order Team::wait(const std::function<void()>& waiting, const std::function<bool(const Order&)>& wanted) {
    std::unique_lock lock(mutex_);
    for (;;) {
        while (!orders_.empty()) {
            const Order order = std::move(orders_.front());
            orders_.pop_front();
            if (wanted(order)) {
                return order;
            }
        }
        changed_.wait_for(lock, waiting_interval, [&] { return !orders_.empty(); });
        if (waiting) {
            lock.unlock();
            waiting();
            lock.lock();
        }
    }
}

Order Team::next(const std::function<void()>& waiting) {
    tell(0, Tell::ask);
    return wait(waiting, [](const Order& order) { return order.kind != Order::Kind::abandon; });
}

Order Team::merged(std::uint64_t attempt) {
    tell(0, Tell::merged, WordWriter().put(attempt).take());
    return wait({}, [](const Order& order) { return order.kind != Order::Kind::abandon; });
}

void Team::tell_lost(const std::string& reason) {
    tell(0, Tell::lost, WordWriter().put(reason).take());
}

void Team::tell_gave_up(const std::string& reason) {
    tell(0, Tell::gave_up, WordWriter().put(reason).take());
}

void Team::tell_saved(std::uint64_t samples) {
    tell(0, Tell::saved, WordWriter().put(samples).take());
}

void Team::tell_note(const std::string& text) {
    tell(0, Tell::note, WordWriter().put(text).take());
}

Order Team::wait_for_end() {
    {
        const std::lock_guard lock(mutex_);
        if (end_) {
            return *end_;
        }
    }
    return wait({}, [&](const Order& order) {
        if (order.kind == Order::Kind::stop) {
            tell_saved(0);  // nothing more to save
        }
        return order.kind == Order::Kind::end || order.kind == Order::Kind::cut_off;
    });
}

Order Team::wait_for_saved() {
    return wait({}, [](const Order& order) { return order.kind == Order::Kind::finished || order.kind == Order::Kind::cut_off; });
}

bool Team::send_film(int to, std::vector<std::uint32_t> words) {
    tell(to, Tell::film, std::move(words));
    while (post_.pending_words(to) > most_pending_words) {
        std::unique_lock lock(mutex_);
        if (changed_.wait_for(lock, std::chrono::microseconds(200), [&] { return !orders_.empty(); })) {
            return false;
        }
    }
    return true;
}

std::optional<std::vector<std::uint32_t>> Team::receive_film(int from, std::uint64_t attempt) {
    std::unique_lock lock(mutex_);
    for (;;) {
        for (auto i = films_.begin(); i != films_.end();) {
            const std::uint64_t of_attempt = WordReader(i->words).number();
            if (of_attempt == attempt && i->from == from) {
                std::vector<std::uint32_t> words = std::move(i->words);
                films_.erase(i);
                return words;
            }
            i = of_attempt < attempt ? films_.erase(i) : i + 1;
        }
        if (!orders_.empty()) {
            return std::nullopt;
        }
        changed_.wait(lock);
    }
}

void Team::leave(const Order& end) {
    post_.leave(end.alone);
}

}  // namespace diptych::core
