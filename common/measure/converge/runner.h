// A method at work: its renderers, and how long they take.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <optional>

#include "measure/converge/method.h"
#include "measure/converge/state.h"
#include "measure/open_session.h"
#include "render/device_loss.h"

namespace diptych::core {

/// A run's film after `spp` samples a pixel, and the seconds until then, of rendering alone.
using Checkpoint = std::function<void(std::uint32_t spp, const Film& film, double device_seconds, double wall_seconds)>;

/// Makes its renderers when they are first needed. A Hammersley set is laid out for a number of samples, so there each
/// count has a renderer and a render of its own; otherwise a run is one render that grows.
class MethodRunner {
public:
    /// `scene` must live as long.
    MethodRunner(const Scene& scene, Method method, OpenSession open, const DeviceLossPolicy& device_loss = {})
        : scene_(scene), method_(std::move(method)), open_(std::move(open)), guard_(device_loss) {}

    const Method& method() const { return method_; }
    /// These build it where it is not.
    std::string device();
    MethodSetup setup();

    /// Calls back at each of the counts, which ascend; false where `cancel` came in between. After a loss of the device
    /// the run begins anew, without calling back twice for one count.
    bool run(std::uint32_t seed, const std::vector<std::uint32_t>& counts, const std::atomic<bool>& cancel,
             const Checkpoint& checkpoint);

    /// The largest power of two of samples that takes at most so many seconds, at least 1; 0 where `cancel` came in
    /// between.
    std::uint32_t samples_within(double seconds, const std::atomic<bool>& cancel);

private:
    struct Entry {
        std::optional<Session> session;
        bool warm = false;
    };

    Entry& entry(std::uint32_t sample_count);
    const Session& opened();
    bool render_run(std::uint32_t seed, const std::vector<std::uint32_t>& counts, const std::atomic<bool>& cancel,
                    const Checkpoint& checkpoint);
    std::uint32_t count_samples(double seconds, const std::atomic<bool>& cancel);
    /// Renders a few samples that count for nothing, once: devices clock up, dispatches find their size.
    static void warm_up(Entry& entry, const std::atomic<bool>& cancel);

    const Scene& scene_;
    Method method_;
    OpenSession open_;
    LossGuard guard_;
    std::map<std::uint32_t, Entry> entries_;  // by the count that it is laid out for; 0 where that does not matter
};

}  // namespace diptych::core
