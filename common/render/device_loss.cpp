#include "render/device_loss.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <optional>
#include <thread>

#include "clock.h"
#include "error.h"

namespace diptych::core {

/// Counts a loss, and waits until the next try. Throws DeviceLost where there is none.
void LossGuard::wait(const std::string& reason, const std::atomic<bool>& cancel) {
    ++losses_;
    if (policy_.choice == OnDeviceLost::stop || cancel) {
        throw DeviceLost(reason);
    }
    if (policy_.choice == OnDeviceLost::cpu) {
        if (losses_ > 1) {
            throw DeviceLost(reason);
        }
        if (policy_.report) {
            policy_.report(reason + "; the CPU goes on");
        }
        return;
    }
    if (losses_ > policy_.retries) {
        throw DeviceLost(fmt::format("{}; it was opened anew {} times", reason, policy_.retries));
    }
    const double pause = policy_.first_pause * std::exp2(losses_ - 1);
    if (policy_.report) {
        policy_.report(fmt::format("{}; retry {} of {} in {:.0f} s", reason, losses_, policy_.retries, pause));
    }
    const Stopwatch watch;
    while (watch.seconds() < pause && !cancel) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

void LossGuard::run(const std::atomic<bool>& cancel, const std::function<void()>& work,
                    const std::function<void()>& renew) {
    bool lost = false;
    while (true) {
        try {
            if (lost) {
                renew();
            }
            work();
            return;
        } catch (const DeviceLost& error) {
            wait(error.what(), cancel);
        } catch (const NoDevice& error) {
            if (!lost) {
                throw;
            }
            wait(error.what(), cancel);  // the device may come back
        }
        lost = true;
    }
}

void LossGuard::run(Session& session, const std::atomic<bool>& cancel, const std::function<void()>& work,
                    const std::function<void()>& renewed) {
    run(cancel, work, [&] {
        session.renew(policy_.choice == OnDeviceLost::cpu ? policy_.cpu : MakeRenderer());
        if (renewed) {
            renewed();
        }
    });
}

Session LossGuard::open(const std::function<Session(const MakeRenderer& instead)>& open) {
    static const std::atomic<bool> never = false;
    std::optional<Session> session;
    MakeRenderer instead;
    run(never, [&] { session.emplace(open(instead)); },
        [&] { instead = policy_.choice == OnDeviceLost::cpu ? policy_.cpu : MakeRenderer(); });
    return std::move(*session);
}

}  // namespace diptych::core
