#include "measure/converge/runner.h"

#include <algorithm>

#include "clock.h"

namespace diptych::core {

namespace {

constexpr double warm_seconds = 0.2;
constexpr std::uint32_t most_spp = 1U << 24U;

}  // namespace

MethodRunner::Entry& MethodRunner::entry(std::uint32_t sample_count) {
    Entry& entry = entries_[method_.laid_out() ? sample_count : 0];
    if (!entry.session) {
        RenderRequest request = method_.request;
        request.settings.sample_count = std::max(sample_count, 1U);
        entry.session.emplace(open_(scene_, request, false));
    }
    return entry;
}

const Session& MethodRunner::opened() {
    static const std::atomic<bool> never = false;
    guard_.run(never, [&] { entry(1); }, [&] { entries_.clear(); });
    return *entry(1).session;
}

std::string MethodRunner::device() {
    return opened().renderer().device();
}

MethodSetup MethodRunner::setup() {
    const Session& session = opened();
    const RendererCosts costs = session.renderer().costs();
    return {session.renderer().device(), session.pack_seconds(), costs.build_seconds, costs.compile_seconds,
            costs.bytes};
}

void MethodRunner::warm_up(Entry& entry, const std::atomic<bool>& cancel) {
    if (entry.warm) {
        return;
    }
    const double begin = now_seconds();
    for (std::uint32_t i = 0; i < 1024 && !cancel && (i == 0 || now_seconds() - begin < warm_seconds); ++i) {
        entry.session->render(i, 1, cancel);
    }
    entry.warm = true;
}

bool MethodRunner::run(std::uint32_t seed, const std::vector<std::uint32_t>& counts, const std::atomic<bool>& cancel,
                       const Checkpoint& checkpoint) {
    bool whole = false;
    std::uint32_t told = 0;
    const Checkpoint once = [&](std::uint32_t spp, const Film& film, double device_seconds, double wall_seconds) {
        if (spp > told) {
            checkpoint(spp, film, device_seconds, wall_seconds);
            told = spp;
        }
    };
    guard_.run(cancel, [&] { whole = render_run(seed, counts, cancel, once); }, [&] { entries_.clear(); });
    return whole;
}

std::uint32_t MethodRunner::samples_within(double seconds, const std::atomic<bool>& cancel) {
    std::uint32_t fits = 0;
    guard_.run(cancel, [&] { fits = count_samples(seconds, cancel); }, [&] { entries_.clear(); });
    return fits;
}

bool MethodRunner::render_run(std::uint32_t seed, const std::vector<std::uint32_t>& counts,
                              const std::atomic<bool>& cancel, const Checkpoint& checkpoint) {
    double device_seconds = 0, wall_seconds = 0;
    std::uint32_t done = 0;
    bool fresh = true;
    for (const std::uint32_t count : counts) {
        Entry& at_work = entry(count);
        warm_up(at_work, cancel);
        if (fresh || method_.laid_out()) {
            at_work.session->restart(seed);
            fresh = false;
            device_seconds = wall_seconds = 0;
            done = 0;
        }
        const double device_before = at_work.session->renderer().device_seconds();
        const double wall_before = now_seconds();
        at_work.session->render(done, count - done, cancel);
        wall_seconds += now_seconds() - wall_before;
        device_seconds += at_work.session->renderer().device_seconds() - device_before;
        if (cancel) {
            return false;
        }
        done = count;
        checkpoint(count, at_work.session->film(), device_seconds, wall_seconds);
    }
    return true;
}

std::uint32_t MethodRunner::count_samples(double seconds, const std::atomic<bool>& cancel) {
    Entry& at_work = entry(1);
    warm_up(at_work, cancel);
    std::uint32_t fits = 1;
    for (int pass = 0; pass < 2;
         ++pass) {  // the first is slower than what follows, where dispatches still find their size
        at_work.session->restart(method_.request.settings.seed);
        const double before = at_work.session->renderer().device_seconds();
        std::uint32_t done = 0;
        for (std::uint32_t count = 1; count <= most_spp; count *= 2) {
            at_work.session->render(done, count - done, cancel);
            if (cancel) {
                return 0;
            }
            done = count;
            const double taken = at_work.session->renderer().device_seconds() - before;
            if (taken <= seconds) {
                fits = std::max(fits, count);
            }
            if (2 * taken > 1.1 * seconds) {  // the next would not fit; the tenth is for noise
                break;
            }
        }
    }
    return fits;
}

}  // namespace diptych::core
