// Computes the barriers of a sequence of passes from the resources that each pass reads and writes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace diptych::core {

/// What one pass may write and another read. Parts of a buffer that passes use separately are separate resources.
enum class Resource : std::uint8_t {
    scene,       // arrays of the scene, their addresses and the constants
    structures,  // acceleration structures, bottom and top levels
    build_scratch,
    film,
    first_vertices,
    reservoirs,
    reuse_surfaces,
    candidate_list,
    wave_paths,     // everything in a WavePath except its radiance
    wave_radiance,  // shadow rays add to it while the paths continue
    wave_first_hits,
    wave_queues,
    wave_hits,
    wave_shadows,
    wave_counts,
    recorded_rays,  // with their counters
    path_queries,
    path_records,
    histogram,
    readback,  // memory that the host reads
    count
};

/// The user of a resource: a pipeline stage with the accesses that it can make.
enum class Unit : std::uint8_t { transfer, build, compute, trace, indirect, host, count };

/// Appends commute: atomic counters assign the positions, and nothing reads before all appends have ended.
enum class Effect : std::uint8_t { read, write, append, count };

struct Use {
    Resource resource = Resource::scene;
    Unit unit = Unit::transfer;
    Effect effect = Effect::read;
};

/// A set with one bit for each Unit.
using Units = std::uint8_t;
constexpr Units bit(Unit unit) {
    return static_cast<Units>(1U << static_cast<unsigned>(unit));
}

/// Earlier work in the units `before` has to end, with its writes visible, before the units `after` start.
struct Barrier {
    Units before = 0;
    Units after = 0;
};

/// Tracks a sequence of passes. It holds every use since the beginning that is not yet ordered before all units.
class Hazards {
public:
    /// The barrier that is needed before a pass with these uses, if any. Uses of the same pass may conflict: its
    /// shaders resolve that.
    std::optional<Barrier> next(std::span<const Use> uses);

private:
    struct Mark {
        bool present = false;
        Units ordered = 0;  // units that are ordered after this use
    };
    using Marks =
        std::array<std::array<Mark, static_cast<std::size_t>(Unit::count)>, static_cast<std::size_t>(Effect::count)>;

    Barrier needed(const Use& use) const;
    void order(const Barrier& barrier);

    std::array<Marks, static_cast<std::size_t>(Resource::count)> marks_{};
};

}  // namespace diptych::core
