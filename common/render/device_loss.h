// What happens when a device is lost while it renders.
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "render/session.h"

namespace diptych::core {

enum class OnDeviceLost {
    stop,   // what was rendered is kept
    retry,  // on the device, opened anew
    cpu,    // what is left, by the CPU
};

struct DeviceLossPolicy {
    OnDeviceLost choice = OnDeviceLost::stop;
    int retries = 3;         // before it stops all the same
    double first_pause = 1;  // seconds before the first retry; each pause is twice as long as the one before
    MakeRenderer cpu = {};   // for OnDeviceLost::cpu
    std::function<void(const std::string& line)> report = {};  // of every loss that is not the end
};

/// Repeats work that lost its device. Losses count over its whole life.
class LossGuard {
public:
    explicit LossGuard(DeviceLossPolicy policy) : policy_(std::move(policy)) {}

    /// Calls `work`. After a loss it waits, calls `renew` and then `work` once more. Throws DeviceLost where the policy
    /// is to stop, there were too many losses, or `cancel` is set.
    void run(const std::atomic<bool>& cancel, const std::function<void()>& work, const std::function<void()>& renew);

    /// The same for work on a session, which is renewed as the policy says. `renewed` is called before `work` is.
    void run(Session& session, const std::atomic<bool>& cancel, const std::function<void()>& work,
             const std::function<void()>& renewed = {});

    /// Opens a session. `open` is given nothing, or after a loss what is to make the renderer instead of the request's own.
    Session open(const std::function<Session(const MakeRenderer& instead)>& open);

    int losses() const { return losses_; }
    const DeviceLossPolicy& policy() const { return policy_; }

private:
    void wait(const std::string& reason, const std::atomic<bool>& cancel);

    DeviceLossPolicy policy_;
    int losses_ = 0;
};

}  // namespace diptych::core
