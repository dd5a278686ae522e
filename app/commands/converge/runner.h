// A method at work: its renderers, and how long they take.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <optional>

#include "commands/converge/plan.h"
#include "render/session.h"
#include "scene/scene.h"

namespace diptych::app {

/// What it took before the first sample.
struct SetupCosts {
    double pack_seconds = 0;
    double build_seconds = 0;
    double compile_seconds = 0;
    std::uint64_t bytes = 0;
};

/// A run's film after `spp` samples a pixel, and the seconds until then, of rendering alone.
using Checkpoint = std::function<void(std::uint32_t spp, const Film& film, double device_seconds, double wall_seconds)>;

/// Makes its renderers when they are first needed. A Hammersley set is laid out for a number of samples, so there each
/// count has a renderer and a render of its own; otherwise a run is one render that grows.
class MethodRunner {
public:
    MethodRunner(const Scene& scene, Method method) : scene_(scene), method_(std::move(method)) {}

    const Method& method() const { return method_; }
    bool made() const { return !entries_.empty(); }
    bool noted = false;  // its costs have been written down
    std::string device();
    SetupCosts costs();

    /// Renders a few samples that count for nothing, once: devices clock up, dispatches find their size.
    void warm_up(const std::atomic<bool>& cancel);

    /// Calls back at each of the counts, which ascend; false where `cancel` came in between.
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
    static void warm_up(Entry& entry, const std::atomic<bool>& cancel);

    const Scene& scene_;
    Method method_;
    std::map<std::uint32_t, Entry> entries_;  // by the count that it is laid out for; 0 where that does not matter
};

}  // namespace diptych::app
