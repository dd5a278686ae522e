#include "renderer/path_renderer.h"

#include <algorithm>

#include "clock.h"
#include "passes/pass_pipelines.h"
#include "renderer/memory_plan.h"
#include "shader_binaries.h"

namespace diptych::core {
namespace {

InstanceGroups chosen_groups(const Gpu& gpu, const PackedScene& packed, Grouping grouping) {
    const bool wanted = grouping == Grouping::anywhere || (grouping == Grouping::on_gpus && !gpu.on_cpu);
    return wanted ? group_instances(packed) : InstanceGroups{};
}

PathRendererOptions with_options(PathRendererOptions changes, const VulkanOptions& options) {
    changes.grouping = options.group_instances ? changes.grouping : Grouping::nowhere;
    changes.busy = options.busy;
    return changes;
}

constexpr std::uint64_t least_slice = 4096;  // paths

}  // namespace

void record_dispatch(Recorder& recorder, const TracePipeline& pipeline, const PipelineLayout& layout,
                     const Bindings& bindings, const shared::Dispatch& dispatch, std::uint32_t width,
                     std::uint32_t height) {
    bind_pass(recorder, pipeline, layout, bindings, dispatch);
    trace(recorder, pipeline, width, height);
}

PathRenderer::PathRenderer(const PackedScene& packed, const VulkanOptions& options, const PathRendererOptions& changes)
    : PathRenderer(open_device(options), packed, with_options(changes, options)) {}

PathRenderer::PathRenderer(std::shared_ptr<Gpu> gpu, const PackedScene& packed, const PathRendererOptions& changes)
    : gpu_(std::move(gpu)), constants_(packed.constants), features_(packed.features), changes_(changes),
      schedule_(packed.constants) {
    const Stopwatch building;
    in_context("planning the memory",
               [&] { require_memory(*gpu_, packed, chosen_groups(*gpu_, packed, changes_.grouping)); });
    upkeep_ = std::make_unique<CommandRing>(*gpu_);
    say("building acceleration structures");
    in_context("uploading the scene", [&] { scene_ = upload_scene(*gpu_, packed); });
    in_context("building acceleration structures", [&] { build_structures(packed); });
    const auto size = glm::ivec2(constants_.size);
    in_context("making the film", [&] {
        film_ = films_.emplace_back(std::make_shared<FilmMemory>(make_film(*gpu_, size.x, size.y, features_)));
        replace_waves();
        resampling_ = std::make_shared<ResamplingMemory>(make_resampling_memory(*gpu_, constants_));
    });
    costs_.build_seconds = building.seconds();
    count_bytes();

    const Stopwatch compiling;
    in_context("setting up pipelines", [&] {
        layout_ = make_pipeline_layout(*gpu_);
        choose_pipelines();
        bind();
        queue_ = std::make_unique<TimedQueue>(
            *gpu_, [this](std::uint64_t work, double seconds) { speed_.learn(work, seconds); });
    });
    costs_.compile_seconds = compiling.seconds();
}

void PathRenderer::say(const std::string& what) const {
    if (changes_.busy) {
        changes_.busy(what);
    }
}

void PathRenderer::build_structures(const PackedScene& packed) {
    bottom_ = build_bottom_levels(*gpu_, packed, scene_, chosen_groups(*gpu_, packed, changes_.grouping));
    top_ = build_top_level(*gpu_, packed, bottom_);
    previous_top_ = packed.keeps_previous ? build_top_level(*gpu_, packed, bottom_) : TopLevel();
    emitters_ = build_emitters(*gpu_, packed);
}

void PathRenderer::count_bytes() {
    costs_.acceleration_bytes = bottom_.bytes + bottom_.grouped_geometries.size + top_.storage.size +
                                previous_top_.storage.size + emitter_bytes(emitters_);
    costs_.pass_bytes = resampling_memory_bytes(*resampling_) + wave_memory_bytes(waves_);
    costs_.bytes =
        scene_bytes(scene_) + costs_.acceleration_bytes + films_.size() * film_bytes(*film_) + costs_.pass_bytes;
}

// Waves are not needed if only the first vertex's resampled light is rendered.
bool PathRenderer::goes_in_waves() const {
    return !resamples() || (features_ & shared::FEATURE_LATER_VERTICES) != 0;
}

void PathRenderer::replace_waves() {
    const std::uint64_t pixels = std::uint64_t{constants_.size.x} * constants_.size.y;
    const std::uint32_t capacity = goes_in_waves() ? path_capacity(*gpu_, pixels) : 0;
    const std::uint32_t features = goes_in_waves() ? features_ : 0;
    if (!fits(waves_, capacity, features)) {
        waves_ = WaveMemory();
        waves_ = capacity > 0 ? make_wave_memory(*gpu_, capacity, features) : WaveMemory();
    }
}

// Takes an empty film that is not displayed, so that a displayed picture stays complete while the next one begins.
// There is one film more than are displayed at the same time.
void PathRenderer::begin_film() {
    const auto size = glm::ivec2(constants_.size);
    std::erase_if(films_, [&](const auto& film) { return !fits(*film, size.x, size.y, features_); });
    const auto free = std::find_if(films_.begin(), films_.end(),
                                   [&](const auto& film) { return film.use_count() == (film == film_ ? 2 : 1); });
    const bool used = free != films_.end();
    if (used) {
        film_ = *free;
    } else {
        film_ = films_.emplace_back(std::make_shared<FilmMemory>(make_film(*gpu_, size.x, size.y, features_)));
        count_bytes();
    }
    upkeep_->submit([&](Recorder& recorder) {
        if (used) {
            record_clear(recorder, *film_);
        }
        if (bindings_.set) {
            record_values(recorder, bindings_, addresses(*film_), constants_);
        }
    });
}

SceneAddresses PathRenderer::addresses(const FilmMemory& film) const {
    SceneAddresses all = scene_addresses(scene_);
    all.grouped_geometries = bottom_.grouped_geometries.address;
    enter_film(all, film);
    enter_resampling(all, *resampling_);
    enter_waves(all, waves_);
    return all;
}

PipelineConstants PathRenderer::pipeline_constants(bool record_rays) const {
    return {
        .features = features_, .record_rays = record_rays ? 1U : 0U, .groups = bottom_.groups.groups.empty() ? 0U : 1U};
}

void PathRenderer::choose_pipelines() {
    traced_.clear();
    computed_.clear();
    candidates_ = CandidatePipelines();
    PassPipelines pipelines(*gpu_, layout_, pipeline_constants(false));
    const auto shader_of = [&](ResamplingStage stage) { return resampling_shader(stage, constants_); };
    if (resamples()) {
        for (const ResamplingStage stage : {ResamplingStage::first_hits, ResamplingStage::shadows}) {
            if (needs_stage(stage, constants_)) {
                pipelines.want(traced_[stage], shader_of(stage));
            }
        }
        for (const ResamplingStage stage : {ResamplingStage::temporal, ResamplingStage::spatial}) {
            if (needs_stage(stage, constants_) && reuse_traces(constants_)) {
                pipelines.want(traced_[stage], shader_of(stage));
            } else if (needs_stage(stage, constants_)) {
                pipelines.want(computed_[stage], shader_of(stage));
            }
        }
        pipelines.want(candidates_.picked, shader_of(ResamplingStage::candidates));
        if (constants_.resampling.bsdf_candidates != 0) {
            pipelines.want(candidates_.bsdf, shader_binary("restir_bsdf_candidates.rgen"));
            if (shared::reuses_reservoirs(constants_.integrator)) {
                pipelines.want(candidates_.shares, shader_binary("restir_share_picked.rgen"));
            }
        }
        if (tests_candidates(constants_)) {
            pipelines.want(candidates_.shadows, shader_binary("restir_candidate_shadows.rgen"));
        }
    }
    wave_pipelines_ = {.begin_appends = resamples()};
    pipelines.want(wave_pipelines_.begin,
                   resamples() ? shader_of(ResamplingStage::shade) : shader_binary("wave_begin.comp"));
    if (goes_in_waves()) {
        pipelines.want(wave_pipelines_.rays, shader_binary("wave_rays.rgen"));
        pipelines.want(wave_pipelines_.shade, shader_binary("wave_shade.comp"));
        if ((features_ & shared::FEATURE_LIGHT_SAMPLING) != 0) {
            pipelines.want(wave_pipelines_.shadows, shader_binary("wave_shadows.rgen"));
        }
        pipelines.want(wave_pipelines_.film, shader_binary("wave_film.comp"));
    }
    pipelines_compiled_ += pipelines.complete([this](std::size_t count) {
        say("compiling " + std::to_string(count) + (count == 1 ? " pipeline" : " pipelines"));
    });
}

Structures PathRenderer::structures() const {
    return {.scene = *top_.structure, .previous = *previous_top_.structure, .emitters = *emitters_.top};
}

void PathRenderer::bind() {
    bindings_ = make_bindings(*gpu_, layout_, structures(), addresses(*film_), constants_);
    if (!resamples()) {
        warm_up();
    }
}

void PathRenderer::require_bound() const {
    if (!bindings_.set) {
        throw Error("Vulkan device " + gpu_->name + ": its last settings could not be taken over");
    }
}

// Some drivers compile at the first dispatch. The path traced here is not added to a film; it keeps compile time out
// of the measurements.
void PathRenderer::warm_up() const {
    run_commands(*gpu_, [&](Recorder& recorder) {
        SliceWaves path(wave_pipelines_, layout_, bindings_, waves_, {{0, 0, 1, 1}, 0, 1});
        SliceWaves nothing(wave_pipelines_, layout_, bindings_, waves_, {{0, 0, 1, 1}, 0, 0});
        path.begin(recorder);
        path.step(recorder);
        path.step(recorder);  // the first step that may trace a shadow ray
        nothing.finish(recorder);
    });
}

void PathRenderer::render(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) {
    require_bound();
    in_context("rendering", [&] {
        if (resamples()) {
            render_frames(first, count, cancel);
        } else {
            render_paths(first, count, cancel);
        }
        queue_->drain();
    });
}

void PathRenderer::restart(std::uint32_t seed) {
    require_bound();
    in_context("starting over", [&] {
        constants_.seed = seed;
        schedule_.restart();
        begin_film();
    });
}

void PathRenderer::clear_film() {
    in_context("emptying the film", [&] { begin_film(); });
}

void PathRenderer::move_to(const PackedScene& moment) {
    require_bound();
    in_context("moving the scene", [&] {
        if (!mover_) {
            mover_ = std::make_unique<Uploader>(
                *gpu_, std::clamp<std::uint64_t>(moving_bytes(moment), 4096, std::uint64_t{64} << 20U));
        }
        upload_moment(*mover_, moment, scene_);
        if (moment.keeps_previous &&
            MUTANT(PREVIOUS_STRUCTURE_STAYS, true, moment.revisions.instances != top_.revision)) {
            std::swap(top_, previous_top_);
        }
        move_top_level(*gpu_, moment, bottom_, top_);
        move_emitters(*gpu_, moment, emitters_);
        if (moment.keeps_previous) {
            replace_structures(*gpu_, bindings_, structures());
        }
        const std::uint32_t seed = constants_.seed;
        constants_ = moment.constants;
        constants_.seed = seed;
        upkeep_->submit([&](Recorder& recorder) { record_values(recorder, bindings_, addresses(*film_), constants_); });
    });
}

std::uint64_t PathRenderer::slice_budget() const {
    return changes_.slice_budget > 0 ? changes_.slice_budget : speed_.budget();
}

// A picture of few pixels fills the device by several samples of each. Before the speed is known, or when time is
// short, there are no more paths in flight than a slice may have.
void PathRenderer::grow_waves(std::uint64_t paths) {
    const std::uint64_t wanted = std::min(paths, slice_budget());
    const bool fills = !gpu_->on_cpu || changes_.fill == DeviceFill::anywhere;
    if (!fills || wanted <= waves_.wanted) {
        return;
    }
    constexpr std::uint64_t growth = 8;  // to allocate takes time, too
    const std::uint32_t capacity = path_capacity(*gpu_, std::max(wanted, waves_.wanted * growth));
    if (capacity <= waves_.wanted) {
        return;
    }
    queue_->drain();
    waves_ = WaveMemory();
    waves_ = make_wave_memory(*gpu_, capacity, features_);
    upkeep_->submit([&](Recorder& recorder) { record_values(recorder, bindings_, addresses(*film_), constants_); });
    count_bytes();
}

void PathRenderer::render_paths(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) {
    SliceCursor cursor({0, 0, constants_.size.x, constants_.size.y}, first, count);
    while (!cursor.done() && !cancel.load()) {
        grow_waves(cursor.left());
        submit_slice(*queue_, wave_pipelines_, bindings_, next_slice(cursor, speed_));
    }
}

// A wave has a fixed cost, so a slice has a minimum size.
Slice PathRenderer::next_slice(SliceCursor& cursor, const SpeedEstimate& speed) const {
    const std::uint64_t budget =
        changes_.slice_budget > 0 ? changes_.slice_budget : std::max(speed.budget(), least_slice);
    return cursor.next(std::min<std::uint64_t>(budget, waves_.capacity),
                       gpu_->ray_tracing.maxRayDispatchInvocationCount);
}

// Runs as many waves as the deepest path may need. At the last vertex emission is added, but no light is sampled. A
// resampled path starts after its first vertex. If there are very many waves, those after the end of all paths are
// skipped.
void PathRenderer::submit_slice(TimedQueue& queue, const WavePipelines& pipelines, const Bindings& bindings,
                                const Slice& slice, const shared::Dispatch& request, std::size_t label) const {
    SliceWaves waves(pipelines, layout_, bindings, waves_, slice, request);
    std::uint64_t steps = goes_in_waves() ? std::uint64_t{constants_.max_depth} + (resamples() ? 0 : 1) : 0;
    const auto submit = [&](std::uint64_t work, auto&& start) {
        const TimedPart part{label, [&](Recorder& recorder) {
                                 start(recorder);
                                 for (std::uint32_t i = 0; i < SliceWaves::most_steps && steps > 0; ++i, --steps) {
                                     waves.step(recorder);
                                 }
                                 if (steps == 0) {
                                     waves.finish(recorder);
                                 }
                             }};
        queue.submit(work, std::span(&part, 1));
    };
    submit(slice.work(), [&](Recorder& recorder) { waves.begin(recorder); });
    while (steps > 0) {
        queue.drain();
        const shared::WaveCounts left = waves.counts_left(*gpu_);
        steps = left.rays.x > 0 ? steps : 1;  // for shadow rays that may remain
        submit(0, [&](Recorder& recorder) { waves.resume(recorder, left); });
    }
}

DeviceFilm PathRenderer::device_film() const {
    return {.gpu = gpu_,
            .film = film_,
            .resampling = reservoir_set_ ? resampling_ : nullptr,
            .reservoir_set = reservoir_set_.value_or(0)};
}

void PathRenderer::aim_dispatches(double seconds) {
    dispatch_seconds_ = seconds;
    speed_.aim(seconds);
    if (recording_speed_) {
        recording_speed_->aim(seconds);
    }
}

Film PathRenderer::film() const {
    return in_context("reading the film", [&] { return read_film(*gpu_, *film_); });
}

std::unique_ptr<Renderer> make_vulkan_renderer(const PackedScene& packed, const VulkanOptions& options) {
    return std::make_unique<PathRenderer>(packed, options);
}

std::shared_ptr<Gpu> open_device(const VulkanOptions& options) {
    return open_gpu(GpuRequest{.device = options.device, .validation = validation_wanted(options.validation)});
}

bool is_lost(const Gpu& gpu) {
    return gpu.lost;
}

std::unique_ptr<Renderer> make_vulkan_renderer(std::shared_ptr<Gpu> gpu, const PackedScene& packed,
                                               const VulkanOptions& options) {
    return std::make_unique<PathRenderer>(std::move(gpu), packed, with_options({}, options));
}

}  // namespace diptych::core
