// The Renderer of one device. make_vulkan_renderer creates it; tests create it directly.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "../../shaders/dispatch.h"
#include "structures/acceleration.h"
#include "pipelines/bindings.h"
#include "renderer/device_film.h"
#include "structures/emitter_structure.h"
#include "memory/film_memory.h"
#include "passes/path_waves.h"
#include "device/pipeline_cache.h"
#include "passes/resampling_passes.h"
#include "memory/scene_memory.h"
#include "commands/slices.h"
#include "commands/timed_queue.h"
#include "renderer/vulkan_renderer.h"

namespace diptych::core {

/// Whether static instances are grouped (instance_groups.h): on GPUs, where grouping reduces time (decision 0010), or
/// for a test anywhere.
enum class Grouping { nowhere, on_gpus, anywhere };

/// Whether a small picture has several samples of each pixel in flight: on GPUs, whose lanes would idle otherwise, or for
/// a test anywhere.
enum class DeviceFill { on_gpus, anywhere };

/// What tests change, and what is told of long steps.
struct PathRendererOptions {
    std::uint64_t slice_budget = 0;  // pixel samples per dispatch, independent of the measured speed
    Grouping grouping = Grouping::on_gpus;
    DeviceFill fill = DeviceFill::on_gpus;
    BusyHook busy = {};
};

class PathRenderer final : public Renderer {
public:
    PathRenderer(std::shared_ptr<Gpu> gpu, const PackedScene& packed, const PathRendererOptions& changes = {});
    PathRenderer(const PackedScene& packed, const VulkanOptions& options, const PathRendererOptions& changes = {});

    std::string backend() const override { return "vulkan"; }
    std::string device() const override { return gpu_->name; }
    RendererCosts costs() const override { return costs_; }
    Capabilities capabilities() const override { return {true, true, true, true}; }
    void render(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) override;
    void restart(std::uint32_t seed) override;
    void clear_film() override;
    void move_to(const PackedScene& moment) override;
    void reconfigure(const PackedScene& packed) override;
    double device_seconds() const override { return queue_->seconds(); }
    std::vector<PassTime> pass_times() const override;
    void watch_reservoirs(ReservoirHook hook) override { hook_ = std::move(hook); }
    Film film() const override;
    TraversalBench bench_traversal(std::uint32_t samples) override;
    std::vector<RecordedPath> record_paths(std::span<const shared::PathQuery> queries,
                                           std::optional<std::uint32_t> seed = {}) override;
    std::vector<shared::PathSummary> summarize_paths(std::span<const shared::PathQuery> queries) override;

    const BottomLevels& bottom_levels() const { return bottom_; }

    /// The current picture, for a display pass on the same device. Samples that are added to this picture later appear
    /// in it too. It stays unchanged when the next picture begins.
    DeviceFilm device_film() const;
    /// Sets the target device time of a dispatch. A user of the same queue waits for at most two dispatches.
    void aim_dispatches(double seconds);
    /// Pipelines that this renderer compiled. Those that others compiled on its device are not counted.
    std::size_t pipelines_compiled() const { return pipelines_compiled_; }

private:
    PipelineConstants pipeline_constants(bool record_rays) const;
    void say(const std::string& what) const;
    void choose_pipelines();
    Structures structures() const;
    void bind();
    void require_bound() const;
    void build_structures(const PackedScene& packed);
    void replace_structures_of(const PackedScene& packed);
    void replace_film();
    void count_bytes();
    void replace_waves();
    void grow_waves(std::uint64_t paths);
    void begin_film();
    SceneAddresses addresses(const FilmMemory& film) const;
    void render_paths(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel);
    void render_frames(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel);
    std::uint64_t pixel_limit(ResamplingStage stage) const;
    void record_stage(Recorder& recorder, ResamplingStage stage, const Slice& slice, shared::Dispatch dispatch) const;
    void show_reservoirs(const ResamplingStep& step);
    std::uint64_t slice_budget() const;
    bool resamples() const { return shared::resamples_lights(constants_.integrator); }
    bool goes_in_waves() const;
    void warm_up() const;
    Slice next_slice(SliceCursor& cursor, const SpeedEstimate& speed) const;
    void submit_slice(TimedQueue& queue, const WavePipelines& pipelines, const Bindings& bindings, const Slice& slice,
                      const shared::Dispatch& request = {}, std::size_t label = 0) const;
    std::vector<shared::PathSummary> summarize(std::span<const shared::PathQuery> queries,
                                               const shared::RenderConstants& constants);
    void trace_listed(std::span<const shared::PathQuery> queries, const shared::RenderConstants& constants,
                      std::uint32_t vertices_per_path, const Buffer& vertices, const Buffer& summaries);

    std::shared_ptr<Gpu> gpu_;
    shared::RenderConstants constants_;
    std::uint32_t features_;
    PathRendererOptions changes_;
    SceneMemory scene_;
    BottomLevels bottom_;
    TopLevel top_;
    TopLevel previous_top_;  // of the previous moment, if PackedScene::keeps_previous
    EmitterStructure emitters_;
    std::unique_ptr<Uploader> mover_;  // created for the first move
    std::vector<std::shared_ptr<FilmMemory>>
        films_;  // of the current size and layers; one is film_, others may be displayed
    std::shared_ptr<FilmMemory> film_;
    PipelineLayout layout_;
    std::size_t pipelines_compiled_ = 0;
    WavePipelines wave_pipelines_;
    WaveMemory waves_;
    std::shared_ptr<ResamplingMemory> resampling_;
    std::map<ResamplingStage, const TracePipeline*> traced_;      // stages that are one pass and trace rays
    std::map<ResamplingStage, const ComputePipeline*> computed_;  // stages that are one pass and trace no rays
    CandidatePipelines candidates_;
    ResamplingSchedule schedule_;
    ReservoirHook hook_;
    std::optional<std::uint32_t> reservoir_set_;  // written by the last frame
    Bindings bindings_;
    double dispatch_seconds_ = 0.06;
    SpeedEstimate speed_{dispatch_seconds_};
    std::unique_ptr<CommandRing> upkeep_;  // commands between pictures
    std::unique_ptr<TimedQueue> queue_;
    RendererCosts costs_;
    std::optional<SpeedEstimate> recording_speed_;  // of record.rgen, once it has been used
};

/// Records the commands of one dispatch.
void record_dispatch(Recorder& recorder, const TracePipeline& pipeline, const PipelineLayout& layout,
                     const Bindings& bindings, const shared::Dispatch& dispatch, std::uint32_t width,
                     std::uint32_t height);

}  // namespace diptych::core
