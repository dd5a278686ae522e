// Which barriers a sequence of passes needs, from what each of them says that it reads and writes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace diptych::core {

/// What one pass may hand on to another. Parts of a buffer that passes use apart are resources of their own.
enum class Resource : std::uint8_t {
    scene,       // its arrays, their addresses and the constants
    structures,  // acceleration structures of both levels
    build_scratch,
    film,
    first_vertices,
    reservoirs,
    reuse_surfaces,
    candidate_list,
    wave_paths,     // all of a WavePath but its radiance
    wave_radiance,  // which shadow rays add to while paths go on
    wave_first_hits,
    wave_queues,
    wave_hits,
    wave_shadows,
    wave_counts,
    recorded_rays,  // and their counters
    path_queries,
    path_records,
    histogram,
    readback,  // memory that the host reads
    count
};

/// Who uses it: each is a stage of the pipeline, with the accesses that it can make.
enum class Unit : std::uint8_t { transfer, build, compute, trace, indirect, host, count };

/// Appends commute: places are given out by atomic counters, and nobody reads until they are all there.
enum class Effect : std::uint8_t { read, write, append, count };

struct Use {
    Resource resource = Resource::scene;
    Unit unit = Unit::transfer;
    Effect effect = Effect::read;
};

/// A bit for every Unit.
using Units = std::uint8_t;
constexpr Units bit(Unit unit) {
    return static_cast<Units>(1U << static_cast<unsigned>(unit));
}

/// What comes before in these units has to end, and what it wrote has to be visible, before those units go on.
struct Barrier {
    Units before = 0;
    Units after = 0;
};

/// Follows a sequence of passes. It holds what has been used since the beginning and is not yet ordered before all
/// units.
class Hazards {
public:
    /// The barrier that has to stand before a pass with these uses, if it needs one. Uses of one pass may contradict
    /// one another: its shaders see to that.
    std::optional<Barrier> next(std::span<const Use> uses);

private:
    struct Mark {
        bool present = false;
        Units ordered = 0;  // before which units
    };
    using Marks =
        std::array<std::array<Mark, static_cast<std::size_t>(Unit::count)>, static_cast<std::size_t>(Effect::count)>;

    Barrier needed(const Use& use) const;
    void order(const Barrier& barrier);

    std::array<Marks, static_cast<std::size_t>(Resource::count)> marks_{};
};

}  // namespace diptych::core
