// Paths in waves (shaders/wave.glsl): the passes, and what they keep for every path in flight.
#pragma once

#include <cstdint>

#include "passes/pass.h"

namespace diptych::core {

/// Paths in flight at a time, for a film of so many pixels: one of each, within bounds and a part of the device's
/// memory. A film of few pixels has several samples of each in flight, one of very many goes in parts.
std::uint32_t path_capacity(const Gpu& gpu, std::uint64_t pixels);

struct WaveMemory {
    std::uint32_t capacity = 0;  // paths
    Buffer paths;
    Buffer first_hits;  // where a film keeps them
    Buffer queues;
    Buffer hits;
    Buffer shadows;  // where lights are sampled
    Buffer counts;
};

WaveMemory make_wave_memory(const Gpu& gpu, std::uint32_t capacity, std::uint32_t features);

/// Whether it has that room or more, and the buffers that `features` ask for and no others.
bool fits(const WaveMemory& memory, std::uint32_t capacity, std::uint32_t features);

std::uint64_t wave_memory_bytes(const WaveMemory& memory);

void enter_waves(SceneAddresses& addresses, const WaveMemory& memory);

/// Pipelines of the passes, none of them owned.
struct WavePipelines {
    const ComputePipeline* begin = nullptr;
    bool begin_appends = false;           // those that go on; else all do
    const TracePipeline* rays = nullptr;  // this and what follows: null where no path goes on
    const ComputePipeline* shade = nullptr;
    const TracePipeline* shadows = nullptr;  // null where no light is sampled
    const ComputePipeline* film = nullptr;   // which begins add to themselves otherwise
};

/// The waves of one slice, which has to have room in the memory, in one submission or, of deep paths, several.
class SliceWaves {
public:
    static constexpr std::uint32_t most_steps = 128;  // of a submission

    /// `request` holds what the passes are told beside the slice: room for rays that are recorded, a pass of
    /// resampling.
    SliceWaves(const WavePipelines& pipelines, const PipelineLayout& layout, const Bindings& bindings,
               const WaveMemory& memory, const Slice& slice, const shared::Dispatch& request = {});

    /// Records: all paths begin. First of a submission.
    void begin(Recorder& recorder);
    /// Records that all paths which go on go on by one ray, while shadow rays of the step before are traced.
    void step(Recorder& recorder);
    /// Records: what all paths found is added to the film.
    void finish(Recorder& recorder);

    /// What there is left to do, once what was recorded has ended.
    shared::WaveCounts counts_left(const Gpu& gpu) const;
    /// Records that there is that to do. First of another submission, after most_steps in the last.
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
