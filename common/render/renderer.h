// One panel of the diptych, as the rest of the program sees it.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "error.h"
#include "render/film.h"
#include "render/recorded_path.h"
#include "render/resampling_schedule.h"

namespace diptych::core {

struct PackedScene;

/// What a renderer can do beside pictures at rest; what it cannot do throws Error.
struct Capabilities {
    bool chains = false;        // clear_film: pictures go on from one another
    bool reconfigures = false;  // reconfigure
    bool reservoirs = false;    // watch_reservoirs
    bool paths = false;         // record_paths and summarize_paths
};

/// Seconds spent before the first sample, and bytes held.
struct RendererCosts {
    double build_seconds = 0;              // acceleration structures and uploads
    double compile_seconds = 0;            // pipelines
    std::uint64_t bytes = 0;               // buffers, acceleration structures, film
    std::uint64_t acceleration_bytes = 0;  // of these, the structures
    std::uint64_t pass_bytes = 0;          // of these, what passes hand on to each other
};

/// Called before a step that may take long, with what it is: "compiling 9 pipelines".
using BusyHook = std::function<void(const std::string& what)>;

/// The same rays twice: inside the integrator, and alone.
struct TraversalBench {
    std::uint64_t rays = 0;
    double integrator_seconds = 0;  // tracing and shading them
    double bare_seconds = 0;        // tracing them again, nothing else
};

/// One pass of ris or restir, all its frames together.
struct PassTime {
    std::string pass;  // of pass_names
    double seconds = 0;
};

/// Called with what a pass of ris or restir has left: the reservoirs of all pixels, row-major from the top.
using ReservoirHook = std::function<void(const ResamplingStep&, std::span<const shared::Reservoir>)>;

class Renderer {
public:
    Renderer() = default;
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;
    virtual ~Renderer() = default;

    /// "cpu", "vulkan" or "oracle".
    virtual std::string backend() const = 0;
    /// The device's own name.
    virtual std::string device() const = 0;
    virtual RendererCosts costs() const = 0;
    virtual Capabilities capabilities() const = 0;

    /// Adds samples first .. first+count-1 to every pixel. Stops early, between slices of at most about 200 ms, once
    /// `cancel` is set; the film is valid then too, since every pixel counts its own samples.
    virtual void render(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) = 0;

    /// Empties the film and goes on with another seed: what follows has the bits of a new renderer with that seed,
    /// without building anything anew. Time and costs go on counting.
    virtual void restart(std::uint32_t seed) = 0;

    /// Empties the film for the next picture of a chain: the seed stays, and so does what restir keeps from frame to
    /// frame, as long as the sample indices go on too.
    virtual void clear_film() { throw Error("`backend` " + backend() + ": begins every picture anew"); }

    /// Goes on with another moment of its scene: `moment` is what it was made from, after pack_moment, or a copy with
    /// the same meshes. Takes only what moves. Film and seed stay; restart begins a new picture. The CPU panel refers
    /// to `moment` from then on, and to the meshes of the first. Throws Error where the counts differ, and may where an
    /// instance has moved that PackedScene::instance_moves said would not.
    virtual void move_to(const PackedScene& moment) = 0;

    /// Goes on with other settings of the same scene: `packed` is pack_scene of it under them. The film begins anew
    /// with packed.constants.seed and no history; what follows has the bits of a new renderer. What the settings do not
    /// touch stays: geometry, acceleration structures, pipelines met before. The CPU panel refers to `packed` from then
    /// on, and to the vertices and triangles of the first pack. Throws Error where the backend cannot.
    virtual void reconfigure(const PackedScene&) {
        throw Error("`backend` " + backend() + ": cannot go on with other settings");
    }

    /// Seconds the device itself worked on `render` calls so far: timestamps on a GPU, wall clock on the CPU.
    virtual double device_seconds() const = 0;

    /// Of these, each pass of ris or restir; empty for other integrators, or where the device has no clock.
    virtual std::vector<PassTime> pass_times() const { return {}; }

    /// From now on, after every pass. Throws Error where the backend cannot.
    virtual void watch_reservoirs(ReservoirHook) { throw Error("`backend` " + backend() + ": has no reservoirs"); }

    /// A copy of what has been accumulated.
    virtual Film film() const = 0;

    /// The same without the copy where the backend has the film in this memory. Valid until the film changes.
    virtual std::shared_ptr<const Film> film_in_place() const { return std::make_shared<const Film>(film()); }

    /// Measures `samples` samples a pixel, leaving the film alone.
    virtual TraversalBench bench_traversal(std::uint32_t samples) = 0;

    /// Traces the paths listed, leaving the film alone, and returns all that each of them did, or a summary for the
    /// many; under the film's seed, or another that is given. Throws Error where the backend cannot.
    virtual std::vector<RecordedPath> record_paths(std::span<const shared::PathQuery>,
                                                   std::optional<std::uint32_t> = {}) {
        refuse_paths();
    }
    virtual std::vector<shared::PathSummary> summarize_paths(std::span<const shared::PathQuery>) { refuse_paths(); }

private:
    [[noreturn]] void refuse_paths() const { throw Error("`backend` " + backend() + ": keeps no record of its paths"); }
};

}  // namespace diptych::core
