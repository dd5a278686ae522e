// Paths in waves (shaders/wave.glsl): the passes, and their memory for every path in flight.
#pragma once

#include <cstdint>

#include "passes/pass.h"

namespace diptych::core {

/// Number of paths in flight where `paths` are to be traced: all of them, within bounds and a share of the device's
/// memory.
std::uint32_t path_capacity(const Gpu& gpu, std::uint64_t paths);

/// Fewer paths at a time cost time and change no result. Below this number a wave is mostly its fixed cost.
inline constexpr std::uint32_t fewest_paths = 4096;

struct WaveMemory {
    std::uint32_t wanted = 0;    // paths
    std::uint32_t capacity = 0;  // paths that there was memory for
    Buffer paths;
    Buffer first_hits;  // allocated if the film has first-hit layers
    Buffer queues;
    Buffer hits;
    Buffer shadows;  // allocated if lights are sampled
    Buffer counts;
};

/// For `capacity` paths, or half as many, and so on down to fewest_paths, where memory is short.
WaveMemory make_wave_memory(const Gpu& gpu, std::uint32_t capacity, std::uint32_t features);

/// Bytes of one path.
std::uint64_t wave_path_bytes(std::uint32_t features);

/// Whether the memory was made for at least that capacity, and has exactly the buffers that `features` needs.
bool fits(const WaveMemory& memory, std::uint32_t capacity, std::uint32_t features);

std::uint64_t wave_memory_bytes(const WaveMemory& memory);

void enter_waves(SceneAddresses& addresses, const WaveMemory& memory);

/// Pipelines of the passes. Not owned.
struct WavePipelines {
    const ComputePipeline* begin = nullptr;
    bool begin_appends = false;           // true: appends only paths that continue; false: appends all
    const TracePipeline* rays = nullptr;  // this and the following: null if no path continues
    const ComputePipeline* shade = nullptr;
    const TracePipeline* shadows = nullptr;  // null if no light is sampled
    const ComputePipeline* film = nullptr;   // null: the first pass adds to the film itself
};

/// The waves of one slice, which must fit into the memory. Deep paths may need several submissions.
class SliceWaves {
public:
    static constexpr std::uint32_t most_steps = 128;  // per submission

    /// `request` holds parameters of the passes beside the slice: room for recorded rays, and a pass of resampling.
    SliceWaves(const WavePipelines& pipelines, const PipelineLayout& layout, const Bindings& bindings,
               const WaveMemory& memory, const Slice& slice, const shared::Dispatch& request = {});

    /// Records the start of all paths. Must come first in a submission.
    void begin(Recorder& recorder);
    /// Records one step: each path that continues traces one ray, while the shadow rays of the previous step are
    /// traced.
    void step(Recorder& recorder);
    /// Records adding the radiance of all paths to the film.
    void finish(Recorder& recorder);

    /// The remaining work, after the recorded commands have ended.
    shared::WaveCounts counts_left(const Gpu& gpu) const;
    /// Records setting the counts to `left`. Must come first in the submission that follows one with most_steps.
    void resume(Recorder& recorder, const shared::WaveCounts& left);

private:
    void trace(Recorder& recorder, const TracePipeline& pipeline, std::size_t counted) const;
    void count_from(Recorder& recorder, const shared::WaveCounts& first);
    std::uint64_t counts_at(std::size_t member) const;

    const WavePipelines& pipelines_;
    const PipelineLayout& layout_;
    const Bindings& bindings_;
    const WaveMemory& memory_;
    shared::Dispatch dispatch_;
};

}  // namespace diptych::core
